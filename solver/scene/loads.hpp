// The loads of a case as terms of the scene.
#pragma once

#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Adds follower pressures, and tractions, forces and weight as one dead load. Throws input::InputError where a load
/// names a surface that is not there or has no facets.
void add_loads(const input::LoadSpec& load, const mesh::BodyMesh& body, Scene& scene);

}  // namespace snug::solver
