#include "mesh/body/section_centres.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "mesh/body/sections.hpp"

namespace snug::mesh {

namespace {

constexpr int samples = 65;
// A section exactly through the nodes of a cut end may be open: the first and the last are this share of the height inside.
constexpr double inside = 1e-6;

}  // namespace

std::vector<std::array<int, 3>> triangulated_nodes(const BodyMesh& body) {
  using Triangles = std::vector<std::array<int, 3>>;
  static const Triangles quad4 = {{0, 1, 3}, {0, 3, 2}}, tri6 = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
                         quad9 = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 5, 8}, {4, 8, 7}};
  const FacetKind kind = facet_kind(body.kind);
  Triangles triangles;
  for (const auto& facet : body.skin_facets)
    for (const auto& [a, b, c] : kind == FacetKind::quad4 ? quad4 : kind == FacetKind::tri6 ? tri6 : quad9)
      triangles.push_back({facet[a], facet[b], facet[c]});
  return triangles;
}

TriangleSurface triangulated(const BodyMesh& body) { return weld({body.nodes, triangulated_nodes(body)}); }

SectionCentres::SectionCentres(const BodyMesh& body) {
  const TriangleSurface skin = triangulated(body);
  double low = std::numeric_limits<double>::max(), high = -low;
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Eigen::Vector3d& x : skin.vertices) {
    low = std::min(low, x.z()), high = std::max(high, x.z());
    mean += x.head<2>() / static_cast<double>(skin.vertices.size());
  }
  for (int i = 0; i < samples; ++i) {
    const double share = std::clamp(i / (samples - 1.0), inside, 1.0 - inside), z = low + share * (high - low);
    const std::vector<SectionLoop> loops = slice(skin, z);
    const auto largest = std::max_element(loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.area < b.area; });
    if (largest != loops.end()) height_.push_back(z), centre_.push_back(largest->centroid);
  }
  if (height_.empty()) height_ = {low}, centre_ = {mean};
}

SectionCentres::SectionCentres(const BodyMesh& body, const Eigen::Vector3d& in_limb) {
  const TriangleSurface skin = triangulated(body);
  double low = std::numeric_limits<double>::max(), high = -low;
  for (const Eigen::Vector3d& x : skin.vertices) low = std::min(low, x.z()), high = std::max(high, x.z());
  const double step = (high - low) / (samples - 1.0), hair = inside * (high - low);
  const auto follow = [&](double z, double by, Eigen::Vector2d near, double girth, auto add) {
    for (; z > low - 0.5 * std::abs(by) && z < high + 0.5 * std::abs(by); z += by) {
      const double at = std::clamp(z, low + hair, high - hair);
      const std::vector<SectionLoop> loops = slice(skin, at);
      const auto next = std::min_element(loops.begin(), loops.end(), [&](const auto& a, const auto& b) { return (a.centroid - near).norm() < (b.centroid - near).norm(); });
      if (next == loops.end()) return;
      const double radius = next->girth / (2.0 * std::numbers::pi);
      if (girth > 0.0 && ((next->centroid - near).norm() > radius || std::abs(next->girth - girth) > girth / 3.0)) return;
      double reach = 0.0;
      for (const auto& p : next->points) reach = std::max(reach, (p - next->centroid).norm());
      add(at, next->centroid, reach);
      near = next->centroid, girth = next->girth;
    }
  };
  const auto push = [&](double z, const Eigen::Vector2d& centre, double reach) { height_.push_back(z), centre_.push_back(centre), reach_.push_back(reach); };
  follow(in_limb.z(), -step, in_limb.head<2>(), 0.0, push);
  std::reverse(height_.begin(), height_.end()), std::reverse(centre_.begin(), centre_.end()), std::reverse(reach_.begin(), reach_.end());
  if (!height_.empty()) {
    const Eigen::Vector2d from = centre_.back();
    const double girth = 2.0 * std::numbers::pi * reach_.back();
    follow(in_limb.z() + step, step, from, girth, push);
  }
  if (height_.empty()) height_ = {in_limb.z()}, centre_ = {in_limb.head<2>()}, reach_ = {0.0};
}

bool SectionCentres::holds(const Eigen::Vector3d& x) const {
  if (reach_.empty()) return true;
  const double step = height_.size() > 1 ? height_[1] - height_[0] : 0.0;
  if (x.z() < height_.front() - step || x.z() > height_.back() + step) return false;
  const auto above = std::lower_bound(height_.begin(), height_.end(), x.z());
  const auto i = std::min<std::size_t>(above - height_.begin(), height_.size() - 1);
  return (x.head<2>() - at(x.z())).norm() <= 1.1 * std::max(reach_[i], reach_[i > 0 ? i - 1 : 0]);
}

Eigen::Vector2d SectionCentres::at(double z) const {
  const auto above = std::lower_bound(height_.begin(), height_.end(), z);
  if (above == height_.begin()) return centre_.front();
  if (above == height_.end()) return centre_.back();
  const auto i = above - height_.begin();
  const double share = (z - height_[i - 1]) / (height_[i] - height_[i - 1]);
  return (1.0 - share) * centre_[i - 1] + share * centre_[i];
}

}  // namespace snug::mesh
