// Flat pieces laid on a standing body: the start of a placement.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mesh/placement/garment_rings.hpp"
#include "mesh/placement/section_rows.hpp"

namespace snug::mesh {

/// Every row of the pieces is laid by arc length on the section of trunk or leg at its height, each half of the body
/// shared among its pieces by their widths, so that a row is stretched evenly. The cloth is not on the skin afterwards
/// and its pieces need not meet; particles bring that about.
///
/// Heights: the fork of legs 10 mm below the crotch, never higher; what is below it shortened where the hem would pass
/// the ankle, what is above it lengthened where the garment is raised; seams on top of shoulders 10 mm above the body
/// there; of tubes the upper edge at the waist. Where a lowest point is asked for, it is laid there: legs are
/// shortened or lengthened between it and the fork, other garments moved as a whole.
class GarmentChart {
 public:
  /// `raise` (m): higher on the body than found. `lowest` (m): height of the lowest point. Throws input::InputError where the body has not
  /// what the garment goes round, and where legs would be laid at less than 0.65 or more than 1.3 of their length.
  GarmentChart(const CheckedPattern& checked, const BodySections& sections, const Landmarks& marks,
               const BodySurface& body, double raise, std::optional<double> lowest = {});

  /// m, frame of the body; of a point in the drawing of a piece.
  Eigen::Vector3d place(int piece, const Eigen::Vector2d& p) const;
  const GarmentRings& rings() const { return rings_; }
  /// Of a point on a leg below the fork the side of that leg: 1 right, -1 left; else 0.
  int leg_side(int piece, const Eigen::Vector2d& p) const;

 private:
  struct OnTrack {
    Side side;
    double along = 0.0, whole = 0.0;  // m, of the widths on the track at this height
  };
  double width(int piece, double pattern_height) const;
  OnTrack on_track(int piece, const Eigen::Vector2d& p, double pattern_height) const;
  double from_middle(const RingPiece& piece, const OnTrack& at) const;
  double height(double pattern_height) const;
  void set_leg_heights(const Landmarks& marks, double raise, std::optional<double> lowest);
  void check_body(const Landmarks& marks, const BodySurface& body) const;
  void check_legs(const Landmarks& marks, const BodySurface& body) const;
  double strap_lift(const BodySurface& body, const Landmarks& marks) const;
  double half_width(double z) const;
  void find_half_widths(const Pattern& pattern);

  GarmentRings rings_;
  double lift_ = 0.0;  // m, from the heights of the pattern to those of the body
  double fork_ = 0.0, below_ = 1.0,
         above_ = 1.0;               // legs: m, of the fork on the body; height on it over that of the pattern
  std::vector<double> half_widths_;  // m, of the cloth above the sides, by 5 mm of pattern height from the hem on
  std::unique_ptr<SectionRows> rows_;
};

}  // namespace snug::mesh
