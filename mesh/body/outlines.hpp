// A limb from the outlines of its sections.
#pragma once

#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// Reads `spec.stations`, a JSON file of nets (mesh/formats/curve_set.hpp). The net "skin", or the only one, has a row of points on the skin for
/// every section, two at least, in any order of rows and columns; the net "bone" those of the bone. Where there is none a bone of a quarter
/// of every section is taken and that is said. The sections are joined by a bicubic spline surface through the points (SplineOutline). The limb reaches from the
/// highest point of the lowest section to the lowest point of the highest.
///
/// Throws input::InputError with file and remedy: unreadable file, no such net, points that do not go once round, sections that
/// do not lie above each other, a size that no part of a body has, bone outside the skin.
Limb limb_from_outlines(const input::BodySpec& spec);

}  // namespace snug::mesh
