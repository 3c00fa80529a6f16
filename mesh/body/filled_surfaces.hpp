// The space between the surfaces of a scanned body, filled with quadratic tetrahedra.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/body/scanned_surfaces.hpp"

namespace snug::mesh {

/// gmsh meshes the faces of the cuts and fills each layer; the cells' edges get the surfaces' curves. Surfaces of the body are those given, and the
/// cuts by their names. Throws NotMeshed where other cells may do.
BodyMesh filled_body(const input::BodySpec& spec, const Layering& layering, const ScannedSurfaces& surfaces, ScanReport& report);

}  // namespace snug::mesh
