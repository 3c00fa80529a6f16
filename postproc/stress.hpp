// Invariants of a symmetric stress tensor given as xx yy zz xy yz xz.
#pragma once

#include <Eigen/Dense>

#include <cmath>

namespace snug::postproc {

using Stress = Eigen::Matrix<double, 6, 1>;

/// Principal stresses, largest first; unit of `stress`.
inline Eigen::Vector3d principal_stresses(const Stress& stress) {
  Eigen::Matrix3d tensor;
  tensor << stress[0], stress[3], stress[5],  //
      stress[3], stress[1], stress[4],        //
      stress[5], stress[4], stress[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse();
}

/// Von Mises equivalent stress, sqrt(3/2 s:s) of the deviator s.
inline double von_mises(const Stress& stress) {
  const double xy = stress[0] - stress[1], yz = stress[1] - stress[2], zx = stress[2] - stress[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * stress.tail<3>().squaredNorm());
}

/// Tresca stress intensity S1 - S3.
inline double stress_intensity(const Eigen::Vector3d& principal) { return principal[0] - principal[2]; }

}  // namespace snug::postproc
