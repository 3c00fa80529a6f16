// A surface to ask where its nearest point is and what lies inside.
#pragma once

#include <Eigen/Core>

#include <memory>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

struct NearestPoint {
  Eigen::Vector3d x;
  int triangle = 0;
};

/// Boxes in a tree (CGAL). It keeps what it needs of the surface.
class SurfaceTree {
 public:
  /// Throws std::runtime_error for a surface without triangles.
  explicit SurfaceTree(const TriangleSurface& surface);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;

  NearestPoint nearest(const Eigen::Vector3d& x) const;
  /// Of a closed surface.
  bool inside(const Eigen::Vector3d& x) const;
  /// Distance to the surface, negative inside.
  double signed_distance(const Eigen::Vector3d& x) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace snug::mesh
