// The path data of SVG (https://www.w3.org/TR/SVG11/paths.html).
#pragma once

#include <string>
#include <vector>

#include "mesh/pattern/curve.hpp"

namespace snug::mesh {

/// The subpaths of path data, in its units: M L H V C S Q T A Z, absolute and relative. Closed ones end where they
/// begin. `fault` says what could not be read, else it is empty; what stands before it is given.
std::vector<Curve> parse_svg_path(const std::string& data, std::string& fault);

}  // namespace snug::mesh
