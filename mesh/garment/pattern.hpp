// Flat pattern pieces cut into quadratic triangles.
#pragma once

#include <Eigen/Core>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace snug::mesh {

/// A meshed flat piece: straight P2 triangles (vertices 0 1 2, mid-edge nodes 01 12 20), counter-clockwise.
struct PatternMesh {
  std::vector<Eigen::Vector2d> nodes;  ///< m
  std::vector<std::array<int, 6>> triangles;
  std::map<std::string, std::vector<int>> sides;  ///< nodes on a named side, mid-edge nodes too, in order along it
};

/// The rectangle [0, width] x [0, length] in irregular triangles of about `cell_size` (Delaunay, not a regular grid).
/// Sides "lower" and "upper" run along x; "left" and "right" along y with equal divisions, so that their nodes pair. `borders`: heights
/// in (0, length), ascending, at which sides of triangles run across.
PatternMesh mesh_rectangle(double width, double length, double cell_size, const std::vector<double>& borders = {});

/// Mean length of the triangles' edges, m.
double mean_edge_length(const PatternMesh& pattern);

}  // namespace snug::mesh
