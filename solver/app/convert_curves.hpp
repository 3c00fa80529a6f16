// snug convert CURVES FILE: curves, surfaces and nets between JSON of ours, STEP, IGES and DXF, and as a picture.
#pragma once

#include <string>

namespace snug::app {

/// True when `file` names a file of curves: .json .step .stp .igs .iges .dxf.
bool is_curve_file(const std::string& file);

/// Reads `from` and writes `to`, whose ending may be .svg, too. `subdivisions`: steps of four-point subdivision of the
/// nets, of the picture's surface of them or of the nets themselves. Prints what the format of `to` cannot hold. Throws
/// input::InputError.
void convert_curves(const std::string& from, const std::string& to, int subdivisions);

}  // namespace snug::app
