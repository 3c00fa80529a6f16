// The smooth geometry of a limb: skin and bone as functions of angle and height, built from stations or from a scan.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/input/case.hpp"

namespace snug::mesh {

/// A closed section outline for every height. Twice continuously differentiable in both arguments, because contact
/// pressure is tension times curvature. Frame of the body: z along the axis (up), x to the side, y to the front; metres.
class Outline {
 public:
  virtual ~Outline() = default;
  /// Point at `turn` in [0, 1) (periodic; 0 = side +x, 0.25 = front +y) and height z.
  virtual Eigen::Vector3d at(double turn, double z) const = 0;
};

/// Geometry of a limb between two heights.
struct Limb {
  std::unique_ptr<Outline> skin;
  std::unique_ptr<Outline> bone;
  double lower = 0.0, upper = 0.0;  ///< m, heights of the cut planes

  /// Outward unit normal of the skin by central differences of `at` (or exactly where the outline knows it).
  Eigen::Vector3d skin_normal(double turn, double z) const;
  /// Perimeter of the skin section at height z, m.
  double girth(double z) const;
  /// Principal curvatures of the skin: {around, along} as normal curvatures in the hoop and the axial direction, 1/m.
  Eigen::Vector2d skin_curvature(double turn, double z) const;
};

/// Builds the geometry of `spec`. Throws input::InputError (missing file, open surface, girth of zero, bone outside the
/// skin, ...) with place and remedy.
Limb make_limb(const input::BodySpec& spec);

}  // namespace snug::mesh
