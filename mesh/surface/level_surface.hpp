// The surface where a function in space is zero, such as a depth under a skin.
#pragma once

#include <Eigen/Core>

#include <functional>

#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

struct Box {
  Eigen::Vector3d low, high;
};

/// A closed surface round the points of the box where `level` is positive, by marching tetrahedra on a grid of the given spacing; it shows
/// its outside. `level` changes by at most twice its argument's change, as a depth less a thickness that varies does. Empty where it is
/// positive nowhere.
TriangleSurface level_surface(const std::function<double(const Eigen::Vector3d&)>& level, const Box& box, double spacing);

}  // namespace snug::mesh
