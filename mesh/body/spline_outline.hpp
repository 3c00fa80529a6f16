// Sections of a limb given by points on them.
#pragma once

#include <vector>

#include "mesh/body/limb.hpp"
#include "mesh/curves/four_point.hpp"
#include "mesh/curves/w_surface.hpp"

namespace snug::mesh {

/// The bicubic B-spline surface through the points of sections (mesh/curves/interpolation), which goes on straight beyond them. It is followed
/// along a turn to the height that is asked for: the sections of the points need not be level.
class SplineOutline final : public Outline {
 public:
  /// Rows from below, each counter-clockwise round its own middle. Throws input::InputError (at `where`, of `text`) where the points of a section
  /// do not go once round its middle one after the other, or a column does not go up between them.
  SplineOutline(const curves::Net& sections, const std::string& text, const input::Location& where);

  Eigen::Vector3d at(double turn, double z) const override;
  OutlinePoint derivatives(double turn, double z) const override;
  double turn_at_angle(double angle, double z) const override;

 private:
  const curves::WSurface& patch(double u, double v) const;
  double height_parameter(double turn, double z) const;
  double round(double turn) const;
  void check_rise(const curves::Net& sections, const std::string& text, const input::Location& where) const;

  std::vector<double> rows_, columns_;     // where the patches begin, and the last ends
  std::vector<curves::WSurface> patches_;  // row by row
};

}  // namespace snug::mesh
