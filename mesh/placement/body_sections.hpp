// The sections of a standing body, and its landmarks by them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/body/sections.hpp"
#include "mesh/placement/body_surface.hpp"

namespace snug::mesh {

/// x positive, x negative.
enum class Side { right, left };
constexpr double sign_of(Side side) { return side == Side::right ? 1.0 : -1.0; }

/// Horizontal sections of a body, which must outlive them, found quickly: each looks at the triangles near its height.
class BodySections {
 public:
  explicit BodySections(const BodySurface& body);

  std::vector<SectionLoop> at(double z) const;
  /// The largest loop that reaches across the middle plane, 0.024 of the scale to both sides.
  std::optional<SectionLoop> trunk(double z) const;
  /// The largest loop on one side that is near the middle plane, which arms are not.
  std::optional<SectionLoop> leg(Side side, double z) const;
  /// m, x: what of the left leg and what of the right one is nearest to the other.
  std::optional<std::array<double, 2>> between_legs(double z) const;
  /// The largest loop on one side beyond `x` (m from the middle plane).
  std::optional<SectionLoop> arm(Side side, double z, double x) const;

  double stature() const { return stature_; }
  double scale() const { return scale_; }  ///< BodySurface::scale

 private:
  const std::vector<Eigen::Vector3d>* vertices_;
  double stature_, scale_, layer_;
  std::vector<std::vector<std::array<int, 3>>> layers_;  // triangles that reach into each
};

/// Convex hull of points in the plane, counter-clockwise.
std::vector<Eigen::Vector2d> convex_hull(std::vector<Eigen::Vector2d> points);
double closed_length(const std::vector<Eigen::Vector2d>& points);

/// Heights above the lowest point, m. A body that is cut may have no legs or no arms.
struct Landmarks {
  bool legs = true, arms = true;
  double ankle = 0.0;              ///< least girth of a leg near the foot; where the legs are cut the upper end of the cut
  double crotch = 0.0;             ///< lowest section that reaches across the middle plane; 0 without legs
  double seat = 0.0, waist = 0.0;  ///< largest and least taped girth of the trunk
  double armpit = 0.0;             ///< where the section of the trunk takes in the arms; the top without arms
  double neck = 0.0;               ///< least girth between the arms and the head, or the top of a body without
  double seat_girth = 0.0, waist_girth = 0.0, chest_girth = 0.0;  ///< taped: of the convex hull, m
  double armpit_half_width = 0.0;                                 ///< of the trunk below the arms, m
};

/// m, highest point of the body below its neck within a centimetre of `x`; 0 where there is none.
double shoulder_top(const BodySurface& body, const Landmarks& marks, double x);

/// Of a whole body throws input::InputError where the legs meet nowhere, or the arms are not apart from the trunk anywhere; of one that is
/// cut where nothing goes through the middle plane.
Landmarks find_landmarks(const BodySections& sections, const BodySurface& body);

}  // namespace snug::mesh
