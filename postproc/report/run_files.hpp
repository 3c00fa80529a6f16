// What a run has left in its directory, read back for the report.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "postproc/report/surfaces.hpp"

namespace snug::postproc::report {

using Json = nlohmann::ordered_json;

/// A row of history.csv that the plot shows.
struct HistoryRow {
  int increment = 0;
  double load = 0.0, residual = 0.0, complementarity = 0.0;
  int contact_nodes = 0;
  std::string event;
};

struct RunFiles {
  std::string name;       ///< of the directory, to tell runs apart
  Json summary, comfort;  ///< comfort: null without comfort.json
  std::vector<HistoryRow> history;
  std::string echo, comparison;    ///< case.echo.toml, comparison.txt; empty where there is none
  std::optional<Skin> skin;        ///< none: the scene has no body
  std::optional<Garment> garment;  ///< none: the scene has no garment
};

/// Reads summary.json and what there is beside it. Throws input::InputError when `out` is no result of a run or a file
/// of it cannot be read.
RunFiles read_run(const std::filesystem::path& out);

/// What is said of a summary.json or comfort.json that is JSON and not as a run writes it.
input::InputError not_as_written(const std::filesystem::path& out, const Json::exception& error);

}  // namespace snug::postproc::report
