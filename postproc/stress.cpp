#include "postproc/stress.hpp"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace snug::postproc {

Eigen::Vector3d principal_stresses(const Stress& stress) {
  Eigen::Matrix3d tensor;
  tensor << stress[0], stress[3], stress[5],  //
      stress[3], stress[1], stress[4],        //
      stress[5], stress[4], stress[2];
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(tensor, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse();
}

double von_mises(const Stress& stress) {
  const double xy = stress[0] - stress[1], yz = stress[1] - stress[2], zx = stress[2] - stress[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3 * stress.tail<3>().squaredNorm());
}

}  // namespace snug::postproc
