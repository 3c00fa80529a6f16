// Recorded runs as texts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/database/runs.hpp"

namespace snug::app {

/// What lies today where a run's results were.
enum class Whereabouts { as_recorded, others, gone };
Whereabouts whereabouts(const materials::RunRecord& run);
std::string text_of(Whereabouts whereabouts);

/// A unit of pressure that results are shown in. Throws input::InputError where `name` is none.
struct PressureUnit {
  explicit PressureUnit(const std::string& name);
  std::string name;
  double factor = 1.0;  ///< Pa
};
/// A result as a person reads it: pressures in that unit, else as it is.
std::string shown(const materials::RunValue& value, const PressureUnit& unit);

/// Mean pressures of locations, in the order of the runs' first ones.
std::vector<std::string> locations_of(const std::vector<materials::RunRecord>& runs);

/// Settings in which the runs differ: of each its key and a value a run ("-": it has none).
struct Difference {
  std::string key;
  std::vector<std::string> values;
};
std::vector<Difference> differences(const std::vector<materials::RunRecord>& runs);

/// Columns as wide as their widest cell, the first to the left, the others to the right; an empty last column is left out.
std::string aligned(const std::vector<std::vector<std::string>>& rows);

/// "2026-11-29 09:07" of the moment that the library keeps.
std::string minute_of(const std::string& moment);

/// Everything of one run.
std::string run_text(const materials::RunRecord& run, const PressureUnit& unit);
/// Settings that differ and results with their change against the first of the runs.
std::string comparison_text(const std::vector<materials::RunRecord>& runs, const PressureUnit& unit);
/// From a result down to the data of the library that its case read, each as printed, with its source, and whether the library has another value today.
/// Throws input::InputError where the run has no such result.
std::string trace_text(const materials::RunRecord& run, const std::string& result, const materials::Library& library, const PressureUnit& unit);

}  // namespace snug::app
