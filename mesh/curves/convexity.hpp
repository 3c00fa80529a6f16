// Convex polygons and convex curves in the plane.
#pragma once

#include "mesh/curves/w_curve.hpp"

namespace snug::mesh::curves {

/// True when the points (2 x N, N >= 3), closed by the edge from the last to the first, go once round a convex polygon
/// in either sense. Turns by less than `tolerance` rad the other way count as straight.
bool is_convex(const Eigen::MatrixXd& polygon, double tolerance = 1e-12);

/// What is known of a plane curve's convexity from polygons alone.
enum class Convexity {
  by_polygon,  ///< its control polygon is convex: so is the curve (theorem 3.7)
  by_bezier,   ///< only the polygon of the equivalent Bézier curve is (theorem 3.6 does not turn round)
  not_shown    ///< neither: the curve may still be convex
};
/// Throws std::invalid_argument where the curve does not lie in the plane (two dimensions) or is a line.
Convexity convexity(const WCurve& curve);

}  // namespace snug::mesh::curves
