#include "materials/laws/linear_elastic.hpp"

#include "materials/laws/tensor.hpp"

namespace snug::materials {

// S = lambda tr E 1 + 2 mu E, P = F S, b = F F^T:
//   A_iJ,kL = d_ik S_JL + lambda F_iJ F_kL + mu (F_iL F_kJ + b_ik d_JL).
SolidResponse LinearElastic::coupled(const Eigen::Matrix3d& F) const {
  const double mu = initial_shear_modulus(), lambda = initial_bulk_modulus() - 2.0 / 3.0 * mu;
  const Eigen::Matrix3d E = 0.5 * (F.transpose() * F - Eigen::Matrix3d::Identity()), b = F * F.transpose();
  const Eigen::Matrix3d S = lambda * E.trace() * Eigen::Matrix3d::Identity() + 2.0 * mu * E;

  SolidResponse r;
  r.energy = 0.5 * lambda * E.trace() * E.trace() + mu * E.squaredNorm();
  r.stress = F * S;
  const Eigen::Matrix<double, 9, 1> f = components(F);
  r.tangent = lambda * f * f.transpose();
  add_geometric(r.tangent, S);
  add_swapped(r.tangent, mu, F);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int J = 0; J < 3; ++J) r.tangent(3 * i + J, 3 * k + J) += mu * b(i, k);
  return r;
}

}  // namespace snug::materials
