// A body mesh from a gmsh file.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/gmsh_file.hpp"

namespace snug::mesh {

/// Reads `spec.mesh` by gmsh in a process of its own (read_gmsh_file): physical volumes are the layers that the case names, physical surfaces, curves
/// and points the named surfaces. A rigid layer is left out and the nodes it shares with the others are its bone nodes;
/// where the file has no such volume, the physical surface of that name is held instead. Straight cells are made
/// quadratic by gmsh unless Q1/P0 is asked for. Throws input::InputError naming volume, cell number, place and remedy.
BodyMesh import_body_mesh(const input::BodySpec& spec, GmshOptions options = {});

}  // namespace snug::mesh
