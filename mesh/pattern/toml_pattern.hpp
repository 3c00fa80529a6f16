// The pattern format of ours, in TOML (docs/patterns.md).
#pragma once

#include <functional>
#include <string>

#include "mesh/pattern/garment_pattern.hpp"

namespace snug::mesh {

/// Reads a pattern; the checks of mesh/pattern/checks.hpp are for afterwards. Throws input::InputError with every error
/// of the file, each with its place. `read_drawing` reads the file that `drawing` names; without it there is none to be
/// had.
Pattern parse_toml_pattern(const std::string& text, const std::string& shown_as,
                           const std::function<Pattern(const std::string&)>& read_drawing = {});

}  // namespace snug::mesh
