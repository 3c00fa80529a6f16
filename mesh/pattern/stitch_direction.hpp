// Which side of the cloth a drawing shows, found from how its seams run.
#pragma once

#include <vector>

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// A seam of which nobody says which way its sides meet; both stand in the direction in which the file lists them.
struct Stitch {
  EdgeChain a, b;
  input::Location where = {};
  std::string name = {};
};

/// For each piece 1 when its outline as listed runs counter-clockwise seen from the outside, else -1. Both outsides are
/// the garment's where the sides of a seam run against each other. That they run together or against each other is told
/// by the places of the pieces in space, by the lengths of several edges on each side, and by the drawings, which stand
/// upright. Throws input::InputError where places in space contradict each other: a piece is inside out.
std::vector<int> outline_directions(const Pattern& pattern, const std::vector<Stitch>& stitches);

}  // namespace snug::mesh
