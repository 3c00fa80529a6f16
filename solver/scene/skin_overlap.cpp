#include "solver/scene/skin_overlap.hpp"

#include <Eigen/Geometry>

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace snug::solver {

namespace {

constexpr double opposing = -0.3;       // cosine of two normals
constexpr double far_at_rest = 2.5;     // cells: nearer ones are neighbours
constexpr double reach = 1.0;           // cells

struct Patch {
  Eigen::Vector3d rest, now, normal;
};

/// The corners of a facet by their slots (quad9, quad4, tri6).
std::array<int, 4> corners(int nodes) {
  if (nodes == 9) return {0, 2, 8, 6};
  return nodes == 4 ? std::array{0, 1, 3, 2} : std::array{0, 1, 2, 2};
}

std::vector<Patch> patches(const postproc::BodyResult& body) {
  const std::vector<Eigen::Vector3d>& displacement = body.fields[postproc::field::displacement];
  const auto slots = corners(body.facet_nodes);
  const int used = body.facet_nodes == 6 ? 3 : 4;
  std::vector<Patch> list;
  for (const auto& facet : body.skin_facets) {
    Patch patch{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()};
    std::array<Eigen::Vector3d, 4> x;
    for (int k = 0; k < used; ++k) {
      const int node = facet[slots[k]];
      x[k] = body.nodes[node] + displacement[node];
      patch.rest += body.nodes[node] / used, patch.now += x[k] / used;
    }
    patch.normal = used == 3 ? (x[1] - x[0]).cross(x[2] - x[0]).normalized() : (x[2] - x[0]).cross(x[3] - x[1]).normalized();
    list.push_back(patch);
  }
  return list;
}

}  // namespace

int skin_overlap(const postproc::BodyResult& body, double cell) {
  int overlapping = 0;
  if (!(cell > 0.0) || !body.fields.has(postproc::field::displacement)) return overlapping;
  const std::vector<Patch> skin = patches(body);
  std::map<std::array<long, 3>, std::vector<int>> bins;
  const auto bin = [&](const Eigen::Vector3d& x) { return std::array<long, 3>{std::lround(std::floor(x.x() / cell)), std::lround(std::floor(x.y() / cell)), std::lround(std::floor(x.z() / cell))}; };
  for (std::size_t n = 0; n < skin.size(); ++n) bins[bin(skin[n].now)].push_back(static_cast<int>(n));
  const auto behind = [&](const Patch& a, const Patch& b) {
    const Eigen::Vector3d way = b.now - a.now;
    return way.norm() < reach * cell && (b.rest - a.rest).norm() > far_at_rest * cell && a.normal.dot(b.normal) < opposing && way.dot(a.normal) < 0.0 && way.dot(b.normal) > 0.0;
  };
  for (const Patch& patch : skin) {
    const auto [i, j, k] = bin(patch.now);
    bool found = false;
    for (int n = 0; n < 27 && !found; ++n)
      if (const auto there = bins.find({i + n % 3 - 1, j + n / 3 % 3 - 1, k + n / 9 - 1}); there != bins.end())
        for (const int other : there->second) found = found || behind(patch, skin[other]);
    overlapping += found;
  }
  return overlapping;
}

}  // namespace snug::solver
