// Signed distance to a closed surface, sampled on a grid.
#pragma once

#include <Eigen/Geometry>

#include <vector>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// Distances to a closed surface, outwards oriented, that may cut itself as scans do: positive where the winding number
/// is not. Exact at grid points within 2.5 cells of the surface, by fast sweeping beyond, linear between grid points.
class DistanceGrid {
 public:
  struct Value {
    double distance = 0.0;  ///< m; the grid ends 60 mm outside the surface's box and is continued as a constant
    Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit gradient, away from the body; 0 where there is none
  };

  /// `cell` in m. Throws std::invalid_argument where the grid would have more than 2e8 points.
  DistanceGrid(const TriangleSurface& surface, double cell);

  Value at(const Eigen::Vector3d& p) const;
  double distance(const Eigen::Vector3d& p) const;
  double cell() const { return cell_; }

 private:
  struct Corner {
    std::size_t first = 0;          // grid point below p
    Eigen::Vector3d share;          // of p in its cell, [0, 1]
    std::array<double, 8> value{};  // at the corners of the cell, x fastest
  };
  std::size_t number(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * count_[1] + j) * count_[0] + i;
  }
  Eigen::Vector3d point(int i, int j, int k) const { return origin_ + cell_ * Eigen::Vector3d(i, j, k); }
  Corner corner(const Eigen::Vector3d& p) const;

  std::vector<char> winding_signs(const TriangleSurface& surface) const;
  void sample_near(const TriangleSurface& surface, double band);
  std::vector<char> known(const std::vector<char>& inside, double band);
  bool outside_near(const std::vector<char>& inside, const Eigen::Vector3i& at, int reach) const;
  void sweep(const std::vector<char>& fixed);
  double upwind(int i, int j, int k) const;

  double cell_;
  Eigen::Vector3d origin_;
  Eigen::Vector3i count_;
  std::vector<float> value_;
};

}  // namespace snug::mesh
