// A standing body as a closed surface, in a frame found from the surface itself.
#pragma once

#include <Eigen/Geometry>

#include <limits>
#include <optional>

#include "cases/input/body_spec.hpp"
#include "mesh/formats/triangle_surface.hpp"

namespace snug::mesh {

/// Outwards oriented triangles in m: x to the wearer's right, y to the front, z up; the lowest point at z = 0, the
/// origin midway between the shanks.
struct BodySurface {
  TriangleSurface surface;
  double stature = 0.0;  ///< m, from the lowest point to the highest
  double scale = 0.0;    ///< m, of proportions: the stature of the whole body, which this may be a part of
  /// The frame of the body: place = rotation * (place in the file, m) + translation.
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();
  /// The first so many triangles are skin, the others lids over its cuts; of a scan that is closed all are skin.
  std::size_t skin_triangles = std::numeric_limits<std::size_t>::max();
  input::Location where = {};

  Eigen::Vector3d in_body(const Eigen::Vector3d& in_file) const { return rotation * in_file + translation; }
  Eigen::Vector3d in_file(const Eigen::Vector3d& in_body) const { return rotation.transpose() * (in_body - translation); }
  bool is_skin(std::size_t triangle) const { return triangle < skin_triangles; }
  bool is_cut() const { return skin_triangles < surface.triangles.size(); }
};

/// Throws input::InputError (at `where`, with the ends of an edge) unless every edge is walked as often one way as the other. More than two
/// triangles may share one, as they do where a scan touches itself.
void check_encloses(const TriangleSurface& surface, const input::Location& where);

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
