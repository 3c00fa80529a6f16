// Whether the border of a piece bounds a piece of cloth.
#pragma once

#include "cases/input/diagnostics.hpp"
#include "mesh/pattern/piece.hpp"

namespace snug::mesh {

/// Reports edges that do not meet their neighbours, have no length, cross or touch other edges or themselves, an
/// outline that runs clockwise, and holes that are not inside the outline. Places are given in the drawing of the file,
/// mm.
void check_outline(const Piece& piece, input::Diagnostics& diagnostics);

}  // namespace snug::mesh
