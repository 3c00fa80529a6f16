// Named patches of skin, found on any mesh of a body.
#pragma once

#include "cases/input/body_spec.hpp"
#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

/// Fills `locations`, `node_location` and `location_shares` of a mesh whose nodes and surface "skin" are there: a node, and a point between nodes,
/// goes to the first patch that holds it.
/// Throws input::InputError for a landmark that is far from the skin (more than its radius) and for a patch that holds no node;
/// a landmark of a standard body (`where_there`) is left out there, where it lies farther from the skin than half its radius, and where the skin ends
/// within that.
void assign_locations(const std::vector<input::LocationSpec>& locations, BodyMesh& mesh);

}  // namespace snug::mesh
