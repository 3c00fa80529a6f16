#include "mesh/formats/calculix.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <set>
#include <stdexcept>

namespace snug::mesh {

namespace {

/// Place in tensor order (9 k + 3 j + i) of the twenty nodes as CalculiX counts them: corners below (k = 0) and above,
/// then the middles of the edges below, above and between.
constexpr std::array<int, 20> twenty = {0, 2, 8, 6, 18, 20, 26, 24, 1, 5, 7, 3, 19, 23, 25, 21, 9, 11, 17, 15};
/// The face k = 2 lies between the nodes 5 6 7 8.
constexpr const char* outer_face = "P2";

std::set<int> used_nodes(const BodyMesh& mesh) {
  std::set<int> used;
  for (const auto& cell : mesh.cells)
    for (const int n : twenty) used.insert(cell[n]);
  return used;
}

void write_nodes(std::ostream& out, const BodyMesh& mesh, const std::set<int>& used) {
  out << "*NODE\n";
  for (const int n : used)
    fmt::print(out, "{}, {:.12g}, {:.12g}, {:.12g}\n", n + 1, mesh.nodes[n].x(), mesh.nodes[n].y(), mesh.nodes[n].z());
}

void write_layer(std::ostream& out, const BodyMesh& mesh, int layer, const NeoHookeConstants& material) {
  fmt::print(out, "*ELEMENT, TYPE=C3D20R, ELSET=LAYER{}\n", layer + 1);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    if (mesh.cell_layer[c] != layer) continue;
    fmt::print(out, "{}", c + 1);
    for (std::size_t n = 0; n < twenty.size(); ++n)
      fmt::print(out, ",{}{}", n == 10 ? "\n" : " ", mesh.cells[c][twenty[n]] + 1);
    out << '\n';
  }
  fmt::print(out,
             "*MATERIAL, NAME=MATERIAL{0}\n*HYPERELASTIC, NEO HOOKE\n{1:.15g}, {2:.15g}\n"
             "*SOLID SECTION, ELSET=LAYER{0}, MATERIAL=MATERIAL{0}\n",
             layer + 1, 0.5 * material.shear_modulus, 2.0 / material.bulk_modulus);
}

template <class Nodes>
void write_set(std::ostream& out, const char* name, const Nodes& nodes, const std::set<int>& used) {
  fmt::print(out, "*NSET, NSET={}\n", name);
  for (const int n : nodes)
    if (used.contains(n)) fmt::print(out, "{},\n", n + 1);
}

/// The element below each skin facet, known by the facet's middle node.
std::vector<std::size_t> skin_cells(const BodyMesh& mesh) {
  std::set<int> middles;
  for (const auto& facet : mesh.skin_facets) middles.insert(facet[4]);
  std::vector<std::size_t> cells;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (middles.contains(mesh.cells[c][22])) cells.push_back(c);
  return cells;
}

}  // namespace

void write_calculix(std::ostream& out, const BodyMesh& mesh, const std::vector<NeoHookeConstants>& materials,
                    double skin_pressure) {
  if (materials.size() != mesh.layers.size()) throw std::invalid_argument("one material a layer is needed");
  if (mesh.kind != CellKind::hex27 || !mesh.surface("lower") || mesh.bone_nodes.empty())
    throw std::invalid_argument("only a limb of 27-node hexahedra on a rigid bone can be written");
  const std::set<int> used = used_nodes(mesh);
  out << "*HEADING\nbody, SI\n";
  write_nodes(out, mesh, used);
  for (std::size_t layer = 0; layer < materials.size(); ++layer)
    write_layer(out, mesh, static_cast<int>(layer), materials[layer]);
  std::set<int> skin;
  for (const auto& facet : mesh.skin_facets) skin.insert(facet.begin(), facet.end());
  write_set(out, "BONE", mesh.bone_nodes, used);
  write_set(out, "LOWER", mesh.surface("lower")->nodes, used);
  write_set(out, "UPPER", mesh.surface("upper")->nodes, used);
  write_set(out, "SKIN", skin, used);
  out << "*BOUNDARY\nBONE, 1, 3\nLOWER, 3, 3\nUPPER, 3, 3\n*STEP, NLGEOM, INC=100\n*STATIC\n1., 1.\n*DLOAD\n";
  for (const std::size_t c : skin_cells(mesh)) fmt::print(out, "{}, {}, {:.15g}\n", c + 1, outer_face, skin_pressure);
  out << "*NODE PRINT, NSET=SKIN\nU\n*NODE FILE\nU\n*END STEP\n";
}

}  // namespace snug::mesh
