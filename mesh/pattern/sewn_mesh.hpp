// A pattern in triangles: flat pieces with equal divisions on both sides of every seam, and which nodes become one.
#pragma once

#include <Eigen/Core>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "mesh/garment/garment_mesh.hpp"
#include "mesh/pattern/checks.hpp"

namespace snug::mesh {

/// What placement and the solver need of a pattern, before it stands anywhere in space. Nodes on the two sides of a
/// seam are two in the flat pieces and one in `merged`; a triangle has the flat coordinates of its own piece.
struct SewnMesh {
  std::vector<std::string> pieces;
  std::vector<Eigen::Vector2d> flat;  ///< m, each node in the drawing of its piece seen from the outside
  std::vector<int> node_piece;        ///< node -> piece
  std::vector<std::array<int, 6>>
      triangles;  ///< straight P2: vertices 0 1 2, mid-edge nodes 01 12 20; counter-clockwise
  std::vector<int> triangle_piece;
  std::vector<Eigen::Vector2d> warp;  ///< per triangle: unit direction of the grain in the drawing
  std::vector<int> merged;            ///< node -> representative, the smallest number of those that become one
  std::vector<SewnSeam> seams;
  /// Nodes of "piece.edge" in its direction, mid-edge nodes too; both ends among them.
  std::map<std::string, std::vector<int>> edges;
  /// What stays open, by name: loops of the sewn garment (closed, the first node is not repeated) and hems that are a
  /// part of one. Representatives, in order, mid-edge nodes too.
  std::map<std::string, std::vector<int>> open;
  double mean_edge = 0.0;  ///< m
};

/// Meshes every piece with triangles of about `cell_size` (m) by gmsh. Curved edges become chords: areas and lengths
/// converge with the square of the cell size. Throws input::InputError when a piece cannot be meshed with cells of that
/// size.
SewnMesh mesh_pattern(const CheckedPattern& checked, double cell_size);

/// The mesh that the solver takes, once the garment stands somewhere: `placed` gives every node of the mesh its place,
/// m, frame of the body, the same to all nodes that become one. The pieces lie side by side in its pattern plane.
/// Throws std::invalid_argument when a place is missing or two nodes that become one have two.
GarmentMesh garment_mesh(const SewnMesh& sewn, const std::vector<Eigen::Vector3d>& placed, const std::string& name);

}  // namespace snug::mesh
