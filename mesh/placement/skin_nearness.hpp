// The skin of a body as what falls on it meets it.
#pragma once

#include "mesh/particles/particle_forces.hpp"
#include "mesh/placement/body_surface.hpp"
#include "mesh/placement/distance_grid.hpp"

namespace snug::mesh {

/// Distances from a closed skin and the way off it, both continuous: the ways are differences of distances a grid cell apart.
class SkinNearness {
 public:
  /// `cell` (m): of the grid of distances.
  SkinNearness(const BodySurface& body, double cell);

  /// At a place in the frame of the case (that of the body's file).
  Nearness operator()(const Eigen::Vector3d& place) const;

 private:
  DistanceGrid distance_;
  Eigen::Matrix3d rotation_;
  Eigen::Vector3d translation_;
};

}  // namespace snug::mesh
