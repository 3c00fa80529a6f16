// Where each place of a skin lies round its limb and along it.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "postproc/report/surfaces.hpp"

namespace snug::postproc::report {

/// The nodes of a skin in coordinates of its own: angle (deg) and height (m) of a tube, two lengths (m) of a flat skin.
/// Angles count from +x (0 deg, a limb's outer side) over +y (90 deg, front) round z, about the centroid of the section's area at the node's
/// height: of the skin, or of the node's own limb where two stand side by side. So do those of locations.
struct SkinChart {
  std::vector<Eigen::Vector2d> at;  ///< of the map: limbs side by side have half the width each
  std::vector<double> angle;        ///< deg, in [-180, 180], of the tube or of the node's own limb; empty: the skin is flat
  std::vector<int> limb;            ///< limbs.hpp; empty: the skin is flat
  bool tube = true;
  bool upright = true;              ///< false: the tube's axis is not z, the chart is turned
  double girth = 1.0;               ///< m, mean
};

SkinChart skin_chart(const Skin& skin);

/// An angle (deg) plus full turns, in [from, from + 360).
double wrapped(double angle, double from);

}  // namespace snug::postproc::report
