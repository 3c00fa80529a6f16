#include "solver/terms/stack_cut.hpp"

#include <algorithm>
#include <array>
#include <numeric>

namespace snug::solver {

namespace {

// Parts of an edge of a triangle that an edge of the master runs through: the point where it changes over is met to a sixth.
constexpr int straddling_parts = 6;
constexpr double complete = 1.0 - 1e-6;  // of a triangle's area that its points stand for

/// The middle of the triangle and its corners.
std::array<Eigen::Vector3d, 4> probes(const TriangleNodes& triangle, int order) {
  return {triangle * garment_values(order, Eigen::Vector3d::Constant(1.0 / 3.0)), triangle.col(0), triangle.col(1), triangle.col(2)};
}

bool whole(const std::vector<ContactPoint>& points) {
  return std::accumulate(points.begin(), points.end(), 0.0, [](double sum, const auto& point) { return sum + point.weight; }) > complete;
}

}  // namespace

std::vector<MasterNodes> master_nodes(const MasterStack& master, const State& state) {
  std::vector<MasterNodes> nodes;
  for (int s = 0; s < master.surfaces(); ++s) nodes.push_back(master_nodes(master.surface(s), state));
  return nodes;
}

std::vector<ContactPoint> cut_by_stack(const MasterStack& master, const std::vector<MasterNodes>& nodes, const State& state,
                                       const TriangleNodes& triangle, int order, int parts, const MasterStack::Trees& trees) {
  const auto at = probes(triangle, order);
  const int lowest = master.surfaces() - 1;
  int surface = lowest;
  Site site;
  if (lowest == 0) {
    site = master.find(state, at[0], trees);
  } else {
    std::array<int, 4> of{};
    for (int k = 0; k < 4; ++k) {
      const Site found = master.find(state, at[k], trees);
      of[k] = found.facet < 0 ? lowest : master.surface_of(found.facet);
      if (k == 0) site = found;
    }
    if (std::any_of(of.begin(), of.end(), [&](int s) { return s != of[0]; })) return uncut_rule(std::max(parts, straddling_parts), order);
    surface = of[0];
  }
  std::vector<ContactPoint> points;
  const int first = master.first_facet(surface);
  if (site.facet >= 0) points = cut_by_facets(master.surface(surface), nodes[surface], triangle, order, site.facet - first);
  if (points.empty() || (surface < lowest && !whole(points))) return uncut_rule(points.empty() ? parts : std::max(parts, straddling_parts), order);
  for (ContactPoint& point : points) point.site.facet += first;
  return points;
}

}  // namespace snug::solver
