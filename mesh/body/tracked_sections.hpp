// The sections of one limb of a scan, followed from the lower cut plane to the upper one.
#pragma once

#include <string>
#include <vector>

#include "mesh/body/limb.hpp"
#include "mesh/body/sections.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// A scan turned into the frame of the body, in metres, with the points of its cut planes.
struct OrientedScan {
  TriangleSurface surface;
  Eigen::Vector3d lower, upper;
  std::vector<std::string> said = {};    ///< what was guessed
  std::vector<std::string> mended = {};  ///< what was mended between the cut planes
};

/// Reads the surface of `spec` and turns its axes. Throws input::InputError: no such file, up and front not two
/// different axes, unit not positive, cut planes tilted by more than 20 degrees or in the wrong order, a hole wider than
/// `fill_holes` between them. A surface that is not closed there is mended (mesh/surface/mending).
OrientedScan read_scan(const input::ScanSpec& spec, const input::Location& where);

/// Sections at z0 + n dz.
struct TrackedSections {
  double z0 = 0.0, dz = 0.0;
  std::vector<SectionLoop> loops;
};

/// Section nearest to the point of the lower cut plane. Throws input::InputError when there is none.
SectionLoop lower_section(const OrientedScan& scan, const input::Location& where);

/// Follows the limb from its lower to its upper cut plane with a spacing of at most `spacing`, and up to `margin`
/// beyond both as long as the limb goes on there (smoothing wants neighbours). Throws input::InputError with the height
/// where the limb joins another part of the body or ends between the planes, or when the planes' points are on
/// different parts.
TrackedSections track_sections(const OrientedScan& scan, double spacing, double margin, const input::Location& where);

}  // namespace snug::mesh
