// A body from the model of another program.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

/// Makes the body that `spec.mesh` (APDL text, CDB or CalculiX input) describes, in SI with spec.unit and
/// spec.force_unit. Materials are the layers, with their own laws unless spec.layers names others; node sets are the named
/// surfaces; forces, supports and pressures come along. Hexahedra of 8 and 20 nodes become 27-node ones (Q1/P0 where the
/// case asks for it), tetrahedra quadratic ones; wedges and pyramids, and what stands beside them, are cut into tetrahedra. Nodes that are added are held where all those they lie between are.
/// Forces at all nodes of a face act as the traction that they stand for in the file. Files that it includes lie in `root`.
/// Throws input::InputError with file and line of what cannot be taken over.
BodyMesh import_model(const input::BodySpec& spec, const std::filesystem::path& root = {});

/// The same for a model that was read before.
BodyMesh body_of(const Model& model, const input::BodySpec& spec);

}  // namespace snug::mesh
