// The words of gmsh's script language (reference manual, "Geometry scripting commands", "Gmsh mesh size fields").
#pragma once

#include <string>
#include <vector>

namespace snug::mesh {

enum class GeoWord { name, number, text, sign };

struct GeoToken {
  GeoWord kind;
  std::string text;  ///< of a text without its quotes
  int line = 1, column = 1;
};

/// Throws input::InputError at what is no word: a text that does not end on its line or has a backslash, other characters.
std::vector<GeoToken> geo_tokens(const std::string& script, const std::string& file);

/// Commands that build and mesh a geometry, functions and the names of their arguments.
bool is_geometry_command(const std::string& name);
/// Commands with which a script does something outside its geometry: programs, files, the program's end, waiting.
bool reaches_outside(const std::string& name);

}  // namespace snug::mesh
