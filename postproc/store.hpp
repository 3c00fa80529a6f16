// What a run leaves in its directory, as one value: made of results in memory, written by the recorders, read back here.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "postproc/documents.hpp"
#include "postproc/grid.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

/// Names of files, for those who look for one.
inline constexpr const char *body_grid_file = "body_0000.vtu", *garment_grid_file = "garment_0000.vtu";
inline constexpr const char *summary_file = "summary.json", *comfort_file = "comfort.json", *history_file = "history.csv";
inline constexpr const char *body_series_file = "body.pvd", *garment_series_file = "garment.pvd", *skin_file = "skin.csv";

struct StoredRun {
  std::string name;                         ///< of the directory, to tell runs apart
  Json summary, comfort;                    ///< comfort: null where nobody is judged
  std::vector<Iteration> history;           ///< as far as history.csv holds it, to the digits that it has
  std::string echo, comparison;             ///< case.echo.toml, comparison.txt; empty where there is none
  std::optional<Grid> body_grid, garment_grid;  ///< none: the scene has none
  std::vector<int> skin_nodes;              ///< points of the body's grid that are on its skin, ascending
};

/// What `write_results` will write of a run into `directory`. The echo and the comparison belong to who makes them.
StoredRun stored_run(const RunResult& run, const Evaluation& evaluation, const Provenance& provenance, const std::filesystem::path& directory);

/// Reads a directory of results back, every number as it was stored. Throws input::InputError where it is no result of a run or a file
/// of it cannot be read.
StoredRun read_run(const std::filesystem::path& directory);

/// The nodes in the column `node` of skin.csv as points of the body's grid. Throws input::InputError at a number that is none of the
/// grid's.
std::vector<int> read_skin_nodes(const std::filesystem::path& skin_csv, const Grid& grid);

/// What is said of a summary.json or comfort.json that is JSON and not as a run writes it.
input::InputError not_as_written(const std::filesystem::path& directory, const Json::exception& error);

}  // namespace snug::postproc
