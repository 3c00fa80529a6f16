#include "postproc/report/line_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "postproc/report/scale.hpp"

namespace snug::postproc::report {

namespace {

constexpr double width = 620.0, height = 260.0;  // px of the drawing without its labels
// Okabe and Ito's colours, which people who confuse colours tell apart; those that white paper carries.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#7a5c00", "#000000"};

struct Axis {
  double low, high;
  double share(double value) const { return (value - low) / (high - low); }
};

std::string px(double value) { return fmt::format("{:.1f}", value); }

}  // namespace

Json line_plot(const std::vector<PlotLine>& series, const std::vector<double>& values, const std::string& axis, std::vector<PlotMark> marks, const std::vector<std::string>& told) {
  if (series.empty() || values.size() < 2) return nullptr;
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  double top = 0.0;
  for (const PlotLine& one : series)
    for (const double v : one.mmHg)
      if (std::isfinite(v)) top = std::max(top, v);
  if (!(*high > *low) || !(top > 0.0)) return nullptr;
  const Axis x{*low, *high}, y{0.0, 1.05 * top};
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  if (marks.empty())
    for (const double value : ticks(x.low, x.high, 6)) marks.push_back({value, fmt::format("{:g}", value)});
  Json columns = Json::array(), levels = Json::array(), lines = Json::array();
  for (const PlotMark& mark : marks) columns.push_back({{"x", px(width * x.share(mark.at))}, {"text", mark.text}});
  for (const double value : ticks(y.low, y.high, 5)) levels.push_back({{"y", px(height * (1.0 - y.share(value)))}, {"text", fmt::format("{:g}", value)}});
  for (std::size_t s = 0; s < series.size(); ++s) {
    Json dots = Json::array();
    std::string points;
    for (const std::size_t r : order) {
      const double v = series[s].mmHg[r];
      if (!std::isfinite(v)) continue;
      const std::string at_x = px(width * x.share(values[r])), at_y = px(height * (1.0 - y.share(v)));
      points += (points.empty() ? "" : " ") + at_x + "," + at_y;
      dots.push_back({{"x", at_x}, {"y", at_y}, {"text", fmt::format("{}: {:.2f} mmHg at {}", series[s].name, v, r < told.size() ? told[r] : fmt::format("{:g}", values[r]))}});
    }
    lines.push_back({{"name", series[s].name}, {"colour", colours[s % colours.size()]}, {"points", points}, {"dots", dots}, {"dash", s >= colours.size() ? "6 4" : "none"}});
  }
  return {{"axis", axis}, {"columns", columns}, {"levels", levels}, {"lines", lines}, {"width", px(width)}, {"height", px(height)}, {"box_width", px(width + 90.0)}, {"box_height", px(height + 60.0)},
          {"middle_x", px(0.5 * width)}, {"middle_y", px(0.5 * height)}};
}

}  // namespace snug::postproc::report
