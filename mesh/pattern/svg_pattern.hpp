// Outlines from SVG drawings.
#pragma once

#include <string>

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// Reads the closed paths and polygons of a drawing as pieces, named by their label (Inkscape) or id: those of class
/// "outline" where there are any, else all outside of defs, clip paths, masks and symbols. Further subpaths are holes.
/// An edge ends where the border turns by more than 30 degrees; edges are "edge1", "edge2", ... along the outline.
/// Width and height must have a length as unit (mm, cm, in, pt), so that the drawing has a size. Transforms are
/// applied. Pieces are taken as seen from the outside; there are no seams: a pattern of ours names them (`drawing =
/// "pieces.svg"`). Throws input::InputError.
Pattern parse_svg(const std::string& text, const std::string& shown_as);

}  // namespace snug::mesh
