// Rows of the tables that put runs side by side: a cell a run, numbers with their difference from the first.
#pragma once

#include <string>
#include <vector>

#include "postproc/report/shown_run.hpp"

namespace snug::postproc::report {

using Runs = std::vector<ShownRun>;

Json compared_figures(const Runs& runs);
/// Mean pressures by location, with ratings.
Json compared_locations(const Runs& runs);
/// How wide the garments are; empty without any.
Json compared_fit(const Runs& runs);
/// Sensors, what is wanted and found, thresholds and classes.
Json compared_wishes(const Runs& runs);

/// The locations of all runs in the order in which they come, and the mean pressure of a run at one (Pa; NaN where there is none).
std::vector<std::string> compared_location_names(const Runs& runs);
double location_pressure(const ShownRun& run, const std::string& name);

/// Pressures over the values of a sweep, as lines; null without values.
Json sweep_view(const Runs& runs, const std::vector<double>& values, const std::string& axis);

}  // namespace snug::postproc::report
