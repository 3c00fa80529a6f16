#pragma once

#include <Eigen/Core>
#include <array>

namespace snug::mesh {

/// Of two vectors in a plane: |a| |b| times the sine of the angle from a to b.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Three numbers of a case as a vector.
inline Eigen::Vector3d vector(const std::array<double, 3>& x) { return {x[0], x[1], x[2]}; }

}  // namespace snug::mesh
