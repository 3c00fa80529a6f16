// A shell body from the physical surfaces of a gmsh file.
#pragma once

#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

/// The open gmsh model's physical surfaces that spec.layers names, with their thickness and foundation. Throws
/// input::InputError naming surface and remedy.
BodyMesh import_shell(const input::BodySpec& spec);

}  // namespace snug::mesh
