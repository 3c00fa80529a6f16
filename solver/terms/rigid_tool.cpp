#include "solver/terms/rigid_tool.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::solver {

// With the foot c of x on the core, v = x - c and n = v/|v|: g = |v| - round, g' = n, g'' = (I - c' - n n^T) / |v|.
ToolGap RigidTool::gap(const Eigen::Vector3d& from_tip) const {
  const double ahead = from_tip.dot(direction) + round;  // of the core's face
  const Eigen::Vector3d beside = from_tip - from_tip.dot(direction) * direction;
  const double rho = beside.norm();
  if (rho <= flat && (ahead <= 0.0 || flat > 0.0)) return {ahead - round, direction, Eigen::Matrix3d::Zero()};
  const double out = std::max(rho - flat, 0.0);
  const Eigen::Vector3d across = rho > 0.0 ? Eigen::Vector3d(beside / rho) : Eigen::Vector3d::Zero();
  const Eigen::Vector3d v = out * across + std::max(ahead, 0.0) * direction;
  const double distance = v.norm();
  if (distance == 0.0) return {ahead - round, direction, Eigen::Matrix3d::Zero()};
  const Eigen::Matrix3d axial = direction * direction.transpose();
  Eigen::Matrix3d foot = Eigen::Matrix3d::Zero();
  if (flat > 0.0) foot += flat / rho * (Eigen::Matrix3d::Identity() - axial - across * across.transpose());
  if (ahead < 0.0) foot += axial;
  ToolGap gap{distance - round, v / distance, {}};
  gap.curvature = (Eigen::Matrix3d::Identity() - foot - gap.normal * gap.normal.transpose()) / distance;
  return gap;
}

double RigidTool::way_to(const Eigen::Vector3d& from_tip) const {
  const double along = from_tip.dot(direction), rho = (from_tip - along * direction).norm();
  if (rho > radius()) return std::numeric_limits<double>::infinity();
  const double beyond = std::max(rho - flat, 0.0);
  return along + round - std::sqrt(std::max(round * round - beyond * beyond, 0.0));
}

}  // namespace snug::solver
