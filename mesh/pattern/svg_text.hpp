// Bits of SVG.
#pragma once

#include <Eigen/Core>

#include <string>
#include <string_view>

#include "mesh/pattern/curve.hpp"

namespace snug::mesh {

/// A text inside XML: marks escaped, bytes that are no UTF-8 and control characters replaced by '?'.
std::string xml_text(std::string_view text);

/// The commands of a path that goes on along a curve, from where it stands: L, Q and C; points in mm, x + shift.x,
/// shift.y - y.
std::string path_on(const Curve& curve, const Eigen::Vector2d& shift);

}  // namespace snug::mesh
