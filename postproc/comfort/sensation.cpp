#include "postproc/comfort/sensation.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "postproc/comfort/pressure_table.hpp"

namespace snug::postproc {
namespace {

struct NameOf {
  std::string operator()(const Line&) const { return "linear"; }
  std::string operator()(const Polyline&) const { return "piecewise"; }
  std::string operator()(const Logistic&) const { return "logistic"; }
};

struct ValueAt {
  double pressure;

  double operator()(const Line& line) const { return line.intercept + line.slope * pressure; }
  double operator()(const Polyline& line) const {
    const auto& p = line.pressures;
    const auto& r = line.ratings;
    const auto right = std::upper_bound(p.begin(), p.end(), pressure);
    if (right == p.begin()) return r.front();
    if (right == p.end()) return r.back();
    const auto i = right - p.begin();
    const double share = (pressure - p[i - 1]) / (p[i] - p[i - 1]);
    return r[i - 1] + share * (r[i] - r[i - 1]);
  }
  double operator()(const Logistic& curve) const {
    return curve.lowest + (curve.highest - curve.lowest) / (1.0 + std::exp(-(pressure - curve.middle) / curve.width));
  }
};

/// What one observation at `pressure` adds to the uncertainty of the fit: exact for a line,
/// 1/n + (p - mean)^2 / sum (p - mean)^2, and its mean over the data, k/n, for other shapes.
double leverage(const SensationCurve& curve, double pressure) {
  if (curve.points == 0) return 0.0;
  const double n = curve.points;
  if (!std::holds_alternative<Line>(curve.shape) || !(curve.pressure_squares > 0.0)) return curve.parameters / n;
  const double distance = pressure - curve.mean_pressure;
  return 1.0 / n + distance * distance / curve.pressure_squares;
}

}  // namespace

std::string sensation_term(double rating) {
  static constexpr std::array terms = {"neutral", "comfortable", "uncomfortable", "very uncomfortable",
                                       "extremely uncomfortable"};
  return terms[std::lround(std::clamp(rating, lowest_rating, highest_rating))];
}

std::string shape_name(const CurveShape& shape) { return std::visit(NameOf{}, shape); }

double value_at(const CurveShape& shape, double pressure) { return std::visit(ValueAt{pressure}, shape); }

Rating rate(const SensationCurve& curve, double pressure) {
  const double value = curve.significant ? value_at(curve.shape, pressure) : curve.mean_rating;
  Rating rating;
  rating.value = std::clamp(value, lowest_rating, highest_rating);
  rating.term = sensation_term(rating.value);
  rating.significant = curve.significant;
  rating.extrapolated = pressure < curve.low || pressure > curve.high;
  if (curve.significant) {
    rating.error = curve.scatter * std::sqrt(1.0 + leverage(curve, pressure));
    rating.degrees = curve.points - curve.parameters;
  } else {
    rating.error = curve.mean_scatter * std::sqrt(1.0 + (curve.points > 0 ? 1.0 / curve.points : 0.0));
    rating.degrees = curve.points - 1;
  }
  return rating;
}

const SensationCurve* SensationCurves::find(std::string_view location) const {
  for (const std::string_view name : {location, without_side(location)})
    for (const SensationCurve& curve : curves)
      if (same_name(curve.location, name)) return &curve;
  return nullptr;
}

std::string_view without_side(std::string_view location) {
  for (const std::string_view side : {" left", " right"})
    if (location.size() > side.size() && same_name(location.substr(location.size() - side.size()), side)) return location.substr(0, location.size() - side.size());
  return location;
}

std::string verdict(const SensationCurves& data, std::string_view location, double pressure) {
  const bool own = std::any_of(data.bands.begin(), data.bands.end(), [&](const PressureBand& band) { return same_name(band.location, location); });
  const std::string_view name = own ? location : without_side(location);
  const PressureBand* below = nullptr;  // the last band that ends below the pressure
  for (const PressureBand& band : data.bands) {
    if (!band.location.empty() && !same_name(band.location, name)) continue;
    if (pressure < band.low) return below ? "between " + below->name + " and " + band.name : "below " + band.name;
    if (pressure <= band.high) return band.name;
    below = &band;
  }
  return below ? "above " + below->name : std::string();
}

}  // namespace snug::postproc
