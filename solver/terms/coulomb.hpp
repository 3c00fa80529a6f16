// Coulomb's bound on a traction that sticks elastically: what frictions of every kind share.
#pragma once

#include <Eigen/Core>

#include <algorithm>

namespace snug::solver {

/// A traction turned into the plane normal to n with its length kept: that of a point that has moved on along the surface.
inline Eigen::Vector3d transported(const Eigen::Vector3d& t, const Eigen::Vector3d& n) {
  const Eigen::Vector3d flat = t - t.dot(n) * n;
  const double length = flat.norm();
  return length > 0.0 ? Eigen::Vector3d(t.norm() / length * flat) : Eigen::Vector3d::Zero();
}

/// A traction (Pa) brought back to its bound.
struct Bounded {
  Eigen::Vector3d traction;
  bool slips;
};

/// Radial return of a trial traction (Pa) to the ball of radius `bound` (Pa).
inline Bounded bounded(const Eigen::Vector3d& trial, double bound) {
  const double length = trial.norm();
  const bool slips = length > bound;
  return {slips ? Eigen::Vector3d(bound / length * trial) : trial, slips};
}

/// A corner of a frozen problem (its members `slipping` and `turned`) remembers which way it slips, and whether that has turned since the iterate before.
template <class Corner>
void remember_slip(const Eigen::Vector3d& traction, const Corner* before, Corner& corner) {
  corner.slipping = traction;
  corner.turned = before && traction.dot(before->slipping) < 0.0;
}

/// Derivative of the returned traction by the trial one; along a slip that has turned it is the secant's.
inline Eigen::Matrix3d slope_of_return(const Eigen::Vector3d& trial, double bound, bool slips, bool turned) {
  Eigen::Matrix3d slope = Eigen::Matrix3d::Identity();
  if (!slips) return slope;
  const double length = trial.norm();
  if (!turned) slope -= trial * trial.transpose() / (length * length);
  return bound / length * slope;
}

/// Energy (J) whose slope is that traction: area (m2) times held (trial - held / 2) over the stiffness (N/m) of sticking, held = min(trial, bound).
inline double energy_of_slip(double trial, double bound, double area, double stiffness) {
  const double held = std::min(trial, bound);
  return area * held * (trial - 0.5 * held) / stiffness;
}

}  // namespace snug::solver
