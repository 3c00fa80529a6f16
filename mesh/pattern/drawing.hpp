// The drawing of a pattern.
#pragma once

#include <string>

#include "mesh/pattern/checks.hpp"
#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::mesh {

/// An SVG of the pieces side by side, in millimetres at full size: outlines with names and lengths, seams in one colour
/// and number on both sides, notches, grain, inner lines, and a list of seams and open edges with lengths and ease. A
/// mesh is drawn into the pieces where there is one. `read_pattern` reads the outlines again: paths of class "outline",
/// by piece.
std::string drawing_svg(const CheckedPattern& checked, const SewnMesh* mesh = nullptr);

}  // namespace snug::mesh
