// Which rank owns which entry of the state.
#pragma once

#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/algebra/layout.hpp"

namespace snug::solver {

/// The rank of every entry. Cells of a deformable body are shared out by METIS and a garment triangle goes to the rank of
/// the nearest skin facet; without such a body METIS shares out the triangles. A node belongs to the lowest rank that
/// has an element at it, a multiplier to the rank of its vertex. The same on every rank.
std::vector<int> entry_owners(const Layout& layout, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                              const std::vector<int>& node_of_multiplier, int ranks);

}  // namespace snug::solver
