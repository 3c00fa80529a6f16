#include "solver/terms/facet_cut.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace snug::solver {

namespace {

using Polygon = std::vector<Eigen::Vector3d>;  // corners in area coordinates

constexpr double negligible = 1e-12;  // fraction of the triangle's area
constexpr double complete = 1e-6;     // what the parts' areas may miss of the triangle's

// The place in the triangle's (extended) parameter plane that stands over y along n: Newton's method on the two
// tangential components of x(L) - y.
std::optional<Eigen::Vector3d> over(const TriangleNodes& triangle, int order, const Eigen::Vector3d& y,
                                    const Eigen::Vector3d& n) {
  Eigen::Matrix<double, 2, 3> tangential;
  tangential.row(0) = n.unitOrthogonal();
  tangential.row(1) = n.cross(Eigen::Vector3d(tangential.row(0)));
  Eigen::Vector3d L = Eigen::Vector3d::Constant(1.0 / 3.0);
  for (int iteration = 0; iteration < 20; ++iteration) {
    const Eigen::Vector2d r = tangential * (triangle * garment_values(order, L) - y);
    const Eigen::Matrix2d A = tangential * (triangle * garment_slopes(order, L));
    if (!(A.determinant() > 0.0)) return {};  // the triangle is folded or turned over there
    const Eigen::Vector2d step = -A.inverse() * r;
    const double longest = step.cwiseAbs().maxCoeff(), factor = longest > 2.0 ? 2.0 / longest : 1.0;
    L += factor * Eigen::Vector3d(-step.sum(), step[0], step[1]);
    if (L.cwiseAbs().maxCoeff() > 20.0) return {};
    if (longest < 1e-12) return L;
  }
  return {};
}

// Twice the area in units of the triangle's, positive counter-clockwise.
double signed_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]);
}

double area(const Polygon& polygon) {
  double sum = 0.0;
  for (std::size_t k = 2; k < polygon.size(); ++k) sum += signed_area(polygon[0], polygon[k - 1], polygon[k]);
  return sum;
}

Polygon clip(Polygon polygon) {
  for (int side = 0; side < 3 && !polygon.empty(); ++side) {
    Polygon kept;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Eigen::Vector3d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      if (a[side] >= 0.0) kept.push_back(a);
      if ((a[side] >= 0.0) != (b[side] >= 0.0)) {
        Eigen::Vector3d on = a + a[side] / (a[side] - b[side]) * (b - a);
        on[side] = 0.0;
        kept.push_back(on);
      }
    }
    polygon = std::move(kept);
  }
  return polygon;
}

ContactPoint point_at(const Eigen::Vector3d& L, double weight, int order, int facet,
                      const Eigen::Vector2d& xi = Eigen::Vector2d::Zero()) {
  return {L, weight, garment_values(order, L), {facet, xi}};
}

// Where a facet's corner lies on an edge of the triangle, round-off decides whether clipping keeps it, and so which corner
// comes first. The fan starts at the corner that is farthest along a direction with which no edge is likely to be square,
// so that the points do not depend on it.
void start_anywhere_but_by_chance(Polygon& polygon) {
  const Eigen::Vector3d direction(1.0, 0.6180339887, 0.2360679775);
  const auto first = std::max_element(polygon.begin(), polygon.end(), [&](const auto& a, const auto& b) {
    return a.dot(direction) < b.dot(direction);
  });
  std::rotate(polygon.begin(), first, polygon.end());
}

void add_fan(Polygon polygon, int order, const Site& start, std::vector<ContactPoint>& points) {
  start_anywhere_but_by_chance(polygon);
  for (std::size_t k = 2; k < polygon.size(); ++k) {
    const double part = signed_area(polygon[0], polygon[k - 1], polygon[k]);
    if (std::abs(part) < negligible) continue;
    for (const TrianglePoint& q : triangle_rule())
      points.push_back(point_at(q.L[0] * polygon[0] + q.L[1] * polygon[k - 1] + q.L[2] * polygon[k], part * q.weight,
                                order, start.facet, start.xi));
  }
}

}  // namespace

MasterNodes master_nodes(const MasterSurface& skin, const State& state) {
  const int count = skin.nodes();
  MasterNodes nodes;
  nodes.position.assign(count, Eigen::Vector3d::Zero());
  nodes.normal.assign(count, Eigen::Vector3d::Zero());
  for (int f = 0; f < skin.facets(); ++f) {
    const FacetNodes x = skin.positions(state, f);
    for (int a = 0; a < node_count(skin.kind()); ++a) {
      const FacetPoint at = facet_point(x, facet_shape(skin.kind(), skin.domain().nodes[a]));
      nodes.position[skin.nodes_of(f)[a]] = at.y;
      nodes.normal[skin.nodes_of(f)[a]] += at.n;
    }
  }
  for (auto& n : nodes.normal)
    if (n.squaredNorm() > 0.0) n.normalize();
  return nodes;
}

std::vector<ContactPoint> cut_by_facets(const MasterSurface& skin, const MasterNodes& nodes, const TriangleNodes& triangle,
                                        int order, int start_facet) {
  std::map<int, std::optional<Eigen::Vector3d>> images;  // of skin nodes
  const auto image = [&](int node) -> const std::optional<Eigen::Vector3d>& {
    const auto [it, fresh] = images.try_emplace(node);
    if (fresh) it->second = over(triangle, order, nodes.position[node], nodes.normal[node]);
    return it->second;
  };
  std::vector<ContactPoint> points;
  std::vector<int> queue = {start_facet};
  double covered = 0.0;
  bool border = false;
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const int facet = queue[next];
    Polygon polygon;
    for (const int a : skin.domain().outline) {
      const auto& L = image(skin.nodes_of(facet)[a]);
      if (!L) break;
      polygon.push_back(*L);
    }
    if (polygon.size() < skin.domain().outline.size()) {  // a node of the facet is out of sight of this triangle
      if (next == 0) return {};
      continue;
    }
    polygon = clip(std::move(polygon));
    const double part = polygon.size() < 3 ? 0.0 : area(polygon);
    if (part < -negligible) return {};
    if (part < negligible && next > 0) continue;
    covered += part;
    if (!polygon.empty()) add_fan(polygon, order, {facet, skin.domain().centre}, points);
    for (const int neighbour : skin.neighbours(facet)) {
      if (neighbour < 0) border = true;
      else if (std::find(queue.begin(), queue.end(), neighbour) == queue.end()) queue.push_back(neighbour);
    }
  }
  if (covered > 1.0 + complete || (covered < 1.0 - complete && !border)) return {};
  return points;
}

std::vector<ContactPoint> uncut_rule(int n, int order) {
  std::vector<ContactPoint> points;
  for (const TrianglePoint& q : composite_rule(n)) points.push_back(point_at(q.L, q.weight, order, -1));
  return points;
}

}  // namespace snug::solver
