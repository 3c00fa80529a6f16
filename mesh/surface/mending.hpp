// Defects of scanned surfaces: found, mended where that does not change the shape, and each said.
#pragma once

#include <Eigen/Core>

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// One kind of defect that was mended: "12 faces twice", near a place of the surface.
struct Mending {
  std::string what;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< of the first one, in the surface's frame
};

/// A hole wider than was allowed, filled flat nevertheless so that inside and outside can be told.
struct WideHole {
  Eigen::Vector3d rim;  ///< a vertex of its rim
  double width = 0.0;
};

struct MendedSurface {
  TriangleSurface surface;  ///< closed
  std::vector<Mending> mendings;
  std::vector<WideHole> wide_holes = {};
};

/// What counts as small, in the units of the surface.
struct MendLimits {
  double hole = 0.03;  ///< m, largest diameter of a hole that is filled
};

/// Faces given twice and degenerate ones go, edges of more than two faces are parted, seams stitched, faces turned the same way and
/// outwards, holes filled flat, pieces apart that are smaller than a thousandth of the whole's area dropped.
/// Holes wider than `limits.hole` are listed apart: what they are in is not to be used.
MendedSurface mend(const TriangleSurface& surface, const MendLimits& limits = {});

/// Pairs of triangles that cut each other.
std::vector<std::array<int, 2>> self_intersections(const TriangleSurface& surface);

/// A closed surface without self-intersections about another one (alpha wrapping, CGAL): gaps narrower than `alpha` are bridged;
/// its vertices are drawn back on the given surface where that makes none. Said in `mendings` with what is left between the two.
MendedSurface wrap(const TriangleSurface& surface, double alpha, double offset);

/// Triangles of about equal edges `size`, on the surface; of an open surface the rim keeps its curves. Throws std::runtime_error.
TriangleSurface remeshed(const TriangleSurface& surface, double size);

/// Volume inside a closed surface, by its own orientation.
double enclosed_volume(const TriangleSurface& surface);

}  // namespace snug::mesh
