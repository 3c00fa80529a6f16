// Writes a set of curves as the TOML that curve_library.cpp reads.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "postproc/comfort/curve_library.hpp"

namespace snug::postproc {
namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
    else
      result += c;
  }
  return result + '"';
}

std::string number(const std::string& key, double value, const std::string& unit = {}) {
  if (!std::isfinite(value)) return {};
  // A whole number is no number with a point: TOML keeps them apart.
  std::string digits = fmt::format("{}", value);
  if (unit.empty()) {
    if (digits.find_first_of(".e") == std::string::npos) digits += ".0";
    return fmt::format("{} = {}\n", key, digits);
  }
  return fmt::format("{} = \"{} {}\"\n", key, digits, unit);
}

struct ShapeText {
  const SensationCurve& curve;

  std::string operator()(const Line& line) const {
    return number("intercept", line.intercept) + number("intercept_error", curve.intercept_error) +
           number("slope", line.slope, "1/Pa") + number("slope_error", curve.slope_error, "1/Pa");
  }
  std::string operator()(const Polyline& line) const {
    std::string pressures, ratings;
    for (std::size_t i = 0; i < line.pressures.size(); ++i) {
      pressures += fmt::format("{}\"{} Pa\"", i ? ", " : "", line.pressures[i]);
      ratings += fmt::format("{}{}", i ? ", " : "", line.ratings[i]);
    }
    return fmt::format("pressures = [{}]\nratings = [{}]\n", pressures, ratings);
  }
  std::string operator()(const Logistic& curve) const {
    return number("lowest", curve.lowest) + number("highest", curve.highest) + number("middle", curve.middle, "Pa") +
           number("width", curve.width, "Pa");
  }
};

std::string curve_text(const SensationCurve& curve) {
  std::string text =
      fmt::format("\n[[curves]]\nlocation = {}\nshape = \"{}\"\n", quoted(curve.location), shape_name(curve.shape));
  text += std::visit(ShapeText{curve}, curve.shape);
  text += fmt::format("range = [\"{} Pa\", \"{} Pa\"]\n", curve.low, curve.high);
  if (curve.points == 0) return text;
  text += fmt::format("points = {}\n", curve.points);
  text += number("scatter", curve.scatter) + number("largest_residual", curve.largest_residual) +
          number("r_squared", curve.r_squared) + number("p_value", curve.p_value) +
          number("mean_rating", curve.mean_rating) + number("mean_scatter", curve.mean_scatter);
  if (curve.points > 1)
    text += number("mean_pressure", curve.mean_pressure, "Pa") +
            number("pressure_spread", std::sqrt(curve.pressure_squares / (curve.points - 1)), "Pa");
  return text;
}

std::string band_text(const PressureBand& band) {
  std::string text = "\n[[bands]]\n";
  if (!band.location.empty()) text += "location = " + quoted(band.location) + "\n";
  return text + "name = " + quoted(band.name) + "\n" + number("from", band.low, "Pa") + number("to", band.high, "Pa");
}

}  // namespace

std::string curves_toml(const SensationCurves& curves) {
  std::string text = fmt::format("name = {}\nsource = {}\npatch = {}\npopulation = {}\n", quoted(curves.name),
                                 quoted(curves.source), quoted(curves.patch), quoted(curves.population));
  if (!curves.notes.empty()) {
    text += "notes = [\n";
    for (const std::string& note : curves.notes) text += "  " + quoted(note) + ",\n";
    text += "]\n";
  }
  for (const SensationCurve& curve : curves.curves) text += curve_text(curve);
  for (const PressureBand& band : curves.bands) text += band_text(band);
  return text;
}

}  // namespace snug::postproc
