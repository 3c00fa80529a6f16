// A body of tetrahedra from a scan with any number of cuts.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/body/scan_report.hpp"

namespace snug::mesh {

struct ScannedBody {
  BodyMesh mesh;
  ScanReport report;
};

/// The body of `spec.scan` in quadratic tetrahedra: the surface is mended, cut at each plane where the limb at its point passes through, remeshed
/// with edges of `cell_size`, drawn onto a smooth surface (smooth_surface.hpp) with the nodes on its edges; layers with a thickness lie that far under
/// the skin (those inside the layer without one: over the core); gmsh fills it. Surfaces: "skin", "bone" (the core, where it is rigid), each cut
/// by its name, and between two layers "INNER to OUTER". Throws input::InputError with place and remedy where no such body can be made.
ScannedBody body_from_scan(const input::BodySpec& spec);

/// Whether body_from_scan makes the body (or limb_from_scan and make_body_mesh), and why.
struct CellChoice {
  bool tetrahedra = false;
  std::string reason;
};
CellChoice choose_cells(const input::BodySpec& spec);

/// The same body with its two named cuts as the lower and the upper one; as it is where it has these, or another number of cuts.
input::BodySpec with_lower_and_upper(const input::BodySpec& spec);
/// Gives the faces "lower" and "upper" of a limb the names of its two cuts as well.
void name_cuts(const input::BodySpec& spec, BodyMesh& mesh);

}  // namespace snug::mesh
