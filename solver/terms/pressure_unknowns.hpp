// Where the pressures of the body stand: unknowns of tetrahedra, one a vertex and layer; modes of a hexahedron.
#pragma once

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"

namespace snug::solver {

struct PressureUnknowns {
  std::vector<std::array<int, 4>> of_cell;  ///< at the vertices of each tetrahedron
  std::vector<int> layer;                   ///< of each unknown
};

/// None for hexahedra, whose pressure is condensed in the cell.
PressureUnknowns pressure_unknowns(const mesh::BodyMesh& mesh);

/// Pressures (and dilatations) of one hexahedron: 4 in Q2/P1, 1 in Q1/P0; none of a tetrahedron.
constexpr int pressure_modes(mesh::CellKind kind) {
  return kind == mesh::CellKind::hex27 ? 4 : kind == mesh::CellKind::hex8 ? 1 : 0;
}

}  // namespace snug::solver
