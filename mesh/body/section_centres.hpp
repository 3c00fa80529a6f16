// The middle of an imported body at each height, so that angles count round the same point as on a limb.
#pragma once

#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// The skin's facets as flat triangles between all of their nodes.
TriangleSurface triangulated(const BodyMesh& body);

/// Centroid of the area of the largest closed section of the skin, between heights sampled over all of it; where no section
/// closes, that of the nearest height where one does, and of a skin that is closed nowhere the mean of its nodes.
class SectionCentres {
 public:
  explicit SectionCentres(const BodyMesh& body);
  Eigen::Vector2d at(double z) const;  ///< m

 private:
  std::vector<double> height_;
  std::vector<Eigen::Vector2d> centre_;
};

}  // namespace snug::mesh
