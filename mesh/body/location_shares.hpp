// How much of a node's area lies inside a location: means over locations do not hang on which nodes the mesh happens to have.
#pragma once

#include <functional>

#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

/// Index of the location that holds a point of a flat triangle between nodes of the skin (their numbers), or -1.
using LocationAt = std::function<int(const Eigen::Vector3d& x, const std::array<int, 3>& triangle)>;

/// For each of so many locations and each node the share, 0 to 1, of the node's area inside: with its hat N on the flat triangles between the
/// skin's nodes, share = (integral of N where `at` says so) / (integral of N), by the midpoint rule on each triangle cut into 16, or 144 where a border runs
/// through it. 0 for nodes off the skin. The locations' shares of a node add up to at most 1.
std::vector<std::vector<double>> location_shares(const BodyMesh& mesh, std::size_t locations, const LocationAt& at);

}  // namespace snug::mesh
