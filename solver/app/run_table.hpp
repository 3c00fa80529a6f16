// Recorded runs as a table of numbers: what was set, and one result.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "materials/database/runs.hpp"
#include "materials/learning/response_surface.hpp"

namespace snug::app {

struct RunQuestion {
  std::string result;
  std::vector<std::string> keys = {};  ///< whole keys, or their ends; empty: the numbers of garments that differ
  std::string project = {}, tier = {};  ///< empty: all
};

struct RunColumn {
  std::string key, unit;
};

struct RunTable {
  std::vector<RunColumn> columns;
  Eigen::MatrixXd properties;  ///< a row a run, as case.echo.toml has them
  Eigen::VectorXd response;    ///< in SI
  std::string unit;            ///< of the response
  std::string left_out;        ///< what of the runs does not count, and why
};

/// Converged runs that have the result and every key; runs of one and the same case count once. Throws input::InputError where there are none, where they are
/// of several tiers, and where a key is not known or means several.
RunTable run_table(materials::Library& library, const RunQuestion& question);

}  // namespace snug::app
