// How a case names a material: an entry of the shipped data or a table of its own.
#pragma once

#include <string>

#include "cases/input/diagnostics.hpp"

namespace snug::input {

/// A material or fabric that a case names: an entry of the shipped data, or a table of its own values.
/// The law's own `describe` reads `table` (text of an inline TOML table, kept with its place) later, in its room.
struct MaterialReference {
  std::string name;   ///< database entry, e.g. "N85L15", "relaxed calf", "rigid"
  std::string table;  ///< inline values as TOML text; empty when `name` is used
  Location where;     ///< of the name or of the table: parse_text(table, where) gives errors at their own places
};

}  // namespace snug::input
