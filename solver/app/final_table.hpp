// The table that ends a run.
#pragma once

#include <filesystem>
#include <string>

#include "postproc/evaluate.hpp"
#include "postproc/result.hpp"

namespace snug::app {

/// Pressures, ratings and comfort by location.
std::string locations_text(const postproc::Evaluation& evaluation);

/// Status, pressures by location, comfort, force balance, L0 sanity value, time by phase, where the files are.
std::string final_text(const postproc::RunResult& run, const postproc::Evaluation& evaluation,
                       const std::filesystem::path& out);

}  // namespace snug::app
