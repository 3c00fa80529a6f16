// How a case names a material: an entry of the shipped data or a table of its own.
#pragma once

#include <array>
#include <string>

#include "cases/input/choice.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

/// Curve of a fabric: while it is stretched, or on its way back.
enum class FabricBranch { loading, unloading };
constexpr auto texts_of(FabricBranch) { return std::array{"loading", "unloading"}; }

/// A material or fabric that a case names: an entry of the shipped data, or a table of its own values.
/// The law's own `describe` reads `table` later, in its room; every value of it keeps its place.
struct MaterialEntry {
  std::string name;     ///< database entry, e.g. "N85L15", "relaxed calf", "rigid"
  Table table = {};     ///< inline values; empty when `name` is used
  Location where = {};  ///< of the name or of the table

  bool is_inline() const { return !table.entries.empty(); }
};

}  // namespace snug::input
