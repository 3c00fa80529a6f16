// Recurrence curves by their steps, whatever these are.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

#include "mesh/curves/segment_knots.hpp"

namespace snug::mesh::curves {

/// Linear steps lambda_il(t) = a_il t + b_il, mu_il = 1 - lambda_il, i = 0…n-l, l = 1…n (the source's definition 3.1).
class LinearSteps {
 public:
  explicit LinearSteps(int degree);
  explicit LinearSteps(const SegmentKnots& knots);

  int degree() const { return static_cast<int>(a_.cols()); }
  double& a(int i, int l) { return a_(i, l - 1); }
  double& b(int i, int l) { return b_(i, l - 1); }
  double a(int i, int l) const { return a_(i, l - 1); }
  double b(int i, int l) const { return b_(i, l - 1); }

  /// D_{0,n}(t) of (3.1): D_i0 = P_i, D_il = lambda_il D_i,l-1 + mu_il D_i+1,l-1. `points`: n + 1 columns.
  Eigen::VectorXd point(const Eigen::MatrixXd& points, double t) const;

  /// Largest difference of the two sides of (3.2), i = 0…n-l-1, l = 1…n-1: zero for a W curve.
  double w_residual() const;
  /// The knots when (3.2) holds to `tolerance` with no a_il = 0, every u below every r: r_i = -b_il / a_il, u_{i+l} =
  /// (1 - b_il) / a_il.
  std::optional<SegmentKnots> knots(double tolerance = 1e-12) const;

 private:
  Eigen::MatrixXd a_, b_;  // row i, column l - 1
};

}  // namespace snug::mesh::curves
