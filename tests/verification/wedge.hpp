// A wedge round an axis, of quadratic tetrahedra: bodies of revolution by a slice.
#pragma once

#include <map>
#include <set>

#include "tests/verification/blocks.hpp"

namespace snug::tests {

/// Cells of a wedge whose nodes on the axis stand several times at one place: names them once, straightens the edges that
/// were diagonals of hexahedra, and leaves out the tetrahedra without volume.
inline void close_at_axis(BodyMesh& mesh) {
  std::map<double, int> on_axis;
  std::map<int, int> same;
  for (const int node : mesh.surface("left")->nodes) same[node] = on_axis.emplace(mesh.nodes[node].y(), node).first->second;
  const auto rename = [&](int& node) {
    if (const auto it = same.find(node); it != same.end()) node = it->second;
  };
  constexpr std::array<std::array<int, 2>, 6> edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};  // of nodes 4 .. 9
  std::map<std::pair<int, int>, std::pair<double, int>> middle;  // of the nodes that offer themselves the nearest to the chord
  for (auto& cell : mesh.cells) {
    std::for_each(cell.begin(), cell.begin() + 10, rename);
    for (int e = 0; e < 6; ++e) {
      const int p = cell[edges[e][0]], q = cell[edges[e][1]];
      const std::pair offer{(mesh.nodes[cell[4 + e]] - 0.5 * (mesh.nodes[p] + mesh.nodes[q])).norm(), cell[4 + e]};
      auto& best = middle.emplace(std::minmax(p, q), offer).first->second;
      best = std::min(best, offer);
    }
  }
  for (auto& cell : mesh.cells)
    for (int e = 0; e < 6; ++e) cell[4 + e] = middle.at(std::minmax(cell[edges[e][0]], cell[edges[e][1]])).second;
  std::erase_if(mesh.cells, [](const auto& cell) { return std::set<int>(cell.begin(), cell.begin() + 4).size() < 4; });
  mesh.cell_layer.resize(mesh.cells.size());
  for (auto& surface : mesh.surfaces) {
    std::for_each(surface.nodes.begin(), surface.nodes.end(), rename);
    std::vector<char> keep(mesh.nodes.size(), 0);
    for (const int node : surface.nodes) keep[node] = 1;
    surface.facets = boundary_facets(mesh, keep);
  }
}

}  // namespace snug::tests
