#include "materials/laws/compressible_neo_hooke.hpp"

#include <cmath>

#include "materials/laws/tensor.hpp"

namespace snug::materials {

// With G = F^-T:  P = mu (F - G) + lambda ln J G,
//   A_iJ,kL = mu d_ik d_JL + lambda G_iJ G_kL + (mu - lambda ln J) G_iL G_kJ.
SolidResponse CompressibleNeoHooke::coupled(const Eigen::Matrix3d& F) const {
  const double mu = shear_modulus, lambda = lame_parameter;
  const Eigen::Matrix3d cof = cofactor(F);
  const double J = determinant(F, cof), log = std::log(J);
  const Eigen::Matrix3d G = cof / J;

  SolidResponse r;
  r.energy = 0.5 * mu * (F.squaredNorm() - 3.0) - mu * log + 0.5 * lambda * log * log;
  r.stress = mu * (F - G) + lambda * log * G;
  const Eigen::Matrix<double, 9, 1> n = components(G);
  r.tangent = lambda * n * n.transpose();
  r.tangent.diagonal().array() += mu;
  add_swapped(r.tangent, mu - lambda * log, G);
  return r;
}

}  // namespace snug::materials
