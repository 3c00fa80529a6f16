#include "mesh/body/fourier_outline.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace snug::mesh {

namespace {

/// Second derivatives of natural cubic splines with equal spacing h: s(n-1) + 4 s(n) + s(n+1) = 6 (second
/// difference)/h^2.
Eigen::MatrixXd natural_second_derivatives(const Eigen::MatrixXd& values, double h) {
  const Eigen::Index last = values.cols() - 1;
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(values.rows(), values.cols());
  Eigen::VectorXd factor = Eigen::VectorXd::Zero(values.cols());
  for (Eigen::Index n = 1; n < last; ++n) {
    const Eigen::VectorXd right = 6.0 / (h * h) * (values.col(n + 1) - 2.0 * values.col(n) + values.col(n - 1));
    factor[n] = 1.0 / (4.0 - factor[n - 1]);
    second.col(n) = factor[n] * (right - second.col(n - 1));
  }
  for (Eigen::Index n = last - 1; n > 0; --n) second.col(n) -= factor[n] * second.col(n + 1);
  return second;
}

/// The basis {1, cos, sin, cos 2, sin 2, ...} with its first and second derivatives in theta as columns.
Eigen::Matrix<double, Eigen::Dynamic, 3> harmonics(Eigen::Index terms, double theta) {
  Eigen::Matrix<double, Eigen::Dynamic, 3> basis(terms, 3);
  basis.row(0) << 1.0, 0.0, 0.0;
  const double c1 = std::cos(theta), s1 = std::sin(theta);
  double c = 1.0, s = 0.0;
  for (Eigen::Index row = 1; row + 1 < terms; row += 2) {
    const double n = 0.5 * static_cast<double>(row + 1), next = c * c1 - s * s1;
    s = s * c1 + c * s1;
    c = next;
    basis.row(row) << c, -n * s, -n * n * c;
    basis.row(row + 1) << s, n * c, -n * n * s;
  }
  return basis;
}

}  // namespace

VectorSpline::VectorSpline(double z0, double dz, Eigen::MatrixXd values)
    : z0_(z0), dz_(dz), values_(std::move(values)), second_(natural_second_derivatives(values_, dz)) {}

Eigen::Matrix<double, Eigen::Dynamic, 3> VectorSpline::derivatives(double z) const {
  const double last = static_cast<double>(values_.cols() - 1);
  const double wanted = (z - z0_) / dz_, s = std::clamp(wanted, 0.0, last);
  const auto n = static_cast<Eigen::Index>(std::min(std::floor(s), last - 1.0));
  const double b = s - static_cast<double>(n), a = 1.0 - b, h = dz_;
  const auto left = values_.col(n), right = values_.col(n + 1), m0 = second_.col(n), m1 = second_.col(n + 1);
  Eigen::Matrix<double, Eigen::Dynamic, 3> result(values_.rows(), 3);
  result.col(0) = a * left + b * right + h * h / 6.0 * ((a * a * a - a) * m0 + (b * b * b - b) * m1);
  result.col(1) = (right - left) / h + h / 6.0 * ((3 * b * b - 1) * m1 - (3 * a * a - 1) * m0);
  result.col(2) = a * m0 + b * m1;
  if (s != wanted) result.col(0) += (wanted - s) * h * result.col(1);
  return result;
}

Eigen::VectorXd VectorSpline::operator()(double z) const { return derivatives(z).col(0); }

Eigen::Vector3d FourierOutline::at(double turn, double z) const {
  const double theta = 2.0 * std::numbers::pi * turn;
  const Eigen::VectorXd values = spline_(z);
  const double r = harmonics(values.size() - 2, theta).col(0).dot(values.tail(values.size() - 2));
  return {values[0] + r * std::cos(theta), values[1] + r * std::sin(theta), z};
}

OutlinePoint FourierOutline::derivatives(double turn, double z) const {
  const double w = 2.0 * std::numbers::pi, theta = w * turn;
  const auto in_z = spline_.derivatives(z);
  const Eigen::Index terms = in_z.rows() - 2;
  // Row: derivative in theta, column: derivative in z.
  const Eigen::Matrix3d r = harmonics(terms, theta).transpose() * in_z.bottomRows(terms);
  const Eigen::Vector3d e(std::cos(theta), std::sin(theta), 0), f(-e.y(), e.x(), 0);
  const auto centre = [&](int order) { return Eigen::Vector3d(in_z(0, order), in_z(1, order), 0); };
  return {.x = centre(0) + r(0, 0) * e + Eigen::Vector3d(0, 0, z),
          .x_t = w * (r(1, 0) * e + r(0, 0) * f),
          .x_z = centre(1) + r(0, 1) * e + Eigen::Vector3d(0, 0, 1),
          .x_tt = w * w * ((r(2, 0) - r(0, 0)) * e + 2.0 * r(1, 0) * f),
          .x_tz = w * (r(1, 1) * e + r(0, 1) * f),
          .x_zz = centre(2) + r(0, 2) * e};
}

}  // namespace snug::mesh
