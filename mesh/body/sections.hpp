// Horizontal sections of a triangulated surface.
#pragma once

#include <Eigen/Core>

#include <array>
#include <span>
#include <vector>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// A closed polygon in a horizontal plane, counter-clockwise seen from above; the first point is not repeated.
struct SectionLoop {
  std::vector<Eigen::Vector2d> points;
  Eigen::Vector2d centroid = Eigen::Vector2d::Zero();  ///< of the area
  double area = 0.0;
  double girth = 0.0;
};

/// All loops of the surface at height z. A vertex that lies exactly in the plane counts as below it. Chains that do not
/// close (a hole in the surface) are left out.
std::vector<SectionLoop> slice(const TriangleSurface& surface, double z);
/// The same of some triangles.
std::vector<SectionLoop> slice(const std::vector<Eigen::Vector3d>& vertices,
                               std::span<const std::array<int, 3>> triangles, double z);

/// Distances from `from` to where the rays at angles 2 pi n / count leave the loop for the last time; negative where a
/// ray does not meet it.
Eigen::VectorXd ray_radii(const SectionLoop& loop, const Eigen::Vector2d& from, int count);

}  // namespace snug::mesh
