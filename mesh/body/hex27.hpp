// The quadratic hexahedron of the body mesh: shape functions on the reference cube [0, 1]^3 in tensor order.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace snug::mesh {

struct SamplePoint {
  Eigen::Vector3d reference;
  double weight = 0.0;  ///< 0 where the point is only looked at
};

/// The 3 x 3 x 3 Gauss points (weights add up to 1) followed by the 27 nodes (weight 0).
const std::vector<SamplePoint>& hex27_samples();

/// dx/dreference at a reference point; columns are the tangents along i, j and k.
Eigen::Matrix3d hex27_jacobian(const std::array<Eigen::Vector3d, 27>& nodes, const Eigen::Vector3d& reference);

}  // namespace snug::mesh
