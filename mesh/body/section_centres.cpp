#include "mesh/body/section_centres.hpp"

#include <algorithm>
#include <limits>

#include "mesh/body/sections.hpp"

namespace snug::mesh {

namespace {

constexpr int samples = 65;
// A section exactly through the nodes of a cut end may be open: the first and the last are this share of the height inside.
constexpr double inside = 1e-6;

}  // namespace

TriangleSurface triangulated(const BodyMesh& body) {
  using Triangles = std::vector<std::array<int, 3>>;
  static const Triangles quad4 = {{0, 1, 3}, {0, 3, 2}}, tri6 = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}, {3, 4, 5}},
                         quad9 = {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}, {3, 4, 7}, {3, 7, 6}, {4, 5, 8}, {4, 8, 7}};
  const FacetKind kind = facet_kind(body.kind);
  TriangleSurface surface{body.nodes, {}};
  for (const auto& facet : body.skin_facets)
    for (const auto& [a, b, c] : kind == FacetKind::quad4 ? quad4 : kind == FacetKind::tri6 ? tri6 : quad9)
      surface.triangles.push_back({facet[a], facet[b], facet[c]});
  return weld(surface);
}

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

Eigen::Vector2d SectionCentres::at(double z) const {
  const auto above = std::lower_bound(height_.begin(), height_.end(), z);
  if (above == height_.begin()) return centre_.front();
  if (above == height_.end()) return centre_.back();
  const auto i = above - height_.begin();
  const double share = (z - height_[i - 1]) / (height_[i] - height_[i - 1]);
  return (1.0 - share) * centre_[i - 1] + share * centre_[i];
}

}  // namespace snug::mesh
