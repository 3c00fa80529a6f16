#include "mesh/placement/triangle_bins.hpp"

#include <cmath>

namespace snug::mesh {

using Eigen::AlignedBox3d;
using Eigen::Vector3d;
using Eigen::Vector3i;

AlignedBox3d box_of(const Triangle3& triangle) {
  AlignedBox3d box(triangle[0]);
  return box.extend(triangle[1]).extend(triangle[2]);
}

TriangleBins::TriangleBins(const std::vector<Vector3d>& vertices, const std::vector<std::array<int, 3>>& triangles,
                           double size)
    : size_(size) {
  AlignedBox3d box;
  for (const auto& t : triangles)
    for (const int vertex : t) box.extend(vertices[vertex]);
  if (!box.isEmpty()) {
    origin_ = box.min();
    size_ = std::max(size, std::cbrt(box.sizes().prod() / 1e7));
    for (int a = 0; a < 3; ++a) count_[a] = static_cast<int>(std::min(box.sizes()[a] / size_, 1e6)) + 1;
  }
  first_.assign(number(0, 0, count_.z()) + 1, 0);
  const auto each = [&](const auto& visit) {  // of bin and triangle
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const AlignedBox3d reach =
          box_of({vertices[triangles[t][0]], vertices[triangles[t][1]], vertices[triangles[t][2]]});
      const Vector3i low = bin_of(reach.min()), high = bin_of(reach.max());
      for (int k = low.z(); k <= high.z(); ++k)
        for (int j = low.y(); j <= high.y(); ++j)
          for (int i = low.x(); i <= high.x(); ++i) visit(number(i, j, k), static_cast<int>(t));
    }
  };
  each([&](std::size_t bin, int) { ++first_[bin + 1]; });
  for (std::size_t bin = 1; bin < first_.size(); ++bin) first_[bin] += first_[bin - 1];
  triangles_.resize(first_.back());
  std::vector<int> next(first_.begin(), first_.end() - 1);
  each([&](std::size_t bin, int triangle) { triangles_[next[bin]++] = triangle; });
}

}  // namespace snug::mesh
