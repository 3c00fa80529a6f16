// A limb from a table of girths along its axis.
#pragma once

#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// Reads `spec.stations`, a CSV file with a header that names columns and units, for example
///
///   height [mm], girth [mm], width_to_depth, centre_x [mm], centre_y [mm], bone_girth [mm], bone_width_to_depth,
///   bone_x [mm], bone_y [mm]
///
/// One row a section from below upwards, at least two. The section is an ellipse of that perimeter whose width (along
/// x) and depth (along y) have the given ratio. `height`, `girth` and `bone_girth` are required; ratios are 1 and
/// centres 0 where a column is left out. The bone's centre (bone_x, bone_y) is given in the frame of the body, not
/// relative to the centre of the skin. Sections are joined by natural cubic splines of the semi-axes and centres (two:
/// straight).
///
/// Throws input::InputError with file, line and remedy: unreadable file, unknown or missing column, girth not positive,
/// fewer than two stations, heights not increasing, bone outside the skin (with height and angle).
Limb limb_from_stations(const input::BodySpec& spec);

}  // namespace snug::mesh
