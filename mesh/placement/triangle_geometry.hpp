// Points, segments and triangles in space.
#pragma once

#include <Eigen/Core>

#include <array>

namespace snug::mesh {

using Triangle3 = std::array<Eigen::Vector3d, 3>;

/// Barycentric coordinates of the point of a triangle that is nearest to `p` (Ericson, Real-Time Collision Detection,
/// 2005, 5.1.5).
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Triangle3& triangle);
/// m, from `p` to the nearest point of the triangle.
double distance_to_triangle(const Eigen::Vector3d& p, const Triangle3& triangle);

/// Sign of the crossing of the segment from `a` to `b` with the triangle: 1 along its normal, -1 against it, 0 where
/// they do not meet (Moeller and Trumbore, J. Graphics Tools 2 (1997) 21). Segments in the triangle's plane do not
/// cross it.
int crossing(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Triangle3& triangle);

/// Whether a side of one triangle crosses the other.
bool cross_each_other(const Triangle3& one, const Triangle3& other);

}  // namespace snug::mesh
