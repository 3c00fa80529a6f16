// JSON as values with places, so that errors in it are told like those of TOML.
#pragma once

#include <string>

#include "cases/input/table.hpp"

namespace snug::mesh {

/// The object that a JSON text holds. Reports wrong syntax, what is no object, and nesting of more than 50, and gives
/// an empty table then. null is std::monostate. Of keys that stand twice the first one counts.
input::Table parse_json(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics);

}  // namespace snug::mesh
