// JSON as plain values, each with its place.
#pragma once

#include <string>

#include "cases/input/table.hpp"

namespace snug::mesh {

/// The values of a JSON text; null comes as std::monostate. Throws input::InputError with line and column where it is
/// no JSON, has a key twice or is nested deeper than 32.
input::Value parse_json(const std::string& text, const std::string& shown_as);

}  // namespace snug::mesh
