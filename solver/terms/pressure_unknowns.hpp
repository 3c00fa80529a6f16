// Where the pressure unknowns of tetrahedra stand: one a vertex and layer.
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

}  // namespace snug::solver
