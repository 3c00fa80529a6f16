// A new case from a recorded run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/database/runs.hpp"

namespace snug::app {

/// Makes `directory`: the values that the run used as case.toml, changed by `overrides` (KEY=VALUE), and the files that it read. Whole or not at all. Throws
/// input::InputError where it is there already, where an input is neither in the library nor unchanged at its place, and where the changed case is wrong.
void derive_case(const materials::RunRecord& run, const std::filesystem::path& directory, const std::vector<std::string>& overrides,
                 const materials::Library& library);

}  // namespace snug::app
