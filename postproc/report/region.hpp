// The part of a triangulated plane where a field is at or above a level, as an SVG path.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

#include "postproc/report/surfaces.hpp"

namespace snug::postproc::report {

/// Points of the drawing (pixels), one value each, and triangles between them.
struct Sheet {
  std::vector<Eigen::Vector2d> points;
  std::vector<Triangle> triangles;
};

/// Outline of the region value >= level, the field linear in each triangle: closed loops "M x,y l ... z" with a
/// resolution of a tenth of a pixel, to be filled by the even-odd rule. Edges that two triangles share are not drawn,
/// so that the region has no seams. Empty where the field stays below the level.
std::string region_path(const Sheet& sheet, const std::vector<double>& values, double level);

}  // namespace snug::postproc::report
