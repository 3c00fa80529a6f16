// Triangles in one flat piece whose border is already divided.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace snug::mesh {

struct PieceMesh {
  std::vector<Eigen::Vector2d> vertices;      ///< m; those of the border first, in the order given
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise
};

/// Triangles between polygons: the outline counter-clockwise, then holes clockwise; the sides of the polygons are sides
/// of triangles. `same` gives each border vertex a number of what it will be merged into: no triangle has an inner side
/// between two vertices that become one, which would fold it. Edges inside are as long as those of the border nearby,
/// `cell_size` (m) far from it. Throws std::runtime_error with gmsh's reason where the polygons bound nothing.
PieceMesh mesh_piece(const std::vector<std::vector<Eigen::Vector2d>>& loops, const std::vector<int>& same,
                     double cell_size);

}  // namespace snug::mesh
