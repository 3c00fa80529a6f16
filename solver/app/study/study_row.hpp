// One run of a study with what it took and how wrong it is.
#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "postproc/result.hpp"
#include "postproc/skin_map.hpp"

namespace snug::app {

constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Relative errors; NaN where they are not known.
struct StudyErrors {
  double mean_pressure = not_known;                           ///< of the force over the covered area, the whole garment
  double pressure_rms = not_known, pressure_max = not_known;  ///< of the nodes in the zone
  double mean_displacement = not_known;                       ///< of the skin's mean radial displacement
  double displacement_rms = not_known;                        ///< of the nodes in the zone
};

struct StudyRow {
  std::string series, level, settings;
  std::string status;  ///< as in summary.json
  double unknowns = not_known;
  double skin_nodes = not_known;  ///< their number to the power -1/2 stands for the cell size h
  double increments = not_known, iterations = not_known;
  double wall = not_known, user = not_known, system = not_known;  ///< s, of the whole process
  double memory = not_known;                                      ///< bytes, peak of the process
  std::vector<postproc::Phase> phases;
  double mean_pressure = not_known, mean_displacement = not_known;  ///< Pa, m
  postproc::SkinMap map;                                            ///< empty in rows that were measured elsewhere
  StudyErrors errors;

  bool converged() const { return status == "converged"; }
};

/// Slope of log |error| over log h, fitted by least squares to the rows where the error is known; NaN below two.
double observed_order(const std::vector<const StudyRow*>& rows, double StudyErrors::*error);

/// The rows of a series, in their order; names of the series in the order of their first rows.
std::vector<const StudyRow*> rows_of(const std::vector<StudyRow>& rows, const std::string& series);
std::vector<std::string> series_of(const std::vector<StudyRow>& rows);

}  // namespace snug::app
