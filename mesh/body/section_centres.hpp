// The middle of an imported body at each height, so that angles count round the same point as on a limb.
#pragma once

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// The skin's facets as flat triangles between all of their nodes; numbers of nodes.
std::vector<std::array<int, 3>> triangulated_nodes(const BodyMesh& body);
/// The same as a surface of its own.
TriangleSurface triangulated(const BodyMesh& body);

/// Centroid of the area of the largest closed section of the skin, between heights sampled over all of it; where no section
/// closes, that of the nearest height where one does, and of a skin that is closed nowhere the mean of its nodes.
class SectionCentres {
 public:
  explicit SectionCentres(const BodyMesh& body);
  /// Of the limb that a point is in: the section nearest to it, followed upwards and downwards as long as its middle moves by less than its
  /// radius and its girth by less than a third.
  SectionCentres(const BodyMesh& body, const Eigen::Vector3d& in_limb);
  Eigen::Vector2d at(double z) const;  ///< m
  /// Whether a point belongs to the limb; of the whole body every one does.
  bool holds(const Eigen::Vector3d& x) const;

 private:
  std::vector<double> height_;
  std::vector<Eigen::Vector2d> centre_;
  std::vector<double> reach_;  ///< m, of a limb: its farthest point from the middle
};

}  // namespace snug::mesh
