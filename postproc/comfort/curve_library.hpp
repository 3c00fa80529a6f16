// Sensation curves and pressure bands by name: the shipped sets and the user's files.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/material_entry.hpp"
#include "postproc/comfort/sensation.hpp"

namespace snug::postproc {

/// Every shipped set, in the order of their names.
std::vector<SensationCurves> shipped_curves();

/// The set that a case names: a shipped one, a TOML file (curve_input.hpp), or a CSV file of observations, through
/// which lines are fitted; files are relative to `directory`. Throws InputError with the names there are.
SensationCurves find_curves(const input::MaterialEntry& reference, const std::filesystem::path& directory = {});

/// The same, and an error when the set has no curves, only bands; or no bands, only curves.
SensationCurves load_curves(const input::MaterialEntry& reference, const std::filesystem::path& directory = {});
SensationCurves load_bands(const input::MaterialEntry& reference, const std::filesystem::path& directory = {});

/// TOML text that find_curves reads back to the same set.
std::string curves_toml(const SensationCurves& curves);

}  // namespace snug::postproc
