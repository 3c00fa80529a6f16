// Pressure on a named patch of skin, and how it is rated.
#pragma once

#include <optional>
#include <string>

namespace snug::postproc {

struct LocationRow {
  std::string name;
  double area = 0.0;             ///< m2, deformed skin of the location
  double coverage = 0.0;         ///< 0..1, covered share of that area
  double mean_pressure = 0.0;    ///< Pa, weighted by covered area, the strips beside the hems left out; 0 without cover
  double max_pressure = 0.0;     ///< Pa, largest beside the hems (field::largest_inside)
  std::string pressures_of = "cover";  ///< "cover beside hems" where strips are left out; "hem" where there is nothing but them
  std::optional<double> rating;  ///< [0, 4]; none without cover, comfort section or curve of that name, and outside the trial's pressures
  std::string term;              ///< neutral ... extremely uncomfortable; empty without a rating
  bool significant = true;       ///< false: the trial shows no effect of pressure here, the rating is its mean
  bool extrapolated = false;     ///< the mean pressure lies outside the trial's range: nobody was asked about it, there is no rating
  double trial_low = 0.0, trial_high = 0.0;  ///< Pa, that range; 0 and 0: no curve
  double rating_error = 0.0;     ///< standard error of the rating; NaN when the curve tells no scatter
  int degrees = 0;               ///< of freedom behind it
};

}  // namespace snug::postproc
