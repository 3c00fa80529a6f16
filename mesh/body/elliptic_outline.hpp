// Elliptic sections along a limb: the outline that stations of girths describe.
#pragma once

#include <vector>

#include "mesh/body/limb.hpp"
#include "mesh/body/spline.hpp"

namespace snug::mesh {

/// An elliptic section, metres in the frame of the body.
struct Ellipse {
  double z = 0.0;           ///< height
  double half_width = 0.0;  ///< semi-axis along x
  double half_depth = 0.0;  ///< semi-axis along y
  double centre_x = 0.0, centre_y = 0.0;
};

/// The ellipse of a given perimeter (girth) and ratio of width (x) to depth (y), from the complete elliptic integral of
/// the second kind: girth = 4 a E(e). Exactly a circle for a ratio of 1.
Ellipse ellipse_of_girth(double z, double girth, double width_to_depth, double centre_x, double centre_y);

/// Ellipses joined along z by natural cubic splines of the semi-axes and the centre. `turn` is the eccentric angle over
/// 2 pi, so that all derivatives are exact.
class EllipticOutline final : public Outline {
 public:
  /// At least two sections, heights strictly increasing; checked by the caller.
  explicit EllipticOutline(const std::vector<Ellipse>& sections);

  Eigen::Vector3d at(double turn, double z) const override;
  OutlinePoint derivatives(double turn, double z) const override;
  double turn_at_angle(double angle, double z) const override;

 private:
  Spline half_width_, half_depth_, centre_x_, centre_y_;
};

/// Straight limb with one elliptic skin and one elliptic bone section: the quick body of tests and trials.
Limb straight_limb(const Ellipse& skin, const Ellipse& bone, double lower, double upper);

}  // namespace snug::mesh
