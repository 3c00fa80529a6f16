// The pieces of the garments drawn flat, coloured by what they bear.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "postproc/grid.hpp"
#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

constexpr double fine = 2.0;  // units of a drawing to a pixel: coordinates are whole numbers

/// A quantity of the triangles, and how it is shown.
struct Shown {
  const char *title, *unit, *note;
  std::vector<double> values;  ///< of the cells; NaN: not known there
};

/// The flat pieces on the page: y downwards, `scale` units to a metre.
struct FlatSheet {
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = Eigen::Vector2d::Constant(-1e300);
  double scale = 1.0;

  Eigen::Vector2i at(const Eigen::Vector2d& x) const {
    return {static_cast<int>(std::lround(scale * (x.x() - low.x()))), static_cast<int>(std::lround(scale * (high.y() - x.y())))};
  }
};

FlatSheet sheet_of(const std::vector<Eigen::Vector2d>& pattern, double width) {
  FlatSheet sheet;
  for (const Eigen::Vector2d& x : pattern) sheet.low = sheet.low.cwiseMin(x), sheet.high = sheet.high.cwiseMax(x);
  const Eigen::Vector2d size = sheet.high - sheet.low;
  sheet.scale = fine * std::min(width / size.x(), 0.9 * width / size.y());
  return sheet;
}

std::vector<double> larger(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> result = a;
  for (std::size_t c = 0; c < result.size(); ++c) result[c] = std::max(a[c], b[c]);
  return result;
}

/// Ease in percent by height, of the rows of the summary; NaN for a garment without.
double ease_at(const Json& fit, const std::string& garment, double height) {
  double ease = std::nan(""), below = -std::numeric_limits<double>::max(), at_below = std::nan("");
  for (const Json& row : fit) {  // from below
    if (!garment.empty() && row.value("garment", "") != garment) continue;
    const double z = value_at(row, "height_m"), here = 100.0 * value_at(row, "ease");
    if (z >= height) return std::isnan(at_below) ? here : at_below + (here - at_below) * (height - below) / (z - below);
    below = z, at_below = ease = here;
  }
  return ease;
}

/// Of each triangle at the height where it was placed.
std::vector<double> eases(const ShownRun& run, const Grid& grid) {
  const Json fit = run.summary.value("fit", Json::array());
  const auto* displacement = grid.fields.find(field::displacement);
  const auto* part = grid.fields.find(field::garment);
  std::vector<std::string> names;
  for (const Json& row : fit)
    if (const std::string name = row.value("garment", ""); std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  std::vector<double> result(grid.cells(), std::nan(""));
  if (fit.empty() || !displacement) return result;
  for (std::size_t c = 0; c < result.size(); ++c) {
    double height = 0.0;
    for (int k = 0; k < 3; ++k) {
      const int node = grid.nodes_of(c)[k];
      height += (grid.points[node].z() - (*displacement)[node].z()) / 3.0;
    }
    const std::size_t g = part ? static_cast<std::size_t>((*part)[c]) : 0;
    result[c] = ease_at(fit, part && g < names.size() ? names[g] : "", height);
  }
  return result;
}

std::vector<Shown> quantities(const ShownRun& run, const Grid& grid) {
  std::vector<Shown> shown;
  const auto *warp = grid.fields.find(field::tension_warp), *weft = grid.fields.find(field::tension_weft);
  if (warp && weft) shown.push_back({"Tension", "N/m", "the larger one of warp and weft", larger(*warp, *weft)});
  if (const auto* stretch = grid.fields.find(field::stretch)) {
    std::vector<double> percent;
    for (const Eigen::Vector2d& s : *stretch) percent.push_back(100.0 * (s.maxCoeff() - 1.0));
    shown.push_back({"Stretch", "%", "the larger one along warp and weft", std::move(percent)});
  }
  shown.push_back({"Ease", "%", "girth of the garment as cut against that of the body at the height where it was placed", eases(run, grid)});
  std::erase_if(shown, [](const Shown& one) { return std::none_of(one.values.begin(), one.values.end(), [](double v) { return std::isfinite(v); }); });
  return shown;
}

/// Round limits that hold all but a hundredth of the values at either end.
std::vector<double> levels(std::vector<double> values) {
  std::erase_if(values, [](double v) { return !std::isfinite(v); });
  std::sort(values.begin(), values.end());
  const double low = values[values.size() / 100], high = values[values.size() - 1 - values.size() / 100];
  const double step = round_step(std::max(high - low, 1e-3 * std::max(1.0, std::abs(high))), 8);
  std::vector<double> result;
  for (double k = std::floor(low / step + 1e-9); result.size() < 2 || (result.back() < high - 1e-9 * step && result.size() < 13); ++k) result.push_back(k * step + 0.0);
  return result;
}

/// Corners of the triangles of a band, as one path.
std::string path_of(const Grid& grid, const std::vector<Eigen::Vector2d>& pattern, const FlatSheet& sheet, const std::vector<std::size_t>& cells) {
  std::string path;
  for (const std::size_t c : cells) {
    const auto nodes = grid.nodes_of(c);
    const Eigen::Vector2i a = sheet.at(pattern[nodes[0]]), b = sheet.at(pattern[nodes[1]]) - a, d = sheet.at(pattern[nodes[2]]) - a - b;
    path += fmt::format("M{} {}l{} {} {} {}z", a.x(), a.y(), b.x(), b.y(), d.x(), d.y());
  }
  return path;
}

Json drawing_of(const Shown& shown, const Grid& grid, const std::vector<Eigen::Vector2d>& pattern, const FlatSheet& sheet) {
  const std::vector<double> level = levels(shown.values);
  const std::size_t count = level.size() - 1;
  std::vector<std::vector<std::size_t>> cells(count);
  for (std::size_t c = 0; c < shown.values.size(); ++c) {
    if (!std::isfinite(shown.values[c])) continue;
    const double at = (shown.values[c] - level.front()) / (level[1] - level[0]);
    cells[static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(count - 1)))].push_back(c);
  }
  Json bands = Json::array(), key = Json::array();
  for (std::size_t b = 0; b < count; ++b) {
    const std::string tint = colour((static_cast<double>(b) + 0.5) / static_cast<double>(count));
    if (!cells[b].empty()) bands.push_back({{"colour", tint}, {"path", path_of(grid, pattern, sheet, cells[b])}});
    key.push_back({{"colour", tint}, {"text", plain(level[b]) + " to " + plain(level[b + 1])}});
  }
  return {{"title", shown.title}, {"unit", shown.unit}, {"note", shown.note}, {"bands", bands}, {"key", key}};
}

/// Names of the pieces in the middle of each.
Json labels_of(const Grid& grid, const std::vector<Eigen::Vector2d>& pattern, const FlatSheet& sheet) {
  Json labels = Json::array();
  const auto* names = grid.find_names("piece_names");
  const auto* piece = grid.fields.find(field::piece);
  if (!names || !piece) return labels;
  std::vector<Eigen::Vector2d> low(names->size(), Eigen::Vector2d::Constant(1e300)), high(names->size(), Eigen::Vector2d::Constant(-1e300));
  for (std::size_t c = 0; c < grid.cells(); ++c) {
    const std::size_t p = static_cast<std::size_t>((*piece)[c]);
    for (int k = 0; k < 3 && p < names->size(); ++k) {
      const Eigen::Vector2d& x = pattern[grid.nodes_of(c)[k]];
      low[p] = low[p].cwiseMin(x), high[p] = high[p].cwiseMax(x);
    }
  }
  for (std::size_t p = 0; p < names->size(); ++p) {
    if (low[p].x() > high[p].x()) continue;
    const Eigen::Vector2i at = sheet.at(0.5 * (low[p] + high[p]));
    labels.push_back({{"name", (*names)[p]}, {"x", at.x()}, {"y", at.y()}});
  }
  return labels;
}

}  // namespace

Json pieces_view(const ShownRun& run, double width) {
  if (!run.garment_grid) return nullptr;
  const Grid& grid = *run.garment_grid;
  const auto* pattern = grid.fields.find(field::pattern);
  if (!pattern || pattern->size() != grid.points.size() || grid.cells() == 0) return nullptr;
  const FlatSheet sheet = sheet_of(*pattern, width);
  if (!std::isfinite(sheet.scale) || !(sheet.scale > 0.0)) return nullptr;
  const Eigen::Vector2i size = sheet.at({sheet.high.x(), sheet.low.y()});
  Json drawings = Json::array();
  for (const Shown& shown : quantities(run, grid))
    if (shown.values.size() == grid.cells()) drawings.push_back(drawing_of(shown, grid, *pattern, sheet));
  if (drawings.empty()) return nullptr;
  return {{"box_width", size.x() + 8}, {"box_height", size.y() + 8}, {"labels", labels_of(grid, *pattern, sheet)}, {"drawings", drawings}};
}

}  // namespace snug::postproc::report
