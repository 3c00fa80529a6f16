// How far the cells of a body are strained.
#pragma once

#include <Eigen/Core>

#include "mesh/body/body_mesh.hpp"

namespace snug::solver {

/// Extremes over the Gauss points of all cells, and where they are in the reference body.
struct BodyStrain {
  double largest_stretch = 1.0, smallest_volume_ratio = 1.0;  ///< principal stretch; J = det F
  Eigen::Vector3d stretched_at = Eigen::Vector3d::Zero(), squeezed_at = Eigen::Vector3d::Zero();  ///< m
};

/// `displacement`: one a node, m.
BodyStrain body_strain(const mesh::BodyMesh& body, const std::vector<Eigen::Vector3d>& displacement);

}  // namespace snug::solver
