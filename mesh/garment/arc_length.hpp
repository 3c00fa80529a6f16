// Equal lengths along the girth of a section.
#pragma once

#include <array>

#include "mesh/body/limb.hpp"

namespace snug::mesh {

/// Arc length along one section of an outline, and its inverse.
class SectionArc {
 public:
  /// The section at height z; lengths are counted from `start` (a turn), counter-clockwise seen from above.
  SectionArc(const Outline& outline, double z, double start);

  /// Perimeter of the section, m.
  double girth() const { return length_.back(); }
  /// The turn at a share in [0, 1] of the girth from the start; between start and start + 1.
  double turn_at(double share) const;

 private:
  static constexpr int panels = 128;
  double length_between(double from, double to) const;

  const Outline& outline_;
  double z_, start_;
  std::array<double, panels + 1> length_{};  // from the start to the end of each panel of equal turn
};

}  // namespace snug::mesh
