// Triangles of a surface by where they are.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

#include "mesh/formats/triangle_surface.hpp"
#include "mesh/placement/triangle_geometry.hpp"

namespace snug::mesh {

/// Cubes of one size over the box of a surface, each with the numbers of the triangles whose boxes reach into it.
class TriangleBins {
 public:
  /// `size` (m): of a cube; takes larger ones where there would be more than some ten million.
  TriangleBins(const std::vector<Eigen::Vector3d>& vertices, const std::vector<std::array<int, 3>>& triangles,
               double size);

  /// Calls `look(triangle)` for the triangles that may reach into the box, some of them several times, until it returns
  /// true. Returns whether it did.
  template <class Look>
  bool any(const Eigen::AlignedBox3d& box, const Look& look) const {
    const Eigen::Vector3i low = bin_of(box.min()), high = bin_of(box.max());
    for (int k = low.z(); k <= high.z(); ++k)
      for (int j = low.y(); j <= high.y(); ++j)
        for (int i = low.x(); i <= high.x(); ++i)
          for (int n = first_[number(i, j, k)]; n < first_[number(i, j, k) + 1]; ++n)
            if (look(triangles_[n])) return true;
    return false;
  }

 private:
  /// Of a point; the nearest cube where it is outside.
  Eigen::Vector3i bin_of(const Eigen::Vector3d& p) const {
    Eigen::Vector3i bin;
    for (int a = 0; a < 3; ++a)
      bin[a] = static_cast<int>(std::clamp((p[a] - origin_[a]) / size_, 0.0, static_cast<double>(count_[a] - 1)));
    return bin;
  }
  std::size_t number(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * count_[1] + j) * count_[0] + i;
  }

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  double size_;
  Eigen::Vector3i count_ = Eigen::Vector3i::Ones();
  std::vector<int> first_, triangles_;
};

Eigen::AlignedBox3d box_of(const Triangle3& triangle);

}  // namespace snug::mesh
