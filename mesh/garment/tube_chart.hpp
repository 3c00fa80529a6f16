// Where the points of a sewn garment lie on the tube that it is: how far round, and how far up.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::mesh {

/// Coordinates of the vertices of a sewn garment that goes round one limb, made of its flat pieces alone. Of nodes that become one the
/// representative has them; mid-edge nodes have none.
struct TubeChart {
  std::vector<double> round;  ///< turns, counter-clockwise seen from above; modulo 1
  std::vector<double> up;     ///< m along the cloth, 0 at its lowest point
};

/// `round` is the harmonic function that grows by 1 once round (natural at hems and holes: it makes turns of equal width); `up` is
/// the function whose gradient is nearest to the unit vectors at right angles to that of `round`, so that it measures lengths on the
/// cloth. Both are exact for a tube and, with `up` along the generators, for a cone, however they are cut into pieces. Linear triangles between
/// vertices, the weights of the cotangents (Pinkall & Polthier, Exp. Math. 2 (1993) 15-36).
/// `bottom` names the open edge that lies lowest; empty: the loop that the drawings have lowest, or the shorter one of two that
/// they have equally high. Throws input::InputError at `where` for a garment of several parts, with less than two openings, or with handles.
TubeChart tube_chart(const SewnMesh& sewn, const std::string& bottom, const input::Location& where);

/// Loops of vertices at which the sewn garment ends, representatives in order with the cloth on the left.
std::vector<std::vector<int>> open_loops(const SewnMesh& sewn);

}  // namespace snug::mesh
