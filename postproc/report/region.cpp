#include "postproc/report/region.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <map>

namespace snug::postproc::report {

namespace {

using Pixel = std::pair<int, int>;  // tenths of a pixel

Pixel pixel(const Eigen::Vector2d& point) {
  return {static_cast<int>(std::lround(10.0 * point.x())), static_cast<int>(std::lround(10.0 * point.y()))};
}

/// Directed edges; one that comes in both directions is inside and cancels.
class Outline {
 public:
  void add(const Pixel& a, const Pixel& b) {
    if (a == b) return;
    const auto [first, last] = edges_.equal_range(b);
    for (auto it = first; it != last; ++it)
      if (it->second == a) {
        edges_.erase(it);
        return;
      }
    edges_.emplace(a, b);
  }

  /// As many edges enter a point as leave it, so that following them always comes back.
  std::string path() {
    std::string text;
    while (!edges_.empty()) {
      const Pixel start = edges_.begin()->first;
      text += fmt::format("M{:g},{:g}l", 0.1 * start.first, 0.1 * start.second);
      for (Pixel at = start;;) {
        const auto edge = edges_.find(at);
        if (edge == edges_.end()) break;
        const Pixel next = edge->second;
        edges_.erase(edge);
        if (next == start) break;
        text += fmt::format("{:g},{:g} ", 0.1 * (next.first - at.first), 0.1 * (next.second - at.second));
        at = next;
      }
      text.back() = 'z';
    }
    return text;
  }

 private:
  std::multimap<Pixel, Pixel> edges_;
};

/// Where the level cuts an edge, computed alike from both sides of it.
Eigen::Vector2d crossing(const Sheet& sheet, const std::vector<double>& values, int a, int b, double level) {
  if (a > b) std::swap(a, b);
  const double t = (level - values[a]) / (values[b] - values[a]);
  return sheet.points[a] + t * (sheet.points[b] - sheet.points[a]);
}

/// All triangles in one sense, so that neighbours run along their edge in opposite directions.
Triangle turned(const Sheet& sheet, const Triangle& t) {
  const Eigen::Vector2d u = sheet.points[t[1]] - sheet.points[t[0]], v = sheet.points[t[2]] - sheet.points[t[0]];
  return u.x() * v.y() - u.y() * v.x() < 0.0 ? Triangle{t[0], t[2], t[1]} : t;
}

/// The corners of a triangle's part at or above the level.
std::vector<Pixel> clipped(const Sheet& sheet, const std::vector<double>& values, const Triangle& given, double level) {
  const Triangle triangle = turned(sheet, given);
  std::vector<Pixel> corners;
  for (int i = 0; i < 3; ++i) {
    const int a = triangle[i], b = triangle[(i + 1) % 3];
    const bool in = values[a] >= level, next_in = values[b] >= level;
    if (in) corners.push_back(pixel(sheet.points[a]));
    if (in != next_in) corners.push_back(pixel(crossing(sheet, values, a, b, level)));
  }
  return corners;
}

}  // namespace

std::string region_path(const Sheet& sheet, const std::vector<double>& values, double level) {
  Outline outline;
  for (const Triangle& triangle : sheet.triangles) {
    const std::vector<Pixel> corners = clipped(sheet, values, triangle, level);
    for (std::size_t i = 0; i < corners.size(); ++i) outline.add(corners[i], corners[(i + 1) % corners.size()]);
  }
  return outline.path();
}

}  // namespace snug::postproc::report
