// The closed curve along which a garment runs round a limb at one height.
#pragma once

#include <memory>

#include "mesh/garment/arc_length.hpp"

namespace snug::mesh {

/// How far off the skin (m) a garment of this width stands at height z: a curve parallel to a closed one is longer by 2 pi times
/// the distance. `lift` where the garment is no wider than the skin; not so far that the parallel curve folds where the section is hollow.
double stand_off(const Limb& limb, double skin_girth, double z, double width, double lift);

/// On the skin, or parallel to it where the garment is wider.
class GirthCurve {
 public:
  /// Of a garment of this `width` (m) at height z, counted from `start` (a turn).
  GirthCurve(const Limb& limb, double z, double width, double lift, double start);

  double distance() const { return distance_; }      ///< m, off the skin
  bool loose() const { return parallel_ != nullptr; }  ///< wider than the skin
  /// The turn at a share in [0, 1] of the curve's length.
  double turn_at(double share) const { return arc_->turn_at(share); }

 private:
  double distance_;
  std::unique_ptr<Outline> parallel_;
  std::unique_ptr<SectionArc> arc_;
};

}  // namespace snug::mesh
