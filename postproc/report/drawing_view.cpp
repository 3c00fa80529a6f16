// The drawings: the unrolled map and the convergence.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postproc/report/unrolled.hpp"
#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

std::string pixels(double value) { return fmt::format("{:.1f}", value); }

Json ticks_view(const std::vector<MapTick>& ticks) {
  Json view = Json::array();
  for (const MapTick& tick : ticks) view.push_back({{"at", pixels(tick.at)}, {"text", tick.text}});
  return view;
}

Json bar_view(const PressureScale& scale, double height, double over) {
  const double band = height / scale.bands;
  Json bands = Json::array(), labels = Json::array();
  for (int b = 0; b < scale.bands; ++b)
    bands.push_back(
        {{"y", pixels(height - (b + 1) * band)}, {"height", pixels(band + 0.5)}, {"colour", scale.band_colour(b)}});
  const int every = scale.bands > 6 ? 2 : 1;
  for (int b = 0; b <= scale.bands; b += every)
    labels.push_back({{"y", pixels(height - b * band)}, {"text", plain(scale.level(b) / scale.factor)}});
  Json view = {{"bands", bands}, {"labels", labels}, {"height", pixels(height)}, {"unit", scale.unit}};
  view["over"] = over > scale.top;
  view["largest"] = number(over / scale.factor);
  view["middle"] = pixels(0.5 * height);
  return view;
}

/// Mean pressure of a location as the table has it.
std::string mean_of(const ShownRun& run, const std::string& location, const PressureScale& scale) {
  for (const Json& row : run.summary.value("locations", Json::array()))
    if (row.value("location", "") == location)
      return number(value_at(row, "mean_pressure_Pa") / scale.factor) + " " + scale.unit;
  return {};
}

/// The largest pressure as the figures have it: beside hems it may stand between nodes.
double largest_told(const ShownRun& run) {
  const double told = value_at(run.summary.value("numbers", Json::object()), "max_contact_pressure_Pa");
  return std::isfinite(told) ? told : largest(*run.skin);
}

}  // namespace

Json map_view(const ShownRun& run, const PressureScale& scale, double width) {
  if (!run.skin) return nullptr;
  const UnrolledMap map = unroll(*run.skin, scale, width);
  Json bands = Json::array(), patches = Json::array();
  for (const auto& [colour, path] : map.bands) bands.push_back({{"colour", colour}, {"path", path}});
  for (const MapPatch& patch : map.patches)
    patches.push_back({{"name", patch.name},
                       {"path", patch.path},
                       {"x", pixels(patch.x)},
                       {"y", pixels(patch.label_y)},
                       {"mean", mean_of(run, patch.name, scale)}});
  const double top = largest(*run.skin);
  return {{"width", pixels(map.width)},
          {"height", pixels(map.height)},
          {"box_width", pixels(map.width + 170.0)},
          {"box_height", pixels(map.height + 78.0)},
          {"bar_x", pixels(map.width + 34.0)},
          {"skin", map.skin},
          {"edge", map.edge},
          {"bands", bands},
          {"patches", patches},
          {"across", ticks_view(map.across)},
          {"along", ticks_view(map.along)},
          {"across_name", map.across_name},
          {"along_name", map.along_name},
          {"middle_x", pixels(0.5 * map.width)},
          {"middle_y", pixels(0.5 * map.height)},
          {"unrolled", map.unrolled},
          {"bar", bar_view(scale, map.height, top)},
          {"contact", top > 0.0},
          {"largest", number(largest_told(run))},
          {"hems", !run.skin->beside.empty()},
          {"largest_place", map.largest_place},
          {"largest_x", pixels(map.largest_x)},
          {"largest_y", pixels(map.largest_y)}};
}

// Residual and complementarity over all iterations, logarithmic; a line an increment, so that each step's fall is seen.
Json convergence_view(const ShownRun& run, double width) {
  if (run.history.size() < 2) return nullptr;
  constexpr double height = 240.0, lowest = 1e-18;
  double low = 1e300, high = lowest;
  for (const Iteration& row : run.history)
    if (row.residual > lowest) low = std::min(low, row.residual), high = std::max(high, row.residual);
  if (!(high > low)) return nullptr;
  const double bottom = std::floor(std::log10(low)), top = std::ceil(std::log10(high) + 1e-9);
  const double across = width / static_cast<double>(run.history.size() - 1);
  const auto y = [&](double value) {
    return std::clamp(height * (top - std::log10(std::max(value, lowest))) / (top - bottom), 0.0, height);
  };
  Json lines = Json::array(), marks = Json::array(), rows = Json::array();
  const auto close = [&](std::string& path) {
    if (!path.empty()) lines.push_back({{"points", path}});
    path.clear();
  };
  std::string path;
  for (std::size_t n = 0; n < run.history.size(); ++n) {
    const Iteration& row = run.history[n];
    const bool begins = n == 0 || row.increment != run.history[n - 1].increment;
    if (begins) close(path);
    const std::string x = pixels(across * static_cast<double>(n));
    if (begins && n > 0) marks.push_back({{"x", pixels(across * (static_cast<double>(n) - 0.5))}});
    path += x + "," + pixels(y(row.residual)) + " ";
    rows.push_back(
        {{"x", x},
         {"y", pixels(y(row.residual))},
         {"text", fmt::format("increment {}, load {:.4g}: residual {:.2e}, {} nodes in contact{}", row.increment,
                              row.load, row.residual, row.contact_nodes, row.event.empty() ? "" : ", " + row.event)}});
  }
  close(path);
  Json levels = Json::array();
  const int every = top - bottom > 9 ? 3 : 1;
  for (int power = static_cast<int>(bottom); power <= top; power += every)
    levels.push_back({{"y", pixels(y(std::pow(10.0, power)))}, {"text", power == 0 ? "1" : power_of_ten(power)}});
  Json iterations = Json::array();
  for (const double n : ticks(0.0, static_cast<double>(run.history.size() - 1), 12))
    if (n == std::floor(n)) iterations.push_back({{"x", pixels(across * n)}, {"text", plain(n)}});
  return {{"lines", lines},
          {"marks", marks},
          {"rows", rows},
          {"levels", levels},
          {"iterations", iterations},
          {"width", pixels(width)},
          {"height", pixels(height)},
          {"box_width", pixels(width + 110.0)},
          {"box_height", pixels(height + 60.0)},
          {"middle_x", pixels(0.5 * width)},
          {"middle_y", pixels(0.5 * height)},
          {"first", number(run.history.front().residual)},
          {"last", number(run.history.back().residual)}};
}

}  // namespace snug::postproc::report
