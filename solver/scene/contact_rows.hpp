// What each contact of a garment carries, as rows of the result.
#pragma once

#include <vector>

#include "postproc/result.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Whether a facet of the contact's master is one of the skin's, and its number there.
bool on_skin(const MasterStack& master, int facet);
int skin_facet(const MasterStack& master, int facet);

/// One row for each surface that a garment may meet, "bandage on stocking", "bandage on skin": forces between the two, and the
/// area of the garment (as it is) that bears on it.
std::vector<postproc::SurfaceContact> contact_rows(const Touch& touch, const State& state);

/// Whether some garment of the scene may meet another one.
bool has_layers(const Scene& scene);

}  // namespace snug::solver
