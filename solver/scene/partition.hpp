// Which rank owns which entry of the state.
#pragma once

#include <vector>

#include "mesh/garment/garment_mesh.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// The rank of every entry. Cells of a deformable body are shared out by METIS and a garment triangle goes to the rank of
/// the nearest skin facet; without such a body METIS shares out the triangles. A node belongs to the lowest rank that
/// has an element at it, a multiplier to the rank of its vertex. The same on every rank.
std::vector<int> entry_owners(const Model& model, const Meshes& meshes, const Layout& layout, int ranks);

}  // namespace snug::solver
