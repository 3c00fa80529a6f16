// The case directories that come with snug.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace snug::app {

/// The folder of the shipped cases.
std::filesystem::path shipped_cases_folder();

/// Their names, relative to the folder: "thigh-sleeve", "verification/tube-sleeve", ...
std::vector<std::string> shipped_cases();

}  // namespace snug::app
