// The inside of an elastic bone: a square of hexahedra in the middle, closed by the rings of the lattice round it.
#pragma once

#include "mesh/body/lattice.hpp"
#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// The border of the inner square at height z: a square on the bone's outline at the turns 0, 1/4, 1/2, 3/4, drawn in to
/// half its size and bulged, so that neither its cells nor those of the ring round it have flat angles.
class CoreBorder {
 public:
  CoreBorder(const Outline& bone, double z);
  Eigen::Vector3d at(double turn) const;

 private:
  const Outline& bone_;
  double z_;
  Eigen::Vector2d centre_;
  std::array<Eigen::Vector2d, 4> corner_;
};

/// Fills the square: appends its nodes (keys with i = k = -1) and cells of layer 0 to a lattice whose nodes at k = 0 stand
/// on the border, one position in `nodes` each. `around` cells round, a multiple of 4; `along` cells along.
void fill_core(int around, int along, Lattice& lattice, std::vector<Eigen::Vector3d>& nodes);

}  // namespace snug::mesh
