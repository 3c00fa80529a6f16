// Linear elasticity between the second Piola-Kirchhoff stress and the Green-Lagrange strain (St. Venant-Kirchhoff), so
// that a rotation makes no stress: W = lambda/2 (tr E)^2 + mu E:E. For stiff solids that strain little (bone); under
// large compression it softens and has no barrier as J -> 0.
// Source: Holzapfel, Nonlinear Solid Mechanics (2000), eq. 6.151.
#pragma once

#include "materials/laws/response.hpp"

namespace snug::materials {

struct LinearElastic {
  double youngs_modulus = 0.0;  ///< E, Pa
  double poisson_ratio = 0.0;

  SolidResponse coupled(const Eigen::Matrix3d& F) const;
  double initial_shear_modulus() const { return 0.5 * youngs_modulus / (1.0 + poisson_ratio); }
  double initial_bulk_modulus() const { return youngs_modulus / (3.0 * (1.0 - 2.0 * poisson_ratio)); }
};

}  // namespace snug::materials
