// Least-squares fits of sensation curves to the ratings of a wear trial.
#pragma once

#include <string>
#include <vector>

#include "cases/input/csv.hpp"
#include "postproc/comfort/sensation.hpp"

namespace snug::postproc {

constexpr double significance_level = 0.05;  ///< a slope with a larger p-value says nothing

/// What a trial measured at one location.
struct Observations {
  std::string location;
  std::vector<double> pressure, rating;  ///< Pa; [0, 4]
  std::vector<std::size_t> rows;         ///< of the table
};

/// The rows of a table with the columns location, sensation_rating and a pressure (see pressure_table.hpp), by location
/// in the order in which the table first names them. Throws InputError: no such column, a rating outside [0, 4].
std::vector<Observations> observations(const input::Csv& table);

/// Fits one location. "linear": the least-squares line; "piecewise": constant up to a break, straight from there on
/// (the break is the one of least squares); "logistic": from 0 to 4, middle and width are fitted, and a line where none
/// fits. Throws InputError at `source` when there are not enough different pressures.
SensationCurve fit_curve(const Observations& seen, const std::string& shape, const std::string& source);

/// The curves of all locations of a table. Name and source are the file.
SensationCurves fit_curves(const input::Csv& table, const std::string& shape = "linear");

}  // namespace snug::postproc
