#include "mesh/body/lattice.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <unordered_map>

#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {

namespace {

constexpr int gmsh_hex27 = 12;

/// The rectangle [0, around] x [0, along] of unit quadrilaterals at height 0.
int make_base(int around, int along) {
  namespace geo = gmsh::model::geo;
  const double w = around, h = along;
  const std::array<int, 4> points = {geo::addPoint(0, 0, 0), geo::addPoint(w, 0, 0), geo::addPoint(w, h, 0),
                                     geo::addPoint(0, h, 0)};
  std::vector<int> lines;
  for (int n = 0; n < 4; ++n) {
    lines.push_back(geo::addLine(points[n], points[(n + 1) % 4]));
    geo::mesh::setTransfiniteCurve(lines.back(), (n % 2 == 0 ? around : along) + 1);
  }
  const int surface = geo::addPlaneSurface({geo::addCurveLoop(lines)});
  geo::mesh::setTransfiniteSurface(surface, "Left", {points[0], points[1], points[2], points[3]});
  geo::mesh::setRecombine(2, surface);
  return surface;
}

/// Extrudes the layers one after the other; returns the volume of each.
std::vector<int> extrude_layers(int surface, const std::vector<LatticeLayer>& layers) {
  std::vector<int> volumes;
  for (const LatticeLayer& layer : layers) {
    gmsh::vectorpair made;
    gmsh::model::geo::extrude({{2, surface}}, 0, 0, layer.cells, made, {layer.cells}, {}, true);
    surface = made.at(0).second;  // gmsh lists the far face first, then the volume
    volumes.push_back(made.at(1).second);
  }
  gmsh::model::geo::synchronize();
  for (std::size_t n = 0; n < layers.size(); ++n) {
    const int group = gmsh::model::addPhysicalGroup(3, {volumes[n]});
    gmsh::model::setPhysicalName(3, group, layers[n].name);
  }
  return volumes;
}

std::unordered_map<std::size_t, LatticeKey> read_keys() {
  std::vector<std::size_t> tags;
  std::vector<double> coordinates, parameters;
  gmsh::model::mesh::getNodes(tags, coordinates, parameters);
  std::unordered_map<std::size_t, LatticeKey> keys;
  for (std::size_t n = 0; n < tags.size(); ++n) {
    std::array<int, 3> key;
    for (int a = 0; a < 3; ++a) {
      const double twice = 2.0 * coordinates[3 * n + a];
      key[a] = static_cast<int>(std::lround(twice));
      if (std::abs(twice - key[a]) > 1e-6) throw std::logic_error("gmsh: brick node off the lattice");
    }
    keys[tags[n]] = {key[0], key[1], key[2]};
  }
  return keys;
}

/// The nodes of one cell in tensor order, as keys.
std::array<LatticeKey, 27> tensor_order(const std::size_t* tags,
                                        const std::unordered_map<std::size_t, LatticeKey>& keys) {
  LatticeKey low = keys.at(tags[0]);
  for (int n = 1; n < 27; ++n) {
    const LatticeKey& key = keys.at(tags[n]);
    low = {std::min(low.i, key.i), std::min(low.j, key.j), std::min(low.k, key.k)};
  }
  std::array<LatticeKey, 27> ordered;
  for (int n = 0; n < 27; ++n) {
    const LatticeKey& key = keys.at(tags[n]);
    ordered.at(9 * (key.k - low.k) + 3 * (key.j - low.j) + (key.i - low.i)) = key;
  }
  return ordered;
}

struct BrickCells {
  std::vector<std::array<LatticeKey, 27>> nodes;
  std::vector<int> layer;
};

BrickCells read_cells(const std::vector<int>& volumes) {
  const auto keys = read_keys();
  BrickCells cells;
  for (std::size_t layer = 0; layer < volumes.size(); ++layer) {
    std::vector<std::size_t> elements, nodes;
    gmsh::model::mesh::getElementsByType(gmsh_hex27, elements, nodes, volumes[layer]);
    for (std::size_t e = 0; e < elements.size(); ++e) {
      cells.nodes.push_back(tensor_order(&nodes[27 * e], keys));
      cells.layer.push_back(static_cast<int>(layer));
    }
  }
  return cells;
}

}  // namespace

Lattice make_lattice(int around, int along, const std::vector<LatticeLayer>& layers) {
  const GmshSession session;
  gmsh::model::add("body");
  const std::vector<int> volumes = extrude_layers(make_base(around, along), layers);
  gmsh::model::mesh::generate(3);
  gmsh::model::mesh::setOrder(2);
  const BrickCells brick = read_cells(volumes);

  std::size_t expected = 0;
  for (const LatticeLayer& layer : layers) expected += static_cast<std::size_t>(around) * along * layer.cells;
  if (brick.nodes.size() != expected) throw std::logic_error("gmsh: the brick has an unexpected number of cells");

  std::map<LatticeKey, int> number;  // sorted, so that the numbering does not depend on gmsh
  for (const auto& cell : brick.nodes)
    for (LatticeKey key : cell) number[{key.i % (2 * around), key.j, key.k}] = 0;
  Lattice lattice;
  for (auto& [key, node] : number) {
    node = static_cast<int>(lattice.nodes.size());
    lattice.nodes.push_back(key);
  }
  for (const auto& cell : brick.nodes) {
    auto& nodes = lattice.cells.emplace_back();
    for (int n = 0; n < 27; ++n) nodes[n] = number.at({cell[n].i % (2 * around), cell[n].j, cell[n].k});
  }
  lattice.cell_layer = brick.layer;
  return lattice;
}

}  // namespace snug::mesh
