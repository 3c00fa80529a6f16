// How far the shape that a garment is placed in stretches its triangles.
#pragma once

#include <Eigen/Core>
#include <Eigen/SVD>

#include <array>
#include <vector>

namespace snug::mesh {

/// Principal stretches, the larger first, of a triangle between its vertices (the first three of `nodes`) from the flat pattern to where it is placed.
inline Eigen::Vector2d principal_stretches(const std::array<int, 6>& nodes, const std::vector<Eigen::Vector2d>& flat, const std::vector<Eigen::Vector3d>& placed) {
  Eigen::Matrix2d rest;
  rest << flat[nodes[1]] - flat[nodes[0]], flat[nodes[2]] - flat[nodes[0]];
  Eigen::Matrix<double, 3, 2> now;
  now << placed[nodes[1]] - placed[nodes[0]], placed[nodes[2]] - placed[nodes[0]];
  const Eigen::Matrix<double, 3, 2> gradient = now * rest.inverse();
  return gradient.jacobiSvd().singularValues();
}

/// Stretches from which the rest metric is reached (FabricMembrane).
inline bool can_start(const Eigen::Vector2d& stretch) { return stretch[1] >= 0.3 && stretch[0] <= 3.0; }

}  // namespace snug::mesh
