// Patterns in the JSON layout of GarmentCode (Korosteleva and Sorkine-Hornung, ACM Trans. Graph. 42 (2023) 199).
#pragma once

#include <string>

#include "mesh/pattern/checks.hpp"

namespace snug::mesh {

/// Reads panels with vertices and edges (straight, "quadratic", "cubic", "circle"), stitches of an edge with an edge,
/// or of several edges of a panel with several, and translation and rotation of panels. `units_in_meter` must be there.
/// Names of edges are their labels, else those of their ends, else "edge0", "edge1", ....
///
/// The format does not say which way a stitch runs. Where panels are placed, their outlines run counter-clockwise as
/// seen from the outside, and a stitch that would run the shorter way round otherwise means a panel that is inside out.
/// Drawings alone are taken to be upright: the two sides of a seam run up together, and a panel is seen from the inside
/// where that asks for it. Throws input::InputError with every error, each with its place.
Pattern parse_garmentcode(const std::string& text, const std::string& shown_as);

/// The pattern in this layout, 100 units to the metre, pieces seen from the outside, with the key
/// properties.seen_from_outside, by which `parse_garmentcode` takes it as it stands. Each stretch of an edge between
/// corners of the sewing is an edge, and each span of a spline one of its own; a seam of several is a stitch with
/// "edges". Arcs that are not of circles become Bezier curves within 1e-7 of their size. Grain, notches, holes,
/// fabrics, names of hems and inner lines have no place in it.
std::string garmentcode_text(const CheckedPattern& checked);

}  // namespace snug::mesh
