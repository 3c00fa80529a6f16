// A shell body from the physical surfaces of a gmsh file.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/gmsh_file.hpp"

namespace snug::mesh {

/// A gmsh file's physical surfaces that spec.layers names, with their thickness and foundation. Throws
/// input::InputError naming surface and remedy.
BodyMesh import_shell(const input::BodySpec& spec, const GmshMesh& file);

/// Turns the skin's facets of a shell body so that their normals point outwards, each connected piece away from its middle: where a
/// garment lies on it. The triangles of the shell stay as the file has them.
void turn_skin_outwards(BodyMesh& body);

}  // namespace snug::mesh
