#include "mesh/curves/recurrence.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::mesh::curves {

LinearSteps::LinearSteps(int degree)
    : a_(Eigen::MatrixXd::Zero(degree, degree)), b_(Eigen::MatrixXd::Zero(degree, degree)) {}

LinearSteps::LinearSteps(const SegmentKnots& knots) : LinearSteps(knots.degree()) {
  for (int l = 1; l <= degree(); ++l)
    for (int i = 0; i <= degree() - l; ++i) {
      a(i, l) = knots.slope(i, l);
      b(i, l) = -knots.r()[i] * knots.slope(i, l);
    }
}

Eigen::VectorXd LinearSteps::point(const Eigen::MatrixXd& points, double t) const {
  const int n = degree();
  if (points.cols() != n + 1) throw std::invalid_argument("a recurrence curve of degree n has n + 1 points");
  Eigen::MatrixXd d = points;
  for (int l = 1; l <= n; ++l)
    for (int i = 0; i <= n - l; ++i) {
      const double lambda = a(i, l) * t + b(i, l);
      d.col(i) = lambda * d.col(i) + (1.0 - lambda) * d.col(i + 1);
    }
  return d.col(0);
}

double LinearSteps::w_residual() const {
  const int n = degree();
  double largest = 0.0;
  for (int l = 1; l < n; ++l)
    for (int i = 0; i < n - l; ++i) {
      largest = std::max(largest, std::abs(a(i, l) * b(i, l + 1) - a(i, l + 1) * b(i, l)));
      largest = std::max(largest, std::abs(a(i, l + 1) * (1.0 - b(i + 1, l)) - a(i + 1, l) * (1.0 - b(i, l + 1))));
    }
  return largest;
}

std::optional<SegmentKnots> LinearSteps::knots(double tolerance) const {
  const int n = degree();
  for (int l = 1; l <= n; ++l)
    for (int i = 0; i <= n - l; ++i)
      if (a(i, l) == 0.0) return std::nullopt;
  if (n < 1 || w_residual() > tolerance) return std::nullopt;
  std::vector<double> u(n), r(n);
  for (int i = 0; i < n; ++i) {
    r[i] = -b(i, 1) / a(i, 1);
    u[i] = (1.0 - b(i, 1)) / a(i, 1);
  }
  if (*std::max_element(u.begin(), u.end()) >= *std::min_element(r.begin(), r.end())) return std::nullopt;
  return SegmentKnots(std::move(u), std::move(r));
}

}  // namespace snug::mesh::curves
