// Invariants of a symmetric stress tensor given as xx yy zz xy yz xz.
#pragma once

#include <Eigen/Core>

namespace snug::postproc {

using Stress = Eigen::Matrix<double, 6, 1>;

/// Principal stresses, largest first; unit of `stress`.
Eigen::Vector3d principal_stresses(const Stress& stress);

/// Von Mises equivalent stress, sqrt(3/2 s:s) of the deviator s.
double von_mises(const Stress& stress);

/// Tresca stress intensity S1 - S3.
inline double stress_intensity(const Eigen::Vector3d& principal) { return principal[0] - principal[2]; }

}  // namespace snug::postproc
