// The smooth geometry of a limb: skin and bone as functions of angle and height, built from stations, outlines or a scan.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/input/case.hpp"

namespace snug::mesh {

/// A point of an outline with its derivatives: `_t` per unit of turn, `_z` per metre of height.
struct OutlinePoint {
  Eigen::Vector3d x, x_t, x_z, x_tt, x_tz, x_zz;
};

/// A closed section outline for every height. Twice continuously differentiable in both arguments, because contact
/// pressure is tension times curvature. Frame of the body: z along the axis (up), x to the side, y to the front;
/// metres.
class Outline {
 public:
  virtual ~Outline() = default;
  /// Point at `turn` in [0, 1) (periodic; 0 = side +x, 0.25 = front +y) and height z.
  virtual Eigen::Vector3d at(double turn, double z) const = 0;
  /// The same point with first and second derivatives; by fourth-order central differences of `at` unless the outline
  /// knows them exactly.
  virtual OutlinePoint derivatives(double turn, double z) const;
  /// The turn of the point that lies at an angle (rad, from +x) from the centre of the outline; the same share of a full turn
  /// unless the outline says otherwise.
  virtual double turn_at_angle(double angle, double z) const;
};

/// Outward unit normal of an outline.
Eigen::Vector3d outward_normal(const Outline& outline, double turn, double z);

/// Centroid of the section's area at height z, m.
Eigen::Vector2d section_centre(const Outline& outline, double z);

/// One row of a table of girths, m.
struct GirthRow {
  double height = 0.0, girth = 0.0, width = 0.0, depth = 0.0;  ///< width along x, depth along y
};

/// How far a smooth skin is from the scan it stands for, m; zero for stations.
struct FitResidual {
  double rms = 0.0, max = 0.0;
  double smoothing_radius = 0.0;
};

/// Geometry of a limb between two heights.
struct Limb {
  std::unique_ptr<Outline> skin;
  std::unique_ptr<Outline> bone;
  double lower = 0.0, upper = 0.0;  ///< m, heights of the cut planes
  FitResidual residual = {};
  std::vector<input::Diagnostic> remarks = {};  ///< what was taken where the input says nothing, and what looks like a slip in it

  /// Outward unit normal of the skin (exact where the outline knows its derivatives).
  Eigen::Vector3d skin_normal(double turn, double z) const;
  /// Perimeter of the skin section at height z, m.
  double girth(double z) const;
  /// Normal curvatures of the skin {around, along}, 1/m: in the hoop direction and in the surface direction at right
  /// angles to it. Positive where the skin bulges outwards, so that tension times curvature presses on the body.
  Eigen::Vector2d skin_curvature(double turn, double z) const;
};

/// Girth, width and depth of the skin at `rows` equally spaced heights from lower to upper (for printing).
std::vector<GirthRow> girth_table(const Limb& limb, int rows);

/// Throws input::InputError (at `where`) naming height and angle where the bone is not inside the skin.
void check_bone_inside(const Limb& limb, const input::Location& where);

/// Builds the geometry of `spec`. Throws input::InputError (missing file, open surface, girth of zero, bone outside the
/// skin, ...) with place and remedy.
Limb make_limb(const input::BodySpec& spec);

}  // namespace snug::mesh
