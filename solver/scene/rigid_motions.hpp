// Rigid motions of the body that no support takes: without one of them the system is singular.
#pragma once

#include <Eigen/Core>

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "mesh/body/body_mesh.hpp"

namespace snug::solver {

/// A component of a node.
using NodeComponent = std::pair<int, int>;

/// A node that keeps its place along a direction.
struct NodeLine {
  int node = 0;
  Eigen::Vector3d along = Eigen::Vector3d::UnitX();
};

/// A connected part of the body that supports hold in part, or not at all.
struct FreePart {
  std::string name;         ///< "the body", or by layer and middle where there are several parts
  std::vector<int> nodes;   ///< ascending
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< m, mean of the nodes
  double size = 0.0;        ///< m, largest distance of a node from the centre
  /// Orthonormal columns (t, size w): shift t and turn w about the centre, x -> x + t + w x (x - centre).
  Eigen::Matrix<double, 6, Eigen::Dynamic> motions;
};

/// The parts with free motions when the components `held` keep their place, and nodes along lines. Edges of a shell whose angle is held and its
/// elastic foundation count as supports.
std::vector<FreePart> free_parts(const mesh::BodyMesh& mesh, const std::set<NodeComponent>& held, const std::vector<NodeLine>& lines = {});

/// "to move along x and y and to turn about z".
std::string motions_text(const FreePart& part);

/// As many components as the part has free motions, which hold all of them: each the one that the motions left move
/// furthest, the first of equal ones, at none of the nodes `without`.
std::vector<NodeComponent> determinate_supports(const FreePart& part, const mesh::BodyMesh& mesh, const std::set<int>& without = {});

/// What forces at the nodes of the body (N, one a node) do along the free motions of a part.
struct NetLoad {
  Eigen::Vector3d force = Eigen::Vector3d::Zero();   ///< N, along the free shifts
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  ///< N m about the centre, along the free turns
  bool balanced = true;  ///< to a millionth of the sum of the forces
};
NetLoad net_load(const FreePart& part, const mesh::BodyMesh& mesh, const std::vector<Eigen::Vector3d>& forces);

}  // namespace snug::solver
