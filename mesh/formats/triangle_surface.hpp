// A triangulated surface as scanners and modelling programs write it.
#pragma once

#include <Eigen/Core>

#include <array>
#include <filesystem>
#include <optional>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::mesh {

/// Indexed triangles; coordinates in the units and axes of the file until somebody changes them.
struct TriangleSurface {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<int, 3>> triangles;
};

/// Reads OBJ, STL (text or binary), PLY, OFF or plain text of `v x y z` and `f a b c` lines between `begin` and `end`; which one
/// is told by the content, not by the name. Polygons are cut into fans, coincident vertices are welded and collapsed
/// triangles dropped. Throws input::InputError with file, line and remedy.
TriangleSurface read_surface(const std::filesystem::path& path);

/// Merges vertices nearer to each other than `tolerance` (0: 1e-7 of the surface's diagonal), drops triangles that lose
/// a corner that way, and vertices that no triangle uses.
TriangleSurface weld(const TriangleSurface& surface, double tolerance = 0.0);

/// Programs write coordinates with six or seven digits, so that the two sides of a seam part by some of the last one. Where welding
/// at 1e-5 of the diagonal closes open edges and loses no triangle, the surface is that; else as given.
TriangleSurface seams_closed(TriangleSurface surface);

/// Range of heights that a check looks at, in the units of the surface.
struct HeightRange {
  double lower = 0.0, upper = 0.0;
};

/// Throws input::InputError (at `where`) with the coordinates of an edge that does not belong to exactly two triangles.
/// With a range only edges that reach into it count: scans are often open at the head or under the feet.
void check_closed(const TriangleSurface& surface, const input::Location& where, std::optional<HeightRange> range = {});

}  // namespace snug::mesh
