// The two halves of a body's sections by height, as a garment goes round them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "mesh/placement/body_sections.hpp"
#include "mesh/placement/garment_rings.hpp"

namespace snug::mesh {

/// Rows of points on the skin, equally spaced by arc length, in the order of `Track`.
class SectionRows {
 public:
  /// Legs: the sections of the trunk above the crotch, split at the middle plane, of both legs together down to the
  /// fork of the garment (m), and of each leg below, from where it is nearest to the other. Else convex hulls, since a
  /// garment that hangs goes straight over hollows: of the trunk, below the crotch of both legs; above the armpit
  /// without what is farther from the middle plane than `half_width(z)` (m), which is arm.
  template <class HalfWidth>
  SectionRows(const BodySections& sections, const Landmarks& marks, GarmentKind kind, double fork,
              const HalfWidth& half_width)
      : rows_{std::vector<Row>(count(sections)), std::vector<Row>(count(sections))} {
    for (std::size_t n = 0; n < rows_[0].size(); ++n)
      fill(sections, marks, kind, fork, n, half_width(spacing * static_cast<double>(n)));
    for (auto& rows : rows_) smooth(rows);
  }

  /// The point at a share of the way, [0, 1], at a height (m); the nearest row where there is none.
  Eigen::Vector3d at(Side side, double z, double share) const;
  /// The point in front or behind that is `distance` from the middle plane, or as near to that as the row goes.
  Eigen::Vector3d beside(Side side, bool front, double z, double distance) const;

 private:
  static constexpr double spacing = 0.005;  // m
  static constexpr int points = 65;
  using Row = std::optional<Eigen::Matrix<double, 2, points>>;

  static std::size_t count(const BodySections& sections) {
    return static_cast<std::size_t>(sections.stature() / spacing) + 1;
  }
  void fill(const BodySections& sections, const Landmarks& marks, GarmentKind kind, double fork, std::size_t row,
            double half_width);
  static void smooth(std::vector<Row>& rows);
  /// Rows below and above a height, and the share of the upper one.
  std::pair<const Row*, const Row*> around(Side side, double z, double& share) const;

  std::array<std::vector<Row>, 2> rows_;  // by Side
};

}  // namespace snug::mesh
