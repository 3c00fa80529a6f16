// The surface of a rigid tool: a flat round disc with a rounded edge, or a ball, at the end of a straight rod.
#pragma once

#include <Eigen/Core>

namespace snug::solver {

/// Signed distance from a tool, with its first and second derivative by the place.
struct ToolGap {
  double value = 0.0;                                          ///< m, negative inside
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();            ///< unit vector away from the tool
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();         ///< 1/m
};

/// All points within `round` of a core: the disc of radius `flat` across the direction, `round` behind the tip, and what is behind it. A ball has
/// no flat. Distances from a convex core and their derivatives: Boyd & Vandenberghe, Convex Optimization (2004), sec. 8.1 (projection).
struct RigidTool {
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();  ///< unit vector in which the face looks
  double flat = 0.0, round = 0.0;                        ///< m

  double radius() const { return flat + round; }         ///< m
  /// At a place (m, from the tip). In the core, where the distance has no use, the face goes on: what is as deep is pushed out through it.
  ToolGap gap(const Eigen::Vector3d& from_tip) const;
  /// How far (m, along the direction) the tool goes until it meets a place, negative where it is past it; infinite where that is beside its way.
  double way_to(const Eigen::Vector3d& from_tip) const;
};

}  // namespace snug::solver
