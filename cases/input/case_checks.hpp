// What a single value cannot show: parts of a case that do not fit together.
#pragma once

#include "cases/input/case.hpp"
#include "cases/input/diagnostics.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

/// Fills in defaults that depend on other values: the form of the layers, the kind of a pattern.
void complete(Case& description, const Table& root);

/// Reports what does not fit together. `root` gives the places.
void check_case(const Case& description, const Table& root, Diagnostics& diagnostics);

}  // namespace snug::input
