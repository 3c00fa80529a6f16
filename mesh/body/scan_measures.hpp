// How a body from a scan compares with the scan: girths, volume, distance.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/body/scan_report.hpp"
#include "mesh/surface/cutting.hpp"
#include "mesh/surface/smooth_surface.hpp"

namespace snug::mesh {

/// Perimeter of a rim, in the units of the surface.
double length_of(const TriangleSurface& surface, const Rim& rim);

/// Distances of the kept scan's vertices to the smooth surface into `report`.
void measure_deviation(const SmoothSurface& smooth, const TriangleSurface& kept, ScanReport& report);

/// Girths of the largest outline at heights all over the body into `report.sections`.
void measure_sections(const BodyMesh& mesh, const TriangleSurface& closed_scan, ScanReport& report);

/// Girth of mesh and scan at a cut (a hair inside of it).
CutRow cut_row(const BodyMesh& mesh, const TriangleSurface& closed_scan, const Cut& cut);

/// Volume inside skin and cuts, whatever is meshed of it, m3.
double volume_between(const BodyMesh& mesh);

/// Volume inside a surface of the body and the cuts, m3.
double volume_inside(const BodyMesh& mesh, const std::string& surface);

/// The curved skin as flat triangles, `parts` to an edge.
TriangleSurface fine_skin(const BodyMesh& mesh, int parts);

}  // namespace snug::mesh
