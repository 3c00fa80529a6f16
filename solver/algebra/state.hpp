// The state of a scene: a value. Copy it to keep it, assign it to go back.
#pragma once

#include <Eigen/Core>

namespace snug::solver {

/// Where the parts of a scene stand in the state vector. Parts that a scene lacks have no entries.
/// Body and garment entries are current positions (m), three a node; multipliers are contact pressures per rest area
/// of the garment (Pa), one a garment vertex. Pressures are those of the body's tetrahedra (Pa). The fields of hexahedra
/// (dilatation less one, then pressure in Pa, cell by cell) have no unknowns: their step follows from that of the positions.
struct Layout {
  int body_nodes = 0, garment_nodes = 0, pressures = 0, cell_fields = 0, multipliers = 0;
  int body(int node, int component = 0) const { return 3 * node + component; }
  int garment(int node, int component = 0) const { return 3 * (body_nodes + node) + component; }
  int pressure(int i) const { return 3 * (body_nodes + garment_nodes) + i; }
  int cell_field(int i) const { return pressure(pressures) + i; }
  int multiplier(int i) const { return cell_field(cell_fields) + i; }
  int size() const { return multiplier(multipliers); }
};

struct State {
  Eigen::VectorXd values;  ///< see Layout
  double load = 0.0;       ///< s: 0 = placed and strain-free, 1 = the garment's rest metric is its pattern's
  /// History of friction, empty where there is none: `values` at the last accepted state, and the traction of the skin's
  /// slip there (Pa per rest area of the garment; three corners a triangle, three components each).
  Eigen::VectorXd reference, traction;
  /// What of friction's bound there is: the bound is mu p / release, so that 1 is Coulomb's law and 0 sticks without a bound.
  double release = 1.0;
  double stiffening = 1.0; ///< factor on the body's own energy while it is released under the garment; 1 at the end
};

}  // namespace snug::solver
