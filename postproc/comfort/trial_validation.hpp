// How well sensation curves that were fitted to some garments of a wear trial tell the ratings of others.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cases/input/csv.hpp"

namespace snug::postproc {

struct LocationValidation {
  std::string location;
  int tested = 0;          ///< ratings that were told
  bool significant = true; ///< false: the curve of the garments it was fitted to shows no effect of pressure, and tells their mean
  double rms = 0.0, largest = 0.0;  ///< of told less given ratings
};

struct TrialValidation {
  std::vector<LocationValidation> locations;
  int ratings = 0;   ///< of the locations with a significant curve
  double rms = 0.0;  ///< over them
};

/// Fits curves of that shape to the rows of `train` and rates the pressures of the rows of `test`. The table is a wear trial (curve_fit.hpp) with a column
/// garment. Throws InputError: no such column or garment, a garment in both, too few pressures for a curve.
TrialValidation validate_trial(const input::Csv& table, const std::string& shape, const std::set<std::string>& train, const std::set<std::string>& test);

}  // namespace snug::postproc
