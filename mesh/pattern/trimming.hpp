// A part of a garment: pieces cut across their drawings.
#pragma once

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// What of every piece lies between two heights (m) over the lowest point of its drawing. Curves keep their shape; where a piece was cut it
/// has an edge "lower cut" or "upper cut". Seams, hems and notches keep what is left of them. A piece that lies outside altogether
/// is left out. Throws input::InputError at `where` when nothing is left, a piece falls into several parts, or a seam loses one side.
Pattern trimmed(const Pattern& pattern, double from, double to, const input::Location& where);

}  // namespace snug::mesh
