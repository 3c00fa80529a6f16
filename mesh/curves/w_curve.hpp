// Rational W curves: one segment of a rational B-spline (NURBS), as rational Bézier curves are.
#pragma once

#include <Eigen/Core>

#include "mesh/curves/segment_knots.hpp"

namespace snug::mesh::curves {

/// Q(t) = sum w_i P_i G_i(t) / sum w_i G_i(t) on [knots.start(), knots.end()] (3.3), evaluated by the steps (3.4),
/// (3.5) on the homogeneous points (w P, w). Where the weights are all equal it is the polynomial W curve.
class WCurve {
 public:
  /// `points`: one column a control point, n + 1 of them, in any number of dimensions; `weights` positive, n + 1.
  /// Throws std::invalid_argument otherwise.
  WCurve(SegmentKnots knots, const Eigen::MatrixXd& points, const Eigen::VectorXd& weights);
  /// With all weights 1.
  WCurve(SegmentKnots knots, const Eigen::MatrixXd& points);

  const SegmentKnots& knots() const { return knots_; }
  int degree() const { return knots_.degree(); }
  int dimension() const { return static_cast<int>(homogeneous_.rows()) - 1; }
  Eigen::MatrixXd points() const;
  Eigen::VectorXd weights() const { return homogeneous_.row(dimension()); }

  Eigen::VectorXd point(double t) const;
  /// Columns: the point and its derivatives up to `order`.
  Eigen::MatrixXd derivatives(double t, int order) const;

  /// What remains after `steps` of the n steps at tau, a W curve of degree n - steps in t: the member at tau of the
  /// family whose envelope this curve is (3.7). It touches at t = tau, with the derivative (n - steps)/n of this
  /// curve's; varied by tau at constant t the derivative there is steps/n of it. steps = n - 1 are the tangents (3.9).
  WCurve stepped(int steps, double tau) const;

  /// The same curve by other knots of its degree: P_i is the polar form at u_{i+1}…u_n, r_0…r_{i-1}, one step an
  /// argument. Throws std::invalid_argument where a weight would not be positive (knots far outside).
  WCurve with_knots(const SegmentKnots& knots) const;
  /// By Bézier knots on [from, to], a part of [start, end]: n - i steps at `from` and then i steps at `to` (3.11),
  /// (3.12).
  WCurve bezier(double from, double to) const;
  WCurve bezier() const { return bezier(knots_.start(), knots_.end()); }

 private:
  SegmentKnots knots_;
  Eigen::MatrixXd homogeneous_;  // (w P, w) a column
};

}  // namespace snug::mesh::curves
