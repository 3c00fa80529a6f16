#include "solver/terms/pressure_unknowns.hpp"

#include <map>

namespace snug::solver {

PressureUnknowns pressure_unknowns(const mesh::BodyMesh& mesh) {
  PressureUnknowns unknowns;
  if (mesh.kind != mesh::CellKind::tet10) return unknowns;
  std::map<std::pair<int, int>, int> number;  // vertex, layer
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    auto& of_cell = unknowns.of_cell.emplace_back();
    for (int v = 0; v < 4; ++v) {
      const auto [it, fresh] =
          number.emplace(std::pair{mesh.cells[c][v], mesh.cell_layer[c]}, static_cast<int>(unknowns.layer.size()));
      if (fresh) unknowns.layer.push_back(mesh.cell_layer[c]);
      of_cell[v] = it->second;
    }
  }
  return unknowns;
}

}  // namespace snug::solver
