// Rings of tissue built of blocks, in plane strain.
#pragma once

#include "tests/verification/blocks.hpp"

namespace snug::tests {

/// A ring in plane strain: u round, v outwards.
inline BlockCase tube(double inner, double outer, std::array<int, 3> cells, const std::string& material, CellKind kind,
               double length = 5e-3) {
  Block block;
  block.cells = cells, block.kind = kind, block.closed = true;
  block.map = ring(inner, outer, length);
  BlockCase c(make_block(block), {material});
  c.hold("back", {}, {}, 0.0), c.hold("front", {}, {}, 0.0);
  return c;
}

inline double mean_radius(const BlockCase& c, const BlockAnswer& a, const std::string& surface) {
  double sum = 0.0;
  const auto& nodes = c.mesh.surface(surface)->nodes;
  for (const int node : nodes) sum += (c.mesh.nodes[node] + a.result.body.fields[postproc::field::displacement][node]).head<2>().norm();
  return sum / static_cast<double>(nodes.size());
}

}  // namespace snug::tests
