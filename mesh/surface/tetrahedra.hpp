// Volumes between triangulated surfaces filled with tetrahedra by gmsh, and plane polygons with triangles.
#pragma once

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace snug::mesh {

/// Patches of triangles that share nodes, and the regions that some of them enclose.
struct PatchComplex {
  struct Patch {
    std::string name;
    std::vector<std::array<int, 3>> triangles;
  };
  struct Region {
    std::string name;
    std::vector<int> patches;
  };
  std::vector<Eigen::Vector3d> nodes;
  std::vector<Patch> patches;
  std::vector<Region> regions;
};

struct Tetrahedra {
  std::vector<Eigen::Vector3d> nodes;  ///< those of the complex, then those inside
  std::vector<std::array<int, 4>> cells;
  std::vector<int> region;  ///< of each cell
};

/// Sizes inside go over from those of the patches. gmsh works in a process of its own. Throws std::runtime_error with gmsh's words.
Tetrahedra filled(const PatchComplex& complex);

/// Triangles inside `outer` (counter-clockwise) and outside `holes`; nodes are the points of outer, of the holes, then new ones. Throws
/// std::runtime_error.
struct PlaneMesh {
  std::vector<Eigen::Vector2d> nodes;
  std::vector<std::array<int, 3>> triangles;
};
PlaneMesh filled(const std::vector<Eigen::Vector2d>& outer, const std::vector<std::vector<Eigen::Vector2d>>& holes);

}  // namespace snug::mesh
