// Compressible neo-Hooke without split: W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2, a barrier as J -> 0.
// For displacement-only elements and a Poisson ratio well below one half.
// Source: Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. (2008), eq. 6.27.
#pragma once

#include <cmath>

#include "materials/laws/response.hpp"
#include "materials/laws/tensor.hpp"

namespace snug::materials {

struct CompressibleNeoHooke {
  double shear_modulus = 0.0;   ///< mu, Pa
  double lame_parameter = 0.0;  ///< lambda, Pa

  SolidResponse coupled(const Eigen::Matrix3d& F) const;
  double initial_shear_modulus() const { return shear_modulus; }
  double initial_bulk_modulus() const { return lame_parameter + 2.0 / 3.0 * shear_modulus; }
};

// With G = F^-T:  P = mu (F - G) + lambda ln J G,
//   A_iJ,kL = mu d_ik d_JL + lambda G_iJ G_kL + (mu - lambda ln J) G_iL G_kJ.
inline SolidResponse CompressibleNeoHooke::coupled(const Eigen::Matrix3d& F) const {
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
