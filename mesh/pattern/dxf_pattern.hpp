// Pieces from DXF of the AAMA-292 and ASTM D6673 kind.
#pragma once

#include <string>

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// Reads one piece a block: outline (layer 14, the sew line, where there is one, else 1), turn points (2) at which it
/// is cut into edges "edge1", "edge2", ..., curve points (3) through which an edge is a cubic spline, notches (4),
/// grain (7), inner lines (8), cut-outs (11). Without turn points edges end at corners of more than 30 degrees. The
/// unit is that of $INSUNITS or of a text "UNITS: METRIC" (mm) or "UNITS: ENGLISH" (inches), one of which must be
/// there; pieces are taken as seen from the outside. Such files hold no seams: a pattern of ours names them (`drawing =
/// "pieces.dxf"`). Throws input::InputError: no unit, no piece, an open outline, a piece drawn as a half (mirror line,
/// layer 6), a scaled insert.
Pattern parse_dxf(const std::string& text, const std::string& shown_as);

}  // namespace snug::mesh
