// A picture of a placed garment.
#pragma once

#include <string>

#include "mesh/placement/place_garment.hpp"

namespace snug::mesh {

/// An SVG of the garment from the front and from the back, its triangles coloured by their larger principal stretch
/// (blue 0.8, white 1, red 1.4) over the outlines of the body's sections. 1 mm in the picture is 2.5 mm.
std::string placed_svg(const PlacedGarment& placed, const DressForm& form);

}  // namespace snug::mesh
