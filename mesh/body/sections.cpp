#include "mesh/body/sections.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "mesh/surface/vectors.hpp"

namespace snug::mesh {

namespace {

using Edge = std::pair<int, int>;

/// The cut edges of the surface: where each is cut and which cut edges its triangles lead to.
struct SectionCut {
  std::map<Edge, Eigen::Vector2d> point;
  std::map<Edge, std::vector<Edge>> next;
};

SectionCut cut_triangles(const std::vector<Eigen::Vector3d>& vertices, std::span<const std::array<int, 3>> triangles, double z) {
  SectionCut cut;
  for (const auto& t : triangles) {
    std::vector<Edge> crossed;
    for (int n = 0; n < 3; ++n) {
      // Always from the smaller number, so that both triangles of an edge get the same point to the last bit.
      const int a = std::min(t[n], t[(n + 1) % 3]), b = std::max(t[n], t[(n + 1) % 3]);
      const Eigen::Vector3d &p = vertices[a], &q = vertices[b];
      if ((p.z() > z) == (q.z() > z)) continue;
      crossed.emplace_back(a, b);
      cut.point.try_emplace({a, b}, (p + (z - p.z()) / (q.z() - p.z()) * (q - p)).head<2>());
    }
    if (crossed.size() != 2) continue;
    cut.next[crossed[0]].push_back(crossed[1]);
    cut.next[crossed[1]].push_back(crossed[0]);
  }
  return cut;
}

SectionLoop finished(std::vector<Eigen::Vector2d> points) {
  SectionLoop loop;
  const Eigen::Vector2d origin = points[0];
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Eigen::Vector2d a = points[n] - origin, b = points[(n + 1) % points.size()] - origin;
    loop.area += cross(a, b) / 2.0;
    loop.centroid += cross(a, b) * (a + b) / 6.0;
    loop.girth += (b - a).norm();
  }
  loop.centroid = loop.area != 0.0 ? Eigen::Vector2d(origin + loop.centroid / loop.area) : origin;
  if (loop.area < 0.0) std::reverse(points.begin(), points.end());
  loop.area = std::abs(loop.area);
  loop.points = std::move(points);
  return loop;
}

}  // namespace

std::vector<SectionLoop> slice(const TriangleSurface& surface, double z) {
  return slice(surface.vertices, surface.triangles, z);
}

std::vector<SectionLoop> slice(const std::vector<Eigen::Vector3d>& vertices,
                               std::span<const std::array<int, 3>> triangles, double z) {
  SectionCut cut = cut_triangles(vertices, triangles, z);
  std::vector<SectionLoop> loops;
  while (!cut.point.empty()) {
    std::vector<Eigen::Vector2d> points;
    const Edge first = cut.point.begin()->first;
    Edge last = first;
    for (auto at = cut.point.begin(); at != cut.point.end();) {
      points.push_back(at->second);
      last = at->first;
      cut.point.erase(at);
      at = cut.point.end();
      for (const Edge& edge : cut.next[last])
        if (at == cut.point.end()) at = cut.point.find(edge);
    }
    const auto& ways = cut.next[last];
    const bool closed = points.size() > 2 && std::find(ways.begin(), ways.end(), first) != ways.end();
    if (closed) loops.push_back(finished(std::move(points)));
  }
  return loops;
}

namespace {
constexpr double round_off = 1e-9;  // of the angle between two rays
}

Eigen::VectorXd ray_radii(const SectionLoop& loop, const Eigen::Vector2d& from, int count) {
  const double step = 2.0 * std::numbers::pi / count;
  Eigen::VectorXd radii = Eigen::VectorXd::Constant(count, -1.0);
  for (std::size_t n = 0; n < loop.points.size(); ++n) {
    const Eigen::Vector2d a = loop.points[n] - from, b = loop.points[(n + 1) % loop.points.size()] - from;
    // The rays between the directions of a and b, whichever way the edge runs; one through a corner belongs to both of its edges, and by
    // round-off alone to neither.
    const double begin = std::atan2(a.y(), a.x()), sweep = std::atan2(cross(a, b), a.dot(b));
    const int first = static_cast<int>(std::ceil((begin + std::min(sweep, 0.0)) / step - round_off));
    const int last = static_cast<int>(std::floor((begin + std::max(sweep, 0.0)) / step + round_off));
    for (int ray = first; ray <= last; ++ray) {
      const Eigen::Vector2d direction(std::cos(ray * step), std::sin(ray * step));
      const double side_a = cross(direction, a), side_b = cross(direction, b);
      const double t = side_a != side_b ? std::clamp(side_a / (side_a - side_b), 0.0, 1.0) : 0.0;
      double& radius = radii[(ray % count + count) % count];
      radius = std::max(radius, direction.dot(a + t * (b - a)));
    }
  }
  return radii;
}

}  // namespace snug::mesh
