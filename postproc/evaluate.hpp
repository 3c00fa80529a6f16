// What a result means for the wearer: pressure by location, sensation, overall comfort.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/job_spec.hpp"
#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/sensation.hpp"
#include "postproc/location_row.hpp"
#include "postproc/result.hpp"

namespace snug::postproc {

/// Where the mean pressure of a location lies among named ranges.
struct ThresholdRow {
  std::string set, location;
  double pressure = 0.0;  ///< Pa
  std::string verdict;    ///< "CCL 2", "below onset of sensation", "between CCL 1 and CCL 2", ...
};

/// How near a pressure comes to the one that is wanted.
struct TargetRow {
  std::string place;  ///< name of the location, or "120 mm"
  double wanted = 0.0, found = 0.0;  ///< Pa; nothing is found where there is no cover
};

/// What a flat sensor between garment and skin would read (solver/library/sensor.hpp).
struct SensorRow {
  std::string name;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();  ///< m, its middle on the undeformed skin
  double diameter = 0.0, thickness = 0.0;        ///< m
  double coverage = 0.0;          ///< 0..1, share of it that the garment covers
  double skin_pressure = 0.0;     ///< Pa, normal force on the skin under it over its area; without cover it bears nothing
  double tension = std::numeric_limits<double>::quiet_NaN();  ///< N/m, sum of both principal tensions of the garment over it; NaN: not known
  double bulge = std::numeric_limits<double>::quiet_NaN();    ///< Pa, what the bulge adds; NaN: not asked for or not known

  double reading() const { return bulge > 0.0 ? skin_pressure + bulge : skin_pressure; }  ///< Pa
};

/// Ratings and comfort of a state of a movement.
struct MovementRating {
  std::vector<LocationRow> locations;
  std::optional<Comfort> comfort;
  std::string no_score;
};

struct Evaluation {
  std::vector<LocationRow> locations;  ///< in the order of the result's locations
  std::optional<Comfort> comfort;      ///< none when no location has a rating, or one presses more than any in the trial
  std::string no_score;                ///< why a comfort section gives none: "no location is covered"; empty without one
  std::vector<TargetRow> targets;      ///< in the order of the case
  std::vector<SensorRow> sensors;      ///< likewise
  std::vector<ThresholdRow> thresholds;  ///< of the covered locations that a chosen set speaks of
  std::vector<MovementRating> movement;  ///< in the order of the result's states
  std::string curves;                    ///< name of the sensation curves; empty without a comfort section
  std::string curves_source;             ///< their citation
};

/// Evaluates the last state of a run. Short of the answer its pressures are those of another state: they are told, but no rating,
/// class, threshold or comfort is made of them. `directory`: of the case, for a relative curve file.
/// Throws InputError when the curves cannot be read.
Evaluation evaluate(const RunResult& run, const std::optional<input::ComfortSpec>& comfort,
                    const std::filesystem::path& directory = {});

/// What of each node of the skin (m2) counts for a pressure that is wanted: all of a location's nodes, or round the body those within a cell of the
/// height, less the farther they are. `body` needs no fields.
std::vector<double> counted_areas(const BodyResult& body, const input::WantedPressure& wanted);

/// What is found of the pressures that are wanted; nothing short of the answer. `locations`: of the same run.
std::vector<TargetRow> target_rows(const RunResult& run, const std::vector<LocationRow>& locations, const input::TargetSpec& target);

/// A pressure that was measured or predicted elsewhere.
struct LocationPressure {
  std::string location;
  double pressure = 0.0;  ///< Pa
};

/// Reads a table with the columns location and pressure_Pa, pressure_gf_per_cm2 or pressure_mmHg.
/// Throws InputError with file and line: unreadable, a column missing, a location named twice.
std::vector<LocationPressure> read_pressures(const std::filesystem::path& file);

/// Ratings and comfort of given pressures, no mechanics (`snug score`). Rows have no area, and full coverage where there is a pressure.
/// Throws InputError when no location has a curve and no threshold speaks of one.
Evaluation score(const std::vector<LocationPressure>& pressures, const input::ComfortSpec& comfort,
                 const std::filesystem::path& directory = {});

/// The data behind [comfort], read and checked. Throws InputError.
struct Evidence {
  SensationCurves curves;  ///< none where nobody is asked: thresholds alone
  std::vector<SensationCurves> thresholds;
};
Evidence load_evidence(const input::ComfortSpec& comfort, const std::filesystem::path& directory = {});

/// Adds rating and term to the rows that have cover and a curve whose trial had such pressures, and the comfort of those together. Below the
/// trial's pressures a location counts as one without a curve; where one lies above them there is no score, and `no_score` says why.
void add_sensation(Evaluation& evaluation, const input::ComfortSpec& comfort, const std::filesystem::path& directory);

}  // namespace snug::postproc
