// Vertices of a sewn garment slide over the surface it lies on until its pieces are as little distorted as can be.
#pragma once

#include <vector>

#include "mesh/garment/limb_sheet.hpp"
#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::mesh {

/// Where a vertex lies on a limb: share of the way round (modulo 1), and height, m.
struct ChartPlace {
  double share = 0.0, height = 0.0;
};

/// Moves the places of the vertices (by representative) to where, in the tangent plane of each triangle's middle, the forces of
/// E = sum of A |F - R|^2 balance, R the isometry nearest to the gradient F = T Q (T: tangents of the surface there, Q: gradient in the
/// coordinates of the surface). With T and R of the last places that is one linear system. What would pull the cloth along the limb because the limb
/// tapers is left out, as friction holds it: a tube keeps its heights. No triangle is turned over.
void slide(const SewnMesh& sewn, const LimbSheet& sheet, std::vector<ChartPlace>& places);

}  // namespace snug::mesh
