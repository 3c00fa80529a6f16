// How wide a tube is at a height of it.
#pragma once

#include <optional>

#include "cases/input/garment_spec.hpp"
#include "mesh/body/spline.hpp"

namespace snug::mesh {

/// Circumference (m) at rest of a tube at a height over its lower edge (m), as knitted: the same everywhere, or of a graduated one between
/// its rows by monotone cubics, beyond them as at the ends.
class TubeGirth {
 public:
  explicit TubeGirth(const input::PatternSpec& tube);
  double operator()(double height) const;
  /// m, over its length: the width of the rectangle that the tube is meshed on.
  double mean() const { return mean_; }

 private:
  double low_ = 0.0, high_ = 0.0, mean_ = 0.0;
  std::optional<Spline> rows_;
};

}  // namespace snug::mesh
