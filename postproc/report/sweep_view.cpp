// Pressures over the values of a sweep, as lines of a drawing.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "postproc/report/compare_rows.hpp"
#include "postproc/report/scale.hpp"
#include "postproc/report/template.hpp"
#include "postproc/report/view.hpp"
#include "postproc/units.hpp"

namespace snug::postproc::report {

namespace {

constexpr double width = 620.0, height = 260.0;  // px of the drawing without its labels
// Okabe and Ito's colours, which people who confuse colours tell apart; those that white paper carries.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#7a5c00", "#000000"};

struct Axis {
  double low, high;
  double share(double value) const { return (value - low) / (high - low); }
};

struct Series {
  std::string name;
  std::vector<double> mmHg;
};

std::vector<Series> series_of(const Runs& runs) {
  std::vector<Series> all;
  const auto add = [&](const std::string& name, auto value) {
    Series one{name, {}};
    for (const ShownRun& run : runs) one.mmHg.push_back(run.summary.value("status", "") == "converged" ? to_mmHg(value(run)) : std::nan(""));
    if (std::any_of(one.mmHg.begin(), one.mmHg.end(), [](double v) { return std::isfinite(v); })) all.push_back(std::move(one));
  };
  for (const std::string& name : compared_location_names(runs)) add(name, [&](const ShownRun& run) { return location_pressure(run, name); });
  add("whole cover", [](const ShownRun& run) { return value_at(run.summary.value("numbers", Json::object()), "mean_contact_pressure_Pa"); });
  return all;
}

std::string px(double value) { return fmt::format("{:.1f}", value); }

}  // namespace

Json sweep_view(const Runs& runs, const std::vector<double>& values, const std::string& axis) {
  const std::vector<Series> series = values.size() == runs.size() ? series_of(runs) : std::vector<Series>{};
  if (series.empty() || values.size() < 2) return nullptr;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double top = 0.0;
  for (const Series& one : series)
    for (const double v : one.mmHg)
      if (std::isfinite(v)) top = std::max(top, v);
  if (!(*high > *low) || !(top > 0.0)) return nullptr;
  const Axis x{*low, *high}, y{0.0, 1.05 * top};
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  Json columns = Json::array(), levels = Json::array(), lines = Json::array();
  for (const double value : ticks(x.low, x.high, 6)) columns.push_back({{"x", px(width * x.share(value))}, {"text", fmt::format("{:g}", value)}});
  for (const double value : ticks(y.low, y.high, 5)) levels.push_back({{"y", px(height * (1.0 - y.share(value)))}, {"text", fmt::format("{:g}", value)}});
  for (std::size_t s = 0; s < series.size(); ++s) {
    Json dots = Json::array();
    std::string points;
    for (const std::size_t r : order) {
      const double v = series[s].mmHg[r];
      if (!std::isfinite(v)) continue;
      const std::string at_x = px(width * x.share(values[r])), at_y = px(height * (1.0 - y.share(v)));
      points += (points.empty() ? "" : " ") + at_x + "," + at_y;
      dots.push_back({{"x", at_x}, {"y", at_y}, {"text", fmt::format("{}: {:.2f} mmHg at {:g}", series[s].name, v, values[r])}});
    }
    lines.push_back({{"name", series[s].name}, {"colour", colours[s % colours.size()]}, {"points", points}, {"dots", dots}, {"dash", s >= colours.size() ? "6 4" : "none"}});
  }
  return {{"axis", axis}, {"columns", columns}, {"levels", levels}, {"lines", lines}, {"width", px(width)}, {"height", px(height)}, {"box_width", px(width + 90.0)}, {"box_height", px(height + 60.0)},
          {"middle_x", px(0.5 * width)}, {"middle_y", px(0.5 * height)}};
}

}  // namespace snug::postproc::report
