// Skin pressure to pressure sensation, location by location: straight lines fitted to a wear trial.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "cases/input/case.hpp"
#include "cases/input/csv.hpp"

namespace snug::postproc {

/// The rating scale of the trial: 0 neutral, 1 comfortable, 2 uncomfortable, 3 very uncomfortable, 4 extremely
/// uncomfortable (thesis 5.2.2).
inline constexpr double lowest_rating = 0.0, highest_rating = 4.0;
/// Name of the whole number of the scale nearest to `rating`.
std::string sensation_term(double rating);

/// Rating against pressure at one location: least-squares line rating = intercept + slope * pressure.
struct SensationCurve {
  std::string location;
  double intercept = 0.0;
  double slope = 0.0;            ///< rating per Pa
  double mean_rating = 0.0;      ///< of the trial; used where the slope is not significant
  double low = 0.0, high = 0.0;  ///< Pa, range of the trial's pressures
  double scatter = 0.0;          ///< residual standard deviation of the ratings, n - 2 degrees of freedom
  double largest_residual = 0.0;
  double p_value = 1.0;      ///< two-sided t-test of slope = 0
  bool significant = false;  ///< p_value < 0.05
  int points = 0;
};

struct Rating {
  double value = 0.0;  ///< in [0, 4]
  std::string term;
  bool significant = true;    ///< false: pressure explains nothing here, `value` is the trial's mean
  bool extrapolated = false;  ///< the pressure lies outside the trial's range
};

/// The curve at a pressure in Pa. Where the slope is not significant the line is not used: its sign is chance, and
/// following it would call more pressure more comfortable.
Rating rate(const SensationCurve& curve, double pressure);

/// Curves of a trial, one a location, in the order in which the table first names them.
struct SensationCurves {
  std::string source;  ///< "wear trial 2002" or the file
  std::vector<SensationCurve> curves;
  /// The curve of a location (upper and lower case are the same); nullptr when the trial has none.
  const SensationCurve* find(std::string_view location) const;
};

/// Fits the curves of a table with the columns location, sensation_rating and a pressure (see pressure_table.hpp).
/// Throws InputError: no such column, a rating outside [0, 4], a location with fewer than three different pressures.
SensationCurves fit_curves(const input::Csv& table);

/// The curves a case asks for: "wear trial 2002" (shipped in the program) or a CSV file, relative to `directory`.
SensationCurves load_curves(const input::ComfortSpec& spec, const std::filesystem::path& directory = {});

}  // namespace snug::postproc
