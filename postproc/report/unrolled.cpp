#include "postproc/report/unrolled.hpp"

#include <fmt/format.h>
#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "postproc/report/skin_chart.hpp"

namespace snug::postproc::report {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// The angle, a multiple of 15 deg, at which a cut divides the fewest triangles of one location (it lies on both sides)
/// and touches the fewest of any; the back if all are alike.
double best_cut(const Skin& skin, const SkinChart& chart) {
  double reach = 15.0;  // deg; what lies nearer to the cut touches it
  for (const Triangle& t : skin.triangles)
    for (const int i : {1, 2}) {
      const double width = std::abs(wrapped(chart.at[t[i]].x() - chart.at[t[0]].x(), -180.0));
      if (width < 45.0) reach = std::max(reach, 1.01 * width);
    }
  double best = -90.0;
  std::pair<long, long> fewest{-1, -1};  // divided, touched
  for (int step = 0; step < 24; ++step) {
    const double cut = -90.0 + 15.0 * step;
    std::vector<long> before(skin.locations.size(), 0), after = before;
    for (const Triangle& t : skin.triangles) {
      const int location = skin.location[t[0]];
      if (location < 0 || skin.location[t[1]] != location || skin.location[t[2]] != location) continue;
      const double angle = wrapped(chart.at[t[0]].x() - cut, -180.0);
      if (std::abs(angle) < reach) ++(angle < 0.0 ? before : after)[location];
    }
    std::pair<long, long> count{0, 0};
    for (std::size_t l = 0; l < before.size(); ++l)
      count.first += std::min(before[l], after[l]), count.second += before[l] + after[l];
    if (fewest.first < 0 || count < fewest) fewest = count, best = cut;
  }
  return best > 90.0 ? best - 360.0 : best;
}

/// The sheet to draw: triangles over the cut are drawn at both ends, with nodes of their own.
struct Drawing {
  Sheet sheet;
  std::vector<int> node;  ///< of the skin, a point of the sheet
  template <class Value>
  std::vector<double> values(const Value& value) const {
    std::vector<double> result;
    for (const int n : node) result.push_back(value(n));
    return result;
  }
};

class Drawer {
 public:
  Drawer(const Skin& skin, const SkinChart& chart, double width) : chart_(chart) {
    double low = 1e300, high = -1e300, left = 1e300, right = -1e300;
    for (const Vector2d& at : chart.at) {
      low = std::min(low, at.y()), high = std::max(high, at.y());
      left = std::min(left, at.x()), right = std::max(right, at.x());
    }
    from_ = chart.tube ? best_cut(skin, chart) : left;
    low_ = low, high_ = high;
    across_ = width / (chart.tube ? 360.0 : std::max(right - left, 1e-12));
    const double metres = chart.tube ? chart.girth : right - left;
    along_ = width / std::max(metres, 1e-12);
    const double drawn = (high - low) * along_, bounded = std::clamp(drawn, 0.22 * width, 0.8 * width);
    along_ *= bounded / std::max(drawn, 1e-12);
    width_ = width, height_ = bounded;
  }

  Vector2d place(double across, double along) const {
    return {(across - from_) * across_, height_ - (along - low_) * along_};
  }

  Drawing draw(const Skin& skin) const {
    Drawing drawing;
    std::array<std::vector<int>, 2> copies;  // points of the sheet: on this side of the cut, and one turn on
    copies[0].assign(skin.nodes.size(), -1), copies[1] = copies[0];
    const auto point = [&](int n, double angle) {
      int& index = copies[angle >= from_ + 360.0 ? 1 : 0][n];
      if (index < 0) {
        index = static_cast<int>(drawing.node.size());
        drawing.sheet.points.push_back(place(angle, chart_.at[n].y()));
        drawing.node.push_back(n);
      }
      return index;
    };
    for (const Triangle& t : skin.triangles) {
      if (const Slit slit = slit_of(t); slit != Slit::none) {
        if (slit == Slit::inner) add_at_slit(t, drawing);
        continue;
      }
      std::array<double, 3> angle{};
      for (int i = 0; i < 3; ++i) angle[i] = chart_.tube ? wrapped(chart_.at[t[i]].x(), from_) : chart_.at[t[i]].x();
      const bool cut =
          chart_.tube &&
          *std::max_element(angle.begin(), angle.end()) - *std::min_element(angle.begin(), angle.end()) > 180.0;
      Triangle triangle{};
      for (int i = 0; i < 3; ++i) {
        if (cut && angle[i] < from_ + 180.0) angle[i] += 360.0;
        triangle[i] = point(t[i], angle[i]);
      }
      drawing.sheet.triangles.push_back(triangle);
      if (cut) add_before(t, angle, drawing);
    }
    return drawing;
  }

  std::vector<MapTick> across_ticks() const {
    std::vector<MapTick> result;
    if (!chart_.tube) {
      for (const double x : ticks(from_ * 1e3, (from_ + width_ / across_) * 1e3, 8))
        result.push_back({place(x / 1e3, 0.0).x(), plain(x)});
      return result;
    }
    for (double angle = std::ceil(from_ / 45.0) * 45.0; angle <= from_ + 360.0; angle += 45.0) {
      const int quarter = static_cast<int>(wrapped(angle, 0.0)) / 90;
      const bool named = std::fmod(std::abs(angle), 90.0) == 0.0;
      const char* const names[] = {"side (+x)", "front (+y)", "side (−x)", "back (−y)"};
      result.push_back({place(angle, 0.0).x(), plain(angle) + "°" + (named ? std::string(" ") + names[quarter] : "")});
    }
    return result;
  }

  std::vector<MapTick> along_ticks() const {
    std::vector<MapTick> result;
    for (const double z : ticks(low_ * 1e3, high_ * 1e3, 7)) result.push_back({place(0.0, z / 1e3).y(), plain(z)});
    return result;
  }

  double width() const { return width_; }
  double height() const { return height_; }
  double from() const { return from_; }

 private:
  enum class Slit { none, inner, crotch };
  /// Triangles over the inner side of a limb, and those between limbs and trunk that would be drawn right across.
  Slit slit_of(const Triangle& t) const {
    constexpr double widest = 60.0;  // deg on the map
    if (!chart_.tube) return Slit::none;
    const int limb = chart_.limb[t[0]];
    const bool one = chart_.limb[t[1]] == limb && chart_.limb[t[2]] == limb;
    if (one && limb == 0) return Slit::none;
    double span = 0.0;
    for (int i = 0; i < 3; ++i) {
      const double step = chart_.at[t[i]].x() - chart_.at[t[(i + 1) % 3]].x();
      span = std::max(span, one ? std::abs(step) : std::abs(wrapped(step, -180.0)));
    }
    return span <= widest ? Slit::none : one ? Slit::inner : Slit::crotch;
  }
  /// Once at each side of the slit, up to it.
  void add_at_slit(const Triangle& t, Drawing& drawing) const {
    const double middle = chart_.limb[t[0]] == 1 ? 0.0 : 180.0;
    for (const double side : {-1.0, 1.0}) {
      Triangle triangle{};
      for (int i = 0; i < 3; ++i) {
        const double off = wrapped(chart_.at[t[i]].x() - middle, -180.0);
        triangle[i] = static_cast<int>(drawing.node.size());
        drawing.sheet.points.push_back(place(wrapped(middle, from_) + (off * side > 0.0 ? off : 90.0 * side), chart_.at[t[i]].y()));
        drawing.node.push_back(t[i]);
      }
      drawing.sheet.triangles.push_back(triangle);
    }
  }

  /// The copy of a triangle over the cut that begins before the left end.
  void add_before(const Triangle& t, const std::array<double, 3>& angle, Drawing& drawing) const {
    Triangle triangle{};
    for (int i = 0; i < 3; ++i) {
      triangle[i] = static_cast<int>(drawing.node.size());
      drawing.sheet.points.push_back(place(angle[i] - 360.0, chart_.at[t[i]].y()));
      drawing.node.push_back(t[i]);
    }
    drawing.sheet.triangles.push_back(triangle);
  }

  const SkinChart& chart_;
  double from_ = 0.0, low_ = 0.0, high_ = 0.0, across_ = 1.0, along_ = 1.0, width_ = 0.0, height_ = 0.0;
};

std::vector<MapPatch> patches(const Skin& skin, const Drawing& drawing, const Drawer& drawer) {
  std::vector<MapPatch> result;
  for (std::size_t l = 0; l < skin.locations.size(); ++l) {
    MapPatch patch;
    patch.name = skin.locations[l];
    const auto inside = drawing.values([&](int n) { return skin.location[n] == static_cast<int>(l) ? 1.0 : 0.0; });
    patch.path = region_path(drawing.sheet, inside, 0.5);
    long count = 0;
    for (std::size_t n = 0; n < inside.size(); ++n) {
      const double x = drawing.sheet.points[n].x();
      if (inside[n] < 0.5 || x < 0.0 || x > drawer.width()) continue;
      patch.x += x, patch.y += drawing.sheet.points[n].y(), ++count;
    }
    if (count == 0) continue;
    patch.x /= static_cast<double>(count), patch.y /= static_cast<double>(count);
    result.push_back(patch);
  }
  return result;
}

}  // namespace

void set_labels_apart(std::vector<MapPatch>& patches) {
  constexpr double letter = 7.6, tall = 34.0;  // px: width of a letter of the names; height of name and pressure
  const auto touch = [](const MapPatch& a, const MapPatch& b) {
    return std::abs(a.label_y - b.label_y) < tall && std::abs(a.x - b.x) < 0.5 * letter * static_cast<double>(a.name.size() + b.name.size());
  };
  for (auto patch = patches.begin(); patch != patches.end(); ++patch)
    for (const double rows : {0.0, -1.0, 1.0, -2.0, 2.0, 0.0}) {  // the middle, too, where no row is free
      patch->label_y = patch->y + rows * tall;
      if (std::none_of(patches.begin(), patch, [&](const MapPatch& other) { return touch(*patch, other); })) break;
    }
}

UnrolledMap unroll(const Skin& skin, const PressureScale& scale, double width) {
  const SkinChart chart = skin_chart(skin);
  const Drawer drawer(skin, chart, width);
  const Drawing drawing = drawer.draw(skin);
  UnrolledMap map;
  map.width = drawer.width(), map.height = drawer.height();
  map.unrolled = chart.tube;
  map.across = drawer.across_ticks(), map.along = drawer.along_ticks();
  const bool limbs = std::any_of(chart.limb.begin(), chart.limb.end(), [](int limb) { return limb > 0; });
  map.across_name = !chart.tube ? "across [mm]" : limbs ? "angle round the body; limbs side by side are slit inside and have half the width each" : "angle round the body";
  map.along_name = chart.tube ? "height [mm]" : "along [mm]";
  map.skin = region_path(drawing.sheet, drawing.values([](int) { return 1.0; }), 0.5);
  map.edge = region_path(drawing.sheet, drawing.values([&](int n) { return skin.coverage[n]; }), 0.5);
  const auto pressure = drawing.values([&](int n) { return skin.pressure[n]; });
  for (int band = 0; band < scale.bands; ++band) {
    const double level = band > 0 ? scale.level(band) : 1e-3 * scale.top;  // skin without contact is not of the scale
    std::string path = region_path(drawing.sheet, pressure, level);
    if (!path.empty()) map.bands.emplace_back(scale.band_colour(band), std::move(path));
  }
  map.patches = patches(skin, drawing, drawer);
  set_labels_apart(map.patches);
  const std::vector<double>& beside = pressure_beside(skin);
  const auto peak = std::max_element(beside.begin(), beside.end()) - beside.begin();
  const Vector2d at = chart.at[peak];
  const double angle = chart.tube ? wrapped(at.x(), drawer.from()) : at.x();
  const Vector2d place = drawer.place(angle, at.y());
  const int limb = chart.tube ? chart.limb[peak] : 0;
  map.largest_x = place.x(), map.largest_y = place.y();
  map.largest_place =
      chart.tube ? fmt::format("at {}°{}, height {} mm", plain(std::round(limb > 0 ? chart.angle[peak] : angle)), limb == 1 ? " of the limb on the side of +x" : limb == 2 ? " of the limb on the side of −x" : "", plain(std::round(1e3 * at.y())))
                 : fmt::format("at {} mm across, {} mm along", plain(std::round(1e3 * at.x())),
                               plain(std::round(1e3 * at.y())));
  return map;
}

}  // namespace snug::postproc::report
