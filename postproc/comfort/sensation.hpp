// Skin pressure to pressure sensation, location by location.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace snug::postproc {

/// The rating scale of the trial: 0 neutral, 1 comfortable, 2 uncomfortable, 3 very uncomfortable, 4 extremely
/// uncomfortable (thesis 5.2.2).
inline constexpr double lowest_rating = 0.0, highest_rating = 4.0;
/// Name of the whole number of the scale nearest to `rating`.
std::string sensation_term(double rating);

// Shapes of rating against pressure [Pa].

/// intercept + slope p; slope in 1/Pa.
struct Line {
  double intercept = 0.0, slope = 0.0;
};
/// Straight between the points (pressure, rating), constant before the first and after the last. Pressures grow.
struct Polyline {
  std::vector<double> pressures, ratings;
};
/// lowest + (highest - lowest) / (1 + exp(-(p - middle) / width)); middle and width in Pa, width > 0.
struct Logistic {
  double lowest = lowest_rating, highest = highest_rating, middle = 0.0, width = 1.0;
};
using CurveShape = std::variant<Line, Polyline, Logistic>;

/// "linear", "piecewise" or "logistic".
std::string shape_name(const CurveShape& shape);
double value_at(const CurveShape& shape, double pressure);

/// Rating against pressure at one location, with what is known of its scatter.
struct SensationCurve {
  std::string location;
  CurveShape shape;
  double low = 0.0, high = 0.0;  ///< Pa, where the curve is backed by data
  bool significant = true;       ///< p_value < 0.05; otherwise mean_rating is used
  double mean_rating = 0.0;      ///< of the data; NaN when it is not known
  double mean_scatter = 0.0;     ///< standard deviation of the ratings about their mean
  double scatter = 0.0;          ///< residual standard deviation of the ratings; NaN when it is not known
  double largest_residual = 0.0;
  double r_squared = 0.0;         ///< 1 - residual squares / squares about the mean
  double slope_error = 0.0;       ///< standard error of the slope of a line, 1/Pa; NaN for other shapes
  double intercept_error = 0.0;   ///< the same of its intercept
  double p_value = 1.0;           ///< F-test of the curve against the mean rating (of a line: the two-sided t-test)
  int points = 0;                 ///< ratings behind it; 0 when it is not known
  int parameters = 2;             ///< of the shape that were fitted
  double mean_pressure = 0.0;     ///< Pa, of the data
  double pressure_squares = 0.0;  ///< Pa2, sum of (p - mean_pressure)^2
};

struct Rating {
  double value = 0.0;  ///< in [0, 4]
  std::string term;
  bool significant = true;    ///< false: pressure explains nothing here, `value` is the trial's mean
  bool extrapolated = false;  ///< the pressure lies outside the curve's valid range
  /// Standard error of the prediction of one more rating: scatter sqrt(1 + leverage); NaN when no scatter is known.
  double error = 0.0;
  int degrees = 0;  ///< of freedom behind `error`
};

/// The curve at a pressure in Pa. Where the slope is not significant the line is not used: its sign is chance, and
/// following it would call more pressure more comfortable.
Rating rate(const SensationCurve& curve, double pressure);

/// A range of pressures that has a name: the onset of a sensation, a threshold of discomfort, a class of compression.
struct PressureBand {
  std::string location;  ///< empty: anywhere
  std::string name;
  double low = 0.0, high = 0.0;  ///< Pa; high is infinite for a band that is open upwards
};

/// Curves or bands with where they come from: one entry of the shipped data, or a file of the user.
struct SensationCurves {
  std::string name;  ///< "wear trial 2002" or the file
  std::string source, patch, population;
  std::vector<std::string> notes;
  std::vector<SensationCurve> curves;  ///< one a location
  std::vector<PressureBand> bands;     ///< grow with pressure at each location
  /// The curve of a location (upper and lower case are the same), of "Front thigh left" that of "Front thigh" where it has none of its own; nullptr
  /// when there is none.
  const SensationCurve* find(std::string_view location) const;
};

/// "Front thigh" of "Front thigh left" and "front thigh right"; other names as they are.
std::string_view without_side(std::string_view location);

/// Where a pressure in Pa lies among the bands of a location: "CCL 2", "below CCL 1", "between CCL 1 and CCL 2",
/// "above X". Empty when no band speaks of the location, with or without its side.
std::string verdict(const SensationCurves& data, std::string_view location, double pressure);

}  // namespace snug::postproc
