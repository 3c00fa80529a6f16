// gmsh scripts (.geo) of somebody else: looked at before gmsh sees them.
#pragma once

#include <string>

namespace snug::mesh {

/// The script word by word as it was understood, on the same lines and without its comments, so that gmsh reads what was
/// checked and nothing else. Geometry, mesh sizes, fields, loops and arithmetic are admitted. Refused with name and line:
/// commands that run programs, read or write files or end the program, words that are no known command and are given no
/// value by the script, loops without end, macros that call themselves. Throws input::InputError.
std::string checked_script(const std::string& text, const std::string& file);

}  // namespace snug::mesh
