// Which part of a garment is of which fabric.
#pragma once

#include <string>
#include <vector>

#include "mesh/garment/garment_cut.hpp"

namespace snug::mesh {

/// Index of the zone that lists the piece; -1: none does.
int zone_of_piece(const input::GarmentSpec& spec, const std::string& piece);

/// Settles the fabrics of a garment that is cut from a pattern. A piece is of the fabric that a zone of the case gives it, else of its own in the
/// pattern, else of the garment's in the case, else of the pattern's. Where all pieces come to one fabric, that is the garment's and there is no zone;
/// else each fabric is a zone with its pieces, and the garment's own is one that is worn. Pieces that all name one and the same fabric name the pattern's.
/// Returns warnings: a fabric that no piece is of. Throws input::InputError where a zone names no piece of the pattern, or one twice, and where a
/// piece comes to no fabric.
std::vector<input::Diagnostic> settle_fabrics(GarmentCut& cut);

}  // namespace snug::mesh
