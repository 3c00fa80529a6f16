// Curves and surfaces with random points, weights and admissible knots; the same in every run.
#pragma once

#include <algorithm>
#include <random>

#include "mesh/curves/w_curve.hpp"

namespace snug::testing {

class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}
  double between(double from, double to) { return std::uniform_real_distribution<double>(from, to)(engine_); }
  Eigen::MatrixXd matrix(int rows, int columns) {
    Eigen::MatrixXd m(rows, columns);
    for (double& value : m.reshaped()) value = between(-1.0, 1.0);
    return m;
  }
  Eigen::VectorXd weights(int count) {
    Eigen::VectorXd w(count);
    for (double& value : w) value = between(0.5, 2.0);
    return w;
  }
  /// Knots below 0 and above 1; sorted, as a B-spline's are, unless asked otherwise.
  mesh::curves::SegmentKnots knots(int degree, bool sorted = true) {
    std::vector<double> u(degree), r(degree);
    for (double& knot : u) knot = between(-1.5, 0.0);
    for (double& knot : r) knot = between(1.0, 2.5);
    if (sorted) {
      std::sort(u.begin(), u.end());
      std::sort(r.begin(), r.end());
    }
    return {u, r};
  }
  mesh::curves::WCurve curve(int degree, int dimension = 3, bool sorted = true) {
    return {knots(degree, sorted), matrix(dimension, degree + 1), weights(degree + 1)};
  }

 private:
  std::mt19937 engine_;
};

/// Central difference with the error of fourth order.
template <class Function>
Eigen::VectorXd difference(const Function& f, double t, double h = 1e-3) {
  return (8.0 * (f(t + h) - f(t - h)) - (f(t + 2.0 * h) - f(t - 2.0 * h))) / (12.0 * h);
}

}  // namespace snug::testing
