// Compressible neo-Hooke without split: W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2, a barrier as J -> 0.
// For displacement-only elements and a Poisson ratio well below one half.
// Source: Bonet & Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. (2008), eq. 6.27.
#pragma once

#include "materials/laws/response.hpp"

namespace snug::materials {

struct CompressibleNeoHooke {
  double shear_modulus = 0.0;   ///< mu, Pa
  double lame_parameter = 0.0;  ///< lambda, Pa

  SolidResponse coupled(const Eigen::Matrix3d& F) const;
  double initial_shear_modulus() const { return shear_modulus; }
  double initial_bulk_modulus() const { return lame_parameter + 2.0 / 3.0 * shear_modulus; }
};

}  // namespace snug::materials
