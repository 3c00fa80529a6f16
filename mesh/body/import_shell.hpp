// A shell body from the physical surfaces of a gmsh file.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/gmsh_file.hpp"

namespace snug::mesh {

/// A gmsh file's physical surfaces that spec.layers names, with their thickness and foundation. Throws
/// input::InputError naming surface and remedy.
BodyMesh import_shell(const input::BodySpec& spec, const GmshMesh& file);

}  // namespace snug::mesh
