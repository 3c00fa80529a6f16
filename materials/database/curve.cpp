#include "materials/database/curve.hpp"

#include <fmt/format.h>
#include <gsl/gsl_interp.h>

#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

#include "materials/database/datum.hpp"

namespace snug::materials {

namespace {

constexpr std::size_t most_points = 100'000;

/// Without blanks and quotation marks at both ends.
std::string bare(std::string text) {
  text.erase(0, text.find_first_not_of(" \t\r\""));
  text.erase(text.find_last_not_of(" \t\r\"") + 1);
  return text;
}

Curve::Column column_of(const std::string& head, const input::Location& where, UnitBook& units) {
  const auto open = head.find('['), close = head.rfind(']');
  Curve::Column column{.name = bare(head.substr(0, open)), .unit = {}, .si = {}, .values = {}};
  if (open != head.npos && close != head.npos && close > open)
    column.unit = bare(head.substr(open + 1, close - open - 1));
  const auto si = units.find(column.unit);
  if (!si || column.name.empty())
    throw input::InputError(where, "the column \"" + bare(head) + "\" has no name, or no unit that is one",
                            "write its head as in \"force [gf]\"");
  column.si = *si;
  return column;
}

/// The two cells of a line.
std::pair<std::string, std::string> cells(const std::string& line, const input::Location& where) {
  const auto comma = line.find(',');
  if (comma == line.npos || line.find(',', comma + 1) != line.npos)
    throw input::InputError(where, "a line that has not two cells", "give two numbers, separated by a comma");
  return {bare(line.substr(0, comma)), bare(line.substr(comma + 1))};
}

double number(const std::string& cell, const SiUnit& unit, const input::Location& where) {
  const auto value = plain_number(cell);
  if (!value || !std::isfinite(*value * unit.factor))
    throw input::InputError(where, "\"" + cell + "\" is no finite number",
                            "give a number with a decimal point and without a unit");
  return *value * unit.factor;
}

}  // namespace

Curve Curve::parse(const std::string& text, const std::string& file, UnitBook& units) {
  Curve curve;
  std::istringstream lines(text);
  bool has_head = false;
  int count = 0;
  for (std::string line; std::getline(lines, line);) {
    const input::Location where{file, ++count, 1};
    if (count == 1 && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
    if (bare(line).empty() || line[0] == '#') continue;
    const auto [left, right] = cells(line, where);
    if (!std::exchange(has_head, true)) {
      curve.x = column_of(left, where, units), curve.y = column_of(right, where, units);
      continue;
    }
    const double x = number(left, curve.x.si, where), y = number(right, curve.y.si, where);
    if (!curve.x.values.empty() && !(x > curve.x.values.back()))
      throw input::InputError(where, "the " + curve.x.name + " " + left + " does not increase",
                              "sort the points, and give each place once");
    if (curve.x.values.size() == most_points)
      throw input::InputError(where, "more than " + std::to_string(most_points) + " points", "leave some out");
    curve.x.values.push_back(x), curve.y.values.push_back(y);
  }
  if (curve.x.values.size() < 2)
    throw input::InputError({file, 0, 0}, "a curve of less than two points", "give a head line and one line a point");
  return curve;
}

double Curve::at(double place) const {
  const auto& px = x.values;
  const auto& py = y.values;
  if (!(place >= px.front() && place <= px.back())) return std::numeric_limits<double>::quiet_NaN();
  if (px.size() == 2) return py[0] + (py[1] - py[0]) * (place - px[0]) / (px[1] - px[0]);
  const std::unique_ptr<gsl_interp, decltype(&gsl_interp_free)> steffen(gsl_interp_alloc(gsl_interp_steffen, px.size()),
                                                                        &gsl_interp_free);
  gsl_interp_init(steffen.get(), px.data(), py.data(), px.size());
  return gsl_interp_eval(steffen.get(), px.data(), py.data(), place, nullptr);
}

}  // namespace snug::materials
