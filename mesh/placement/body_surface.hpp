// A standing body as a closed surface, in a frame found from the surface itself.
#pragma once

#include <Eigen/Geometry>

#include <optional>

#include "cases/input/body_spec.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// Outwards oriented triangles in m: x to the wearer's right, y to the front, z up; the lowest point at z = 0, the
/// origin midway between the shanks.
struct BodySurface {
  TriangleSurface surface;
  double stature = 0.0;  ///< m
  /// The frame of the body: place = rotation * (place in the file, m) + translation.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  input::Location where = {};
};

/// How the file of a surface is to be read.
struct BodyAxes {
  double unit = 1.0;  ///< m a unit of the file
  input::FileAxis up = input::FileAxis::z;
  std::optional<input::FileAxis> front = {};  ///< left out: where the toes are
};

/// The surface (in the units and axes of its file) as a body. x lies along the line between the shanks, the two largest
/// sections at a fifth of the stature; the front is the side on which what is below 3 % of the stature has its middle.
/// Scans may cut themselves. Throws input::InputError: a surface that is open or encloses nothing, no two shanks, toes
/// to no side where no front is given.
BodySurface standing_body(TriangleSurface in_file, const BodyAxes& axes, const input::Location& where);

}  // namespace snug::mesh
