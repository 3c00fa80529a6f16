#include "mesh/placement/closed_skin.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <map>

#include "mesh/body/section_centres.hpp"
#include "mesh/body/sections.hpp"

namespace snug::mesh {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int heights = 160;          // at which a skin is looked at
constexpr double statures_per_depth = 6.5;
constexpr double beside_largest = 0.3;  // of the largest girth: below that a loop is no limb

struct Extent {
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest();
};

Extent heights_of(const TriangleSurface& skin) {
  Extent extent;
  for (const Vector3d& x : skin.vertices) extent.low = std::min(extent.low, x.z()), extent.high = std::max(extent.high, x.z());
  return extent;
}

/// Whether a point is within a loop.
bool encloses(const SectionLoop& loop, const Vector2d& p) {
  bool in = false;
  for (std::size_t n = 0; n < loop.points.size(); ++n) {
    const Vector2d &a = loop.points[n], &b = loop.points[(n + 1) % loop.points.size()];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) in = !in;
  }
  return in;
}

/// The loops of a section that are limbs, the largest first: none within another, and none that is small against the largest.
std::vector<SectionLoop> limbs_at(const TriangleSurface& skin, double z) {
  std::vector<SectionLoop> loops = slice(skin, z), limbs;
  std::sort(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.girth > b.girth; });
  for (SectionLoop& loop : loops) {
    if (!limbs.empty() && loop.girth < beside_largest * limbs.front().girth) break;
    if (std::none_of(limbs.begin(), limbs.end(), [&](const auto& limb) { return encloses(limb, loop.points.front()); }))
      limbs.push_back(std::move(loop));
  }
  return limbs;
}

/// Closes the surface with a fan of triangles over each border.
void add_lids(TriangleSurface& surface, const std::vector<std::vector<int>>& borders) {
  for (const auto& border : borders) {
    Vector3d middle = Vector3d::Zero();
    for (const int vertex : border) middle += surface.vertices[vertex] / static_cast<double>(border.size());
    const int centre = static_cast<int>(surface.vertices.size());
    surface.vertices.push_back(middle);
    for (std::size_t n = 0; n < border.size(); ++n) surface.triangles.push_back({border[(n + 1) % border.size()], border[n], centre});
  }
}

/// The middle plane goes between two legs, or through what there is.
Vector2d middle_of(const TriangleSurface& skin, const Extent& extent) {
  constexpr double just_above = 0.05;  // of the height: above feet or a cut that slants
  const std::vector<SectionLoop> limbs = limbs_at(skin, extent.low + just_above * (extent.high - extent.low));
  if (limbs.empty()) return Vector2d::Zero();
  if (limbs.size() < 2 || limbs[1].girth < 0.6 * limbs[0].girth) return limbs[0].centroid;
  return 0.5 * (limbs[0].centroid + limbs[1].centroid);
}

/// m, largest extent from back to front of a section that goes through the middle plane; of all where none does.
double depth_of(const TriangleSurface& skin, const Extent& extent, double middle) {
  double depth = 0.0, of_all = 0.0;
  for (int n = 0; n < heights; ++n)
    for (const SectionLoop& loop : limbs_at(skin, extent.low + (extent.high - extent.low) * (n + 0.5) / heights)) {
      Eigen::AlignedBox2d box;
      for (const Vector2d& p : loop.points) box.extend(p);
      of_all = std::max(of_all, box.sizes().y());
      if (box.min().x() < middle && box.max().x() > middle) depth = std::max(depth, box.sizes().y());
    }
  return depth > 0.0 ? depth : of_all;
}

}  // namespace

std::vector<std::vector<int>> skin_borders(const TriangleSurface& skin) {
  std::map<std::array<int, 2>, int> uses;
  for (const auto& t : skin.triangles)
    for (int n = 0; n < 3; ++n) ++uses[{t[n], t[(n + 1) % 3]}];
  std::map<int, int> next;  // of a vertex on a border
  for (const auto& [ends, count] : uses)
    if (!uses.contains({ends[1], ends[0]})) next[ends[0]] = ends[1];
  std::vector<std::vector<int>> borders;
  while (!next.empty()) {
    std::vector<int> way;
    for (auto at = next.begin(); at != next.end();) {
      const int to = at->second;
      way.push_back(at->first);
      next.erase(at);
      at = next.find(to);
    }
    if (way.size() > 2) borders.push_back(std::move(way));
  }
  return borders;
}

bool branches(const BodyMesh& body) {
  const TriangleSurface skin = triangulated(body);
  if (skin_borders(skin).size() > 2) return true;
  const Extent extent = heights_of(skin);
  return !one_loop_between(body, extent.low, extent.high);
}

bool one_loop_between(const BodyMesh& body, double lower, double upper) {
  const TriangleSurface skin = triangulated(body);
  const Extent extent = heights_of(skin);
  const double low = std::max(lower, extent.low), high = std::min(upper, extent.high);
  for (int n = 0; n < heights; ++n)
    if (limbs_at(skin, low + (high - low) * (n + 0.5) / heights).size() > 1) return false;
  return true;
}

BodySurface body_of_skin(const BodyMesh& body, const input::Location& where) {
  BodySurface result;
  TriangleSurface& surface = result.surface = triangulated(body);
  const Extent extent = heights_of(surface);
  const Vector2d middle = middle_of(surface, extent);
  result.stature = extent.high - extent.low;
  result.scale = std::max(result.stature, statures_per_depth * depth_of(surface, extent, middle.x()));
  result.skin_triangles = surface.triangles.size();
  add_lids(surface, skin_borders(surface));
  check_encloses(surface, where);
  result.where = where;
  result.translation = -Vector3d(middle.x(), middle.y(), extent.low);
  for (Vector3d& vertex : surface.vertices) vertex += result.translation;
  return result;
}

}  // namespace snug::mesh
