// The surface that a garment is laid on: the skin of a limb, or off it where the garment is wider.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mesh/body/limb.hpp"
#include "mesh/garment/garment_fit.hpp"

namespace snug::mesh {

struct SheetPoint {
  Eigen::Vector3d x, x_round, x_up;  ///< m, and per turn and per m of height
};

/// The surface in coordinates of its own: lengths round the limb as shares, counted from a line along the limb, and height.
class LimbSheet {
 public:
  /// For a garment of this fit. Its shares begin at the limb's `angle` (rad).
  LimbSheet(const Limb& limb, const GarmentFit& fit, double lift, double angle);

  /// By bicubic interpolation (Catmull-Rom) in a table of rows; the derivatives are those of what is interpolated.
  SheetPoint near(double share, double height) const;
  /// Exactly.
  Eigen::Vector3d at(double share, double height) const;
  double farthest() const { return farthest_; }  ///< m, off the skin where it is wider; 0: nowhere
  double mean_girth() const { return mean_girth_; }

  /// Length (m) along the limb from its lower end to a height, mean over the way round, and back.
  double length_to(double height) const;
  double height_after(double length) const;

 private:
  static constexpr int columns = 128;
  double height_of(int row) const { return lower_ + step_ * row; }
  void add_row(const GarmentFit& fit, double lift, double angle, int row);
  /// Turn and distance off the skin.
  Eigen::Vector2d turn_at(double share, double height) const;

  const Limb& limb_;
  double lower_, step_, farthest_ = 0.0, mean_girth_ = 0.0;
  int rows_;
  std::vector<std::vector<double>> turn_;       // by row and column, one column more than there are: a full turn
  std::vector<double> distance_, length_, slope_;  // by row; length along the limb per height
  std::vector<std::vector<Eigen::Vector3d>> x_;
};

}  // namespace snug::mesh
