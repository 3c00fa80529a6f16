// Four-point subdivision of curves and of nets of points: it interpolates what it starts from.
#pragma once

#include <Eigen/Core>

namespace snug::mesh::curves {

/// The tension that reproduces cubics. 0 puts the new points in the middle (polygons, bilinear surfaces); the limit has
/// a continuous tangent plane for 0 < w < (sqrt 5 - 1)/8 (Dyn, Levin and Gregory 1987).
constexpr double cubic_tension = 1.0 / 16.0;

/// A net of rows × columns points, column i * columns + j of `points` (any number of dimensions) the one of row i and
/// column j. A closed direction goes on from its last to its first.
struct Net {
  int rows = 0, columns = 0;
  bool rows_closed = false, columns_closed = false;
  Eigen::MatrixXd points;
};

/// One step for a curve: P_2i = P_i, P_2i+1 = (1/2 + w)(P_i + P_i+1) - w (P_i-1 + P_i+2). Beyond an end stands the
/// point that continues the nearest four by a cubic (three by a parabola, two by a line), so that cubics are kept up to
/// the ends. 2 N points when closed, 2 N - 1 else. Throws std::invalid_argument for fewer than two points (closed:
/// three).
Eigen::MatrixXd subdivided(const Eigen::MatrixXd& points, bool closed, double tension = cubic_tension);

/// One step for a net: along the rows' direction, then every row, the new ones too, along the other (the order does not
/// matter). In print the first takes P_i-2 where P_i+2 belongs. Throws as for curves.
Net subdivided(const Net& net, double tension = cubic_tension);

}  // namespace snug::mesh::curves
