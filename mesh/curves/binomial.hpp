// Binomial coefficients as doubles: exact up to 2^53, which the degrees of curves stay far below.
#pragma once

namespace snug::mesh::curves {

inline double binomial(int n, int k) {
  if (k < 0 || k > n) return 0.0;
  double value = 1.0;
  for (int i = 1; i <= k; ++i) value = value * (n - k + i) / i;
  return value;
}

inline double factorial(int n) {
  double value = 1.0;
  for (int i = 2; i <= n; ++i) value *= i;
  return value;
}

}  // namespace snug::mesh::curves
