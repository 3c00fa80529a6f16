#include "postproc/report/limbs.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <map>

#include "solver/fem/union_find.hpp"

namespace snug::postproc::report {

namespace {

using Eigen::Vector3d;

constexpr int slices = 24;
constexpr double least_share = 0.2;  // of a slice's area that the smaller limb has; rims and specks have less

struct Piece {
  double area = 0.0;
  Vector3d moment = Vector3d::Zero();
};

}  // namespace

std::vector<int> limbs_of(const std::vector<Vector3d>& nodes, const std::vector<Triangle>& triangles) {
  std::vector<int> limb(nodes.size(), 0);
  const auto [low, high] = std::minmax_element(nodes.begin(), nodes.end(), [](const auto& a, const auto& b) { return a.z() < b.z(); });
  if (nodes.empty() || !(high->z() > low->z())) return limb;
  const double bottom = low->z(), thickness = (high->z() - bottom) / slices;
  std::vector<std::vector<int>> of_slice(slices);  // triangles that reach into it
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto [a, b] = std::minmax({nodes[triangles[t][0]].z(), nodes[triangles[t][1]].z(), nodes[triangles[t][2]].z()});
    const int last = std::min(slices - 1, static_cast<int>((b - bottom) / thickness));
    for (int s = static_cast<int>((a - bottom) / thickness); s <= last; ++s) of_slice[s].push_back(static_cast<int>(t));
  }
  for (int s = 0; s < slices; ++s) {
    fem::UnionFind pieces(nodes.size());
    for (const int t : of_slice[s]) pieces.merge(triangles[t][0], triangles[t][1]), pieces.merge(triangles[t][1], triangles[t][2]);
    std::map<int, Piece> found;
    double all = 0.0;
    for (const int t : of_slice[s]) {
      const Vector3d &a = nodes[triangles[t][0]], &b = nodes[triangles[t][1]], &c = nodes[triangles[t][2]];
      const double area = 0.5 * (b - a).cross(c - a).norm();
      Piece& piece = found[pieces.find(triangles[t][0])];
      piece.area += area, piece.moment += area * (a + b + c) / 3.0, all += area;
    }
    std::erase_if(found, [&](const auto& one) { return one.second.area < least_share * all; });
    if (found.size() != 2) continue;
    const auto &one = *found.begin(), &other = *std::next(found.begin());
    const bool first_is_right = one.second.moment.x() / one.second.area > other.second.moment.x() / other.second.area;
    for (const int t : of_slice[s])
      for (const int n : triangles[t]) {
        if (static_cast<int>((nodes[n].z() - bottom) / thickness) != s) continue;
        const int root = pieces.find(n);
        if (root == one.first) limb[n] = first_is_right ? 1 : 2;
        if (root == other.first) limb[n] = first_is_right ? 2 : 1;
      }
  }
  return limb;
}

}  // namespace snug::postproc::report
