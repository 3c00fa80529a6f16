#include "mesh/surface/cutting.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace snug::mesh {

namespace {

using Edge = std::pair<int, int>;
Edge edge_of(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

constexpr double hair = 1e-7;  // m

/// Where a plane crosses the edges of a surface. A vertex within a hair of the plane counts as on its outer side.
class Crossing {
 public:
  Crossing(const TriangleSurface& surface, const Cut& cut) : surface_(surface), side_(surface.vertices.size(), 0.0) {
    for (std::size_t v = 0; v < side_.size(); ++v) side_[v] = cut.normal.dot(surface.vertices[v] - cut.point);
    for (std::size_t t = 0; t < surface.triangles.size(); ++t) enter(static_cast<int>(t));
  }
  bool outer(int vertex) const { return side_[vertex] >= -hair; }
  /// Of a triangle that lies on one side; vertices that were put on the plane since do not count.
  bool outer(const std::array<int, 3>& triangle) const {
    return std::any_of(triangle.begin(), triangle.end(), [&](int v) { return v < static_cast<int>(side_.size()) && outer(v); });
  }

  Eigen::Vector3d point(const Edge& edge) const {
    const double a = side_[edge.first], b = side_[edge.second], s = std::clamp(a / (a - b), 1e-7, 1.0 - 1e-7);
    return (1.0 - s) * surface_.vertices[edge.first] + s * surface_.vertices[edge.second];
  }

  /// Closed chains of crossed triangles, each with the edge it is entered through. Chains that end at a rim are left out.
  struct Chain {
    std::vector<int> triangles;
    std::vector<Edge> edges;
  };
  std::vector<Chain> chains() const {
    std::vector<Chain> all;
    std::set<int> done;
    for (const auto& [triangle, way] : way_) {
      if (done.count(triangle)) continue;
      Chain chain;
      int at = triangle;
      while (done.insert(at).second) {
        chain.triangles.push_back(at), chain.edges.push_back(way_.at(at).first);
        const auto next = entered_.find(way_.at(at).second);
        if (next == entered_.end()) {
          at = -1;
          break;
        }
        at = next->second;
      }
      if (at == triangle) all.push_back(std::move(chain));
    }
    return all;
  }

 private:
  /// A triangle is entered through the edge that goes from the outer to the inner side and left through the other one.
  void enter(int t) {
    const auto& v = surface_.triangles[t];
    Edge in{-1, -1}, out{-1, -1};
    for (int n = 0; n < 3; ++n) {
      const int a = v[n], b = v[(n + 1) % 3];
      if (outer(a) == outer(b)) continue;
      (outer(a) ? in : out) = edge_of(a, b);
    }
    if (in.first < 0) return;
    way_[t] = {in, out};
    entered_[in] = t;
  }

  const TriangleSurface& surface_;
  std::vector<double> side_;
  std::map<int, std::pair<Edge, Edge>> way_;
  std::map<Edge, int> entered_;
};

/// Parts the triangles of a chain along the plane; returns the rim.
Rim split(TriangleSurface& surface, const Crossing& crossing, const Crossing::Chain& chain) {
  std::map<Edge, int> at;
  Rim rim;
  for (const Edge& edge : chain.edges) {
    at[edge] = static_cast<int>(surface.vertices.size());
    rim.push_back(at[edge]);
    surface.vertices.push_back(crossing.point(edge));
  }
  for (const int t : chain.triangles) {
    auto v = surface.triangles[t];
    while (crossing.outer(v[0]) == crossing.outer(v[1]) || crossing.outer(v[0]) == crossing.outer(v[2])) std::rotate(v.begin(), v.begin() + 1, v.end());
    const int p = at.at(edge_of(v[0], v[1])), q = at.at(edge_of(v[2], v[0]));  // v[0] is alone on its side
    surface.triangles[t] = {v[0], p, q};
    surface.triangles.push_back({p, v[1], v[2]});
    surface.triangles.push_back({p, v[2], q});
  }
  return rim;
}

/// Triangles that hang together with those on the outer side of the rims, not across a rim.
std::vector<char> beyond(const TriangleSurface& surface, const Crossing& crossing, const std::vector<Rim>& rims, const Cut& cut) {
  std::set<Edge> walls;
  for (const Rim& rim : rims)
    for (std::size_t n = 0; n < rim.size(); ++n) walls.insert(edge_of(rim[n], rim[(n + 1) % rim.size()]));
  std::map<Edge, std::vector<int>> at;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    for (int n = 0; n < 3; ++n) at[edge_of(surface.triangles[t][n], surface.triangles[t][(n + 1) % 3])].push_back(static_cast<int>(t));
  const auto is_outer = [&](int t) { return crossing.outer(surface.triangles[t]); };
  std::vector<char> reached(surface.triangles.size(), 0);
  std::vector<int> todo;
  const auto reach = [&](int t) {
    if (!reached[t]) reached[t] = 1, todo.push_back(t);
  };
  for (const Edge& wall : walls)
    for (const int t : at[wall])
      if (is_outer(t)) reach(t);
  while (!todo.empty()) {
    const auto& v = surface.triangles[todo.back()];
    todo.pop_back();
    for (int n = 0; n < 3; ++n) {
      const Edge edge = edge_of(v[n], v[(n + 1) % 3]);
      if (!walls.count(edge))
        for (const int t : at[edge]) reach(t);
    }
  }
  for (const Edge& wall : walls)
    for (const int t : at[wall])
      if (!is_outer(t) && reached[t])
        throw input::InputError(cut.where, fmt::format("the cut \"{}\" does not part the body: what lies beyond it hangs on elsewhere, too", cut.name),
                                "add the other cuts that part it first, or move this one to where the limb stands alone");
  return reached;
}

}  // namespace

double distance_to_polygon(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& polygon) {
  double nearest = std::numeric_limits<double>::max();
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Eigen::Vector2d &a = polygon[n], along = polygon[(n + 1) % polygon.size()] - a;
    const double s = std::clamp(along.dot(p - a) / std::max(along.squaredNorm(), 1e-300), 0.0, 1.0);
    nearest = std::min(nearest, (a + s * along - p).norm());
  }
  return nearest;
}

PlaneFrame::PlaneFrame(const Cut& cut) : origin(cut.point) {
  int least = 0;
  cut.normal.cwiseAbs().minCoeff(&least);
  u = cut.normal.cross(Eigen::Vector3d::Unit(least)).normalized();
  v = cut.normal.cross(u);
}
Eigen::Vector2d PlaneFrame::flat(const Eigen::Vector3d& x) const { return {u.dot(x - origin), v.dot(x - origin)}; }
Eigen::Vector3d PlaneFrame::lifted(const Eigen::Vector2d& p) const { return origin + p.x() * u + p.y() * v; }

double polygon_area(const std::vector<Eigen::Vector2d>& polygon) {
  double twice = 0.0;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const Eigen::Vector2d &a = polygon[n], &b = polygon[(n + 1) % polygon.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

bool inside_polygon(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& polygon) {
  bool inside = false;
  for (std::size_t n = 0, last = polygon.size() - 1; n < polygon.size(); last = n++) {
    const Eigen::Vector2d &a = polygon[n], &b = polygon[last];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) inside = !inside;
  }
  return inside;
}

std::vector<std::size_t> section_at_origin(const std::vector<std::vector<Eigen::Vector2d>>& sections) {
  std::size_t best = sections.size();
  double least = std::numeric_limits<double>::max();
  for (std::size_t n = 0; n < sections.size(); ++n) {
    const bool holds = inside_polygon(Eigen::Vector2d::Zero(), sections[n]);
    const double rank = holds ? -1.0 / std::max(std::abs(polygon_area(sections[n])), 1e-12) : distance_to_polygon(Eigen::Vector2d::Zero(), sections[n]);
    if (rank < least) least = rank, best = n;
  }
  return best < sections.size() ? std::vector<std::size_t>{best} : std::vector<std::size_t>{};
}

std::vector<Rim> cut_off(TriangleSurface& surface, const Cut& cut, const SectionChoice& choose) {
  const Crossing crossing(surface, cut);
  const auto chains = crossing.chains();
  const PlaneFrame frame(cut);
  std::vector<std::vector<Eigen::Vector2d>> sections;
  for (const auto& chain : chains) {
    auto& section = sections.emplace_back();
    for (const Edge& edge : chain.edges) section.push_back(frame.flat(crossing.point(edge)));
  }
  std::vector<Rim> rims;
  for (const std::size_t n : choose(sections)) rims.push_back(split(surface, crossing, chains[n]));
  if (rims.empty()) return rims;
  const std::vector<char> gone = beyond(surface, crossing, rims, cut);
  std::vector<std::array<int, 3>> kept;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t)
    if (!gone[t]) kept.push_back(surface.triangles[t]);
  surface.triangles = std::move(kept);
  return rims;
}

std::vector<Rim> border_loops(const TriangleSurface& surface) {
  std::set<std::pair<int, int>> ways;
  for (const auto& t : surface.triangles)
    for (int n = 0; n < 3; ++n) ways.emplace(t[n], t[(n + 1) % 3]);
  std::map<int, int> next;
  for (const auto& [a, b] : ways)
    if (!ways.count({b, a})) next[a] = b;
  std::vector<Rim> loops;
  while (!next.empty()) {
    Rim loop;
    const int first = next.begin()->first;
    int at = first;
    for (auto step = next.find(at); step != next.end(); step = next.find(at)) {
      loop.push_back(at);
      at = step->second;
      next.erase(step);
    }
    if (at == first) loops.push_back(std::move(loop));
  }
  return loops;
}

TriangleSurface compacted(const TriangleSurface& surface) {
  TriangleSurface compact;
  std::vector<int> number(surface.vertices.size(), -1);
  for (auto t : surface.triangles) {
    for (int& v : t) {
      if (number[v] < 0) number[v] = static_cast<int>(compact.vertices.size()), compact.vertices.push_back(surface.vertices[v]);
      v = number[v];
    }
    compact.triangles.push_back(t);
  }
  return compact;
}

}  // namespace snug::mesh
