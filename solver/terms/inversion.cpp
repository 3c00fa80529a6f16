#include "solver/terms/inversion.hpp"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace snug::solver {

double first_inversion(const Eigen::Matrix3d& F, const Eigen::Matrix3d& dF, double limit) {
  const double c0 = F.determinant(), c3 = dF.determinant();
  const double at_plus = (F + dF).determinant(), at_minus = (F - dF).determinant();
  const double c2 = 0.5 * (at_plus + at_minus) - c0, c1 = 0.5 * (at_plus - at_minus) - c3;
  const auto value = [&](double a) { return 0.95 * c0 + a * (c1 + a * (c2 + a * c3)); };
  std::array<double, 3> ends = {limit, limit, limit};  // extrema split the interval into monotone pieces
  const double discriminant = c2 * c2 - 3.0 * c1 * c3;
  if (std::abs(c3) > 1e-300 && discriminant >= 0.0) {
    const double root = std::sqrt(discriminant);
    ends[0] = std::min((-c2 - root) / (3.0 * c3), (-c2 + root) / (3.0 * c3));
    ends[1] = std::max((-c2 - root) / (3.0 * c3), (-c2 + root) / (3.0 * c3));
  } else if (std::abs(c2) > 1e-300) {
    ends[0] = -c1 / (2.0 * c2);
  }
  double begin = 0.0;
  for (double end : ends) {
    end = std::clamp(end, begin, limit);
    if (value(end) < 0.0) {
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (begin + end);
        (value(middle) < 0.0 ? end : begin) = middle;
      }
      return begin;
    }
    begin = end;
  }
  return limit;
}

}  // namespace snug::solver
