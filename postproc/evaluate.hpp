// What a result means for the wearer: pressure by location, sensation, overall comfort.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/sensation.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

struct LocationRow {
  std::string name;
  double area = 0.0;             ///< m2, deformed skin of the location
  double coverage = 0.0;         ///< 0..1, covered share of that area
  double mean_pressure = 0.0;    ///< Pa, weighted by covered area, the strips beside the hems left out; 0 without cover
  double max_pressure = 0.0;     ///< Pa, largest beside the hems (field::largest_inside)
  std::string pressures_of = "cover";  ///< "cover beside hems" where strips are left out; "hem" where there is nothing but them
  std::optional<double> rating;  ///< [0, 4]; none without cover, comfort section or curve of that name
  std::string term;              ///< neutral ... extremely uncomfortable; empty without a rating
  bool significant = true;       ///< false: the trial shows no effect of pressure here, the rating is its mean
  bool extrapolated = false;     ///< the mean pressure lies outside the trial's range
  double rating_error = 0.0;     ///< standard error of the rating; NaN when the curve tells no scatter
  int degrees = 0;               ///< of freedom behind it
};

/// Where the mean pressure of a location lies among named ranges.
struct ThresholdRow {
  std::string set, location;
  double pressure = 0.0;  ///< Pa
  std::string verdict;    ///< "CCL 2", "below onset of sensation", "between CCL 1 and CCL 2", ...
};

struct Evaluation {
  std::vector<LocationRow> locations;  ///< in the order of the result's locations
  std::optional<Comfort> comfort;      ///< none when no location has a rating
  std::vector<ThresholdRow> thresholds;  ///< of the covered locations that a chosen set speaks of
  std::string curves;                    ///< name of the sensation curves; empty without a comfort section
  std::string curves_source;             ///< their citation
};

/// Evaluates the last state of a run. Short of the answer its pressures are those of another state: they are told, but no rating,
/// class, threshold or comfort is made of them. `directory`: of the case, for a relative curve file.
/// Throws InputError when the curves cannot be read.
Evaluation evaluate(const RunResult& run, const std::optional<input::ComfortSpec>& comfort,
                    const std::filesystem::path& directory = {});

/// A pressure that was measured or predicted elsewhere.
struct LocationPressure {
  std::string location;
  double pressure = 0.0;  ///< Pa
};

/// Reads a table with the columns location and pressure_Pa, pressure_gf_per_cm2 or pressure_mmHg.
/// Throws InputError with file and line: unreadable, a column missing, a location named twice.
std::vector<LocationPressure> read_pressures(const std::filesystem::path& file);

/// Ratings and comfort of given pressures, no mechanics (`snug score`). Rows have no area and full coverage.
/// Throws InputError when no location has a curve.
Evaluation score(const std::vector<LocationPressure>& pressures, const input::ComfortSpec& comfort,
                 const std::filesystem::path& directory = {});

/// The data behind [comfort], read and checked. Throws InputError.
struct Evidence {
  SensationCurves curves;
  std::vector<SensationCurves> thresholds;
};
Evidence load_evidence(const input::ComfortSpec& comfort, const std::filesystem::path& directory = {});

/// Adds rating and term to the rows that have cover and a curve, and the comfort of those together.
void add_sensation(Evaluation& evaluation, const input::ComfortSpec& comfort, const std::filesystem::path& directory);

}  // namespace snug::postproc
