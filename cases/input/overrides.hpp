// Values that replace those of case.toml: --set section.key=value
#pragma once

#include <string>
#include <vector>

#include "cases/input/table.hpp"

namespace snug::input {

/// Puts each "section.key=value" into `root`. The value is TOML, or else taken as text (N85L15, 20 gf/cm2). An entry of
/// a list is named by its number from 0 or by its `name`: body.layers[1].cells=3, body.layers.tissue.cells=3. Errors are located as
/// "--set section.key=value".
void apply_overrides(Table& root, const std::vector<std::string>& overrides, Diagnostics& diagnostics);

}  // namespace snug::input
