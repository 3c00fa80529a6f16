// Smooth star-shaped sections along a limb: the outline of a scan.
#pragma once

#include <Eigen/Core>

#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// Natural cubic splines of many values over the same equally spaced heights, evaluated together.
class VectorSpline {
 public:
  /// One column a knot, at least three; knot n stands at z0 + n dz.
  VectorSpline(double z0, double dz, Eigen::MatrixXd values);

  /// Value, first and second derivative as columns; straight beyond the ends.
  Eigen::Matrix<double, Eigen::Dynamic, 3> derivatives(double z) const;
  Eigen::VectorXd operator()(double z) const;

 private:
  double z0_, dz_;
  Eigen::MatrixXd values_, second_;  // second derivatives at the knots
};

/// Section x(theta, z) = c(z) + r(theta, z) (cos theta, sin theta) with theta = 2 pi turn and the radius as a Fourier
/// series r = a0 + sum_n a_n cos(n theta) + b_n sin(n theta). Centre and coefficients are cubic splines of z, so that
/// the skin is twice differentiable and its curvature exact.
class FourierOutline final : public Outline {
 public:
  /// Rows of the spline: centre x, centre y, a0, a1, b1, a2, b2, ...
  explicit FourierOutline(VectorSpline spline) : spline_(std::move(spline)) {}

  Eigen::Vector3d at(double turn, double z) const override;
  OutlinePoint derivatives(double turn, double z) const override;

 private:
  VectorSpline spline_;
};

}  // namespace snug::mesh
