// The structured brick behind the body mesh, in integer coordinates: round x along x outwards.
#pragma once

#include <array>
#include <compare>
#include <string>
#include <vector>

namespace snug::mesh {

/// Integer coordinates of a node: cell corners are even, mid-nodes odd. i round (0 .. 2 around), j along, k outwards.
struct LatticeKey {
  int i = 0, j = 0, k = 0;
  auto operator<=>(const LatticeKey&) const = default;
};

struct LatticeLayer {
  std::string name;
  int cells = 1;  ///< through the layer
};

struct Lattice {
  std::vector<LatticeKey> nodes;
  std::vector<std::array<int, 27>> cells;  ///< tensor order: node (i, j, k) at 9 k + 3 j + i
  std::vector<int> cell_layer;
};

/// A brick of `around` x `along` cells and the layers on top of each other, one gmsh volume and physical group a layer,
/// made transfinite and quadratic by gmsh and closed round the body: i = 2 around is the same node as i = 0.
Lattice make_lattice(int around, int along, const std::vector<LatticeLayer>& layers);

}  // namespace snug::mesh
