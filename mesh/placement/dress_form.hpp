// A standing body made ready for garments to be placed on it.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesh/placement/body_sections.hpp"
#include "mesh/placement/distance_grid.hpp"
#include "mesh/placement/triangle_bins.hpp"

namespace snug::mesh {

/// What is made of a body once, for all garments.
struct DressForm {
  BodySurface body;
  BodySections sections;
  Landmarks marks;
  DistanceGrid distance;
  TriangleBins bins;

  DressForm(const DressForm&) = delete;  // the sections look at the body
  DressForm& operator=(const DressForm&) = delete;

  Triangle3 triangle(int number) const {
    const auto& t = body.surface.triangles[number];
    return {body.surface.vertices[t[0]], body.surface.vertices[t[1]], body.surface.vertices[t[2]]};
  }

  /// `cell` (m): of the grid of distances. Throws input::InputError where no landmarks are found.
  explicit DressForm(BodySurface surface, double cell = 0.008);
};

/// Winding number of the body's surface about a point by solid angles (van Oosterom and Strackee, IEEE Trans. Biomed.
/// Eng. 30 (1983) 125): 1 inside, 0 outside, 2 where a scan overlaps itself.
double winding_number(const TriangleSurface& surface, const Eigen::Vector3d& p);

/// What a closed line can go round.
enum class BodyPart { nothing, neck, trunk, right_arm, left_arm, right_leg, left_leg };
constexpr auto texts_of(BodyPart) {
  return std::array{"nothing", "neck", "trunk", "right arm", "left arm", "right leg", "left leg"};
}

/// A limb in a horizontal section.
struct LimbSection {
  BodyPart part = BodyPart::trunk;
  SectionLoop loop;
  /// m, roughly how far outside it a point is.
  double off(const Eigen::Vector2d& p) const;
};
/// At a height (m): the trunk, beside it the arms up to the armpits, or below the crotch the legs.
std::vector<LimbSection> limbs_at(const DressForm& form, double z);
/// The nearest of them to a point in the frame of the body; empty where there is none at its height.
std::optional<LimbSection> limb_at(const DressForm& form, const Eigen::Vector3d& p);

/// Lines inside the body from above the head out of each arm and leg.
class LimbPaths {
 public:
  explicit LimbPaths(const DressForm& form);
  /// The limb that a closed line outside the body goes round once, by its linking numbers with the lines.
  BodyPart enclosed_by(const std::vector<Eigen::Vector3d>& loop) const;

 private:
  std::array<std::vector<Eigen::Vector3d>, 4> paths_;  // to the right and left arm, the right and left leg
};

}  // namespace snug::mesh
