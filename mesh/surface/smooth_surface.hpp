// The smooth surface that a scan's facets stand for.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mesh/surface/surface_tree.hpp"

namespace snug::mesh {

/// Shares of a facet's weight at its corners. Of a scan the corners lie on what was scanned and the facet inside of it where it bulges: with all weight on
/// the facet the volume of the facets stays and their girth is lost by a third of that, with all at the corners the other way round. Between them both
/// stay. Of a surface that is known exactly at its corners all weight is there.
constexpr double scanned_corners = 0.25, exact_corners = 1.0;

/// Points are drawn onto the quadric that fits the scan's facets around them best (moving least squares: weights fall like a Gaussian of
/// standard deviation `radius / 2`, and with the turn of a facet's normal, so that a thigh does not pull at the other one). Facets count with their
/// area, by points inside and by their corners, so that volume and girths stay. Only what hangs together with
/// the nearest point counts. Where facets are large the Gaussian is as wide as they ask for.
class SmoothSurface {
 public:
  SmoothSurface(TriangleSurface surface, double radius, double at_corners = scanned_corners);

  struct Point {
    Eigen::Vector3d x, normal;
  };
  Point onto(const Eigen::Vector3d& x) const;
  /// The same in the plane through `point` with the unit normal `across`: x ends on both.
  Eigen::Vector3d onto(const Eigen::Vector3d& x, const Eigen::Vector3d& point, const Eigen::Vector3d& across) const;
  const TriangleSurface& surface() const { return surface_; }
  const SurfaceTree& tree() const { return tree_; }

 private:
  std::vector<int> around(int triangle, const Eigen::Vector3d& foot, double reach) const;  // triangles
  Point fitted(const Eigen::Vector3d& x) const;

  TriangleSurface surface_;
  SurfaceTree tree_;
  double sigma_, at_corners_;
  std::vector<std::vector<int>> triangles_at_;  // of each vertex
  std::vector<Eigen::Vector3d> normals_;        // of each triangle
  std::vector<double> areas_;
};

}  // namespace snug::mesh
