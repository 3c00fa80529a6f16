// A tube as the pattern that it is: a rectangle with one seam.
#pragma once

#include "cases/input/garment_spec.hpp"
#include "mesh/pattern/checks.hpp"

namespace snug::mesh {

/// The rectangle of a garment that is a tube, its open edges "lower" and "upper". Throws input::InputError where it has no size.
CheckedPattern tube_pattern(const input::GarmentSpec& spec);

}  // namespace snug::mesh
