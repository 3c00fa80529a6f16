// The loads of a case as terms of the scene.
#pragma once

#include "solver/scene/scene.hpp"
#include "solver/terms/dead_load.hpp"

namespace snug::solver {

/// Tractions, forces and weight of the case and the forces of an imported body, N, one a node.
NodalForces dead_forces(const input::LoadSpec& load, const mesh::BodyMesh& body);
/// Follower pressures on the skin, on named surfaces and of an imported body.
std::vector<mesh::FacetPressure> surface_pressures(const input::LoadSpec& load, const mesh::BodyMesh& body);

/// Adds follower pressures, and tractions, forces and weight as one dead load. Throws input::InputError where a load
/// names a surface that is not there or has no facets.
void add_loads(const input::LoadSpec& load, const mesh::BodyMesh& body, Scene& scene);

}  // namespace snug::solver
