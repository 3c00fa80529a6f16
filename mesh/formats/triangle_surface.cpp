#include "mesh/formats/triangle_surface.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace snug::mesh {

namespace {

using Cell = std::array<long, 3>;

double diagonal(const std::vector<Eigen::Vector3d>& points) {
  if (points.empty()) return 0.0;
  Eigen::Vector3d low = points[0], high = points[0];
  for (const auto& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

/// Points in cells of the size of the tolerance; a neighbour is in the same cell or in one of the 26 around it.
class PointGrid {
 public:
  explicit PointGrid(double tolerance) : tolerance_(tolerance) {}

  /// Number of the known point near `point`; a new number when there is none.
  int find_or_add(const Eigen::Vector3d& point) {
    const Cell centre = cell_of(point);
    for (int n = 0; n < 27; ++n) {
      const auto found = cells_.find({centre[0] + n % 3 - 1, centre[1] + n / 3 % 3 - 1, centre[2] + n / 9 - 1});
      if (found == cells_.end()) continue;
      for (int candidate : found->second)
        if ((points_[candidate] - point).norm() <= tolerance_) return candidate;
    }
    cells_[centre].push_back(static_cast<int>(points_.size()));
    points_.push_back(point);
    return static_cast<int>(points_.size()) - 1;
  }
  std::vector<Eigen::Vector3d> take_points() { return std::move(points_); }

 private:
  Cell cell_of(const Eigen::Vector3d& point) const {
    Cell cell;
    for (int a = 0; a < 3; ++a) cell[a] = std::lround(point[a] / tolerance_);
    return cell;
  }

  double tolerance_;
  std::map<Cell, std::vector<int>> cells_;
  std::vector<Eigen::Vector3d> points_;
};

}  // namespace

TriangleSurface weld(const TriangleSurface& surface, double tolerance) {
  if (tolerance <= 0.0) tolerance = std::max(1e-7 * diagonal(surface.vertices), std::numeric_limits<double>::min());
  PointGrid grid(tolerance);
  TriangleSurface welded;
  for (const auto& triangle : surface.triangles) {
    std::array<int, 3> t;
    for (int n = 0; n < 3; ++n) t[n] = grid.find_or_add(surface.vertices[triangle[n]]);
    if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) welded.triangles.push_back(t);
  }
  welded.vertices = grid.take_points();
  return welded;
}

namespace {

long open_edges(const TriangleSurface& surface) {
  std::map<std::array<int, 2>, int> uses;
  for (const auto& t : surface.triangles)
    for (int n = 0; n < 3; ++n) ++uses[{std::min(t[n], t[(n + 1) % 3]), std::max(t[n], t[(n + 1) % 3])}];
  return std::count_if(uses.begin(), uses.end(), [](const auto& entry) { return entry.second != 2; });
}

}  // namespace

TriangleSurface seams_closed(TriangleSurface surface) {
  constexpr double last_digit = 1e-5;
  const long open = open_edges(surface);
  if (open == 0) return surface;
  TriangleSurface closer = weld(surface, last_digit * diagonal(surface.vertices));
  const bool better = closer.triangles.size() == surface.triangles.size() && open_edges(closer) < open;
  return better ? std::move(closer) : std::move(surface);
}

void check_closed(const TriangleSurface& surface, const input::Location& where, std::optional<HeightRange> range) {
  std::map<std::array<int, 2>, int> uses;
  for (const auto& t : surface.triangles)
    for (int n = 0; n < 3; ++n) ++uses[{std::min(t[n], t[(n + 1) % 3]), std::max(t[n], t[(n + 1) % 3])}];
  const auto wrong = [&](const auto& entry) {
    const double a = surface.vertices[entry.first[0]].z(), b = surface.vertices[entry.first[1]].z();
    const bool looked_at = !range || (std::max(a, b) >= range->lower && std::min(a, b) <= range->upper);
    return looked_at && entry.second != 2;
  };
  const auto count = std::count_if(uses.begin(), uses.end(), wrong);
  if (count == 0) return;
  const auto& [edge, triangles] = *std::find_if(uses.begin(), uses.end(), wrong);
  const Eigen::Vector3d &a = surface.vertices[edge[0]], &b = surface.vertices[edge[1]];
  throw input::InputError(
      where,
      fmt::format(
          "the surface is not closed: {} edges do not belong to two triangles, one of them ({} triangle(s)) from "
          "({:.4g}, {:.4g}, {:.4g}) to ({:.4g}, {:.4g}, {:.4g})",
          count, triangles, a.x(), a.y(), a.z(), b.x(), b.y(), b.z()),
      "close the hole in the scanner's program, or move the cut planes so that it lies outside them");
}

}  // namespace snug::mesh
