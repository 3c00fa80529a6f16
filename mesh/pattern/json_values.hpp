// JSON as values with places, so that errors in it are told like those of TOML.
#pragma once

#include <string>

#include "cases/input/table.hpp"

namespace snug::mesh {

/// The object that a JSON text holds, by the reader of mesh/formats. Reports what that refuses and what is no object, and gives
/// an empty table then.
input::Table parse_json(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics);

}  // namespace snug::mesh
