// Rational B-splines (NURBS) of many segments: what other programs exchange. Each segment is a W curve or W surface.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

#include "mesh/curves/w_curve.hpp"
#include "mesh/curves/w_surface.hpp"

namespace snug::mesh::curves {

/// Degree p, N control points, N + p + 1 knots t_0…t_{N+p}; the curve lives on [t_p, t_N].
struct BSplineCurve {
  int degree = 0;
  std::vector<double> knots;
  Eigen::MatrixXd points;   ///< one column each, in two or three dimensions
  Eigen::VectorXd weights;  ///< positive; all 1 where it is polynomial

  /// Why it is no curve, or empty: a wrong number of knots, points or weights, knots that fall, an inner knot more than
  /// p times.
  std::string fault() const;
  double start() const { return knots[degree]; }
  double end() const { return knots[knots.size() - 1 - degree]; }

  /// The segments of the spans that are not empty, in order.
  std::vector<WCurve> segments() const;
  Eigen::VectorXd point(double t) const;
  /// The same curve by knots that hold its own: knot insertion, by the polar form of each segment. Throws
  /// std::invalid_argument where a segment would have a weight that is not positive.
  BSplineCurve with_knots(const std::vector<double>& finer) const;
  /// With both ends p + 1 times among the knots, so that it begins and ends at control points.
  BSplineCurve clamped() const;
};

/// One segment; a W curve whose knots are not sorted is no B-spline by its own knots and comes in its Bézier form.
BSplineCurve b_spline_of(const WCurve& curve);

/// Degrees p and q, N × M control points (column i M + j), N + p + 1 and M + q + 1 knots.
struct BSplineSurface {
  std::array<int, 2> degrees = {0, 0};
  std::array<std::vector<double>, 2> knots;
  Eigen::Matrix3Xd points;
  Eigen::VectorXd weights;

  std::string fault() const;
  int rows() const { return static_cast<int>(knots[0].size()) - degrees[0] - 1; }
  int columns() const { return static_cast<int>(knots[1].size()) - degrees[1] - 1; }

  /// The patches, row by row.
  std::vector<WSurface> patches() const;
  Eigen::Vector3d point(double u, double v) const;
  BSplineSurface clamped() const;
};

BSplineSurface b_spline_of(const WSurface& surface);

}  // namespace snug::mesh::curves
