#include "materials/laws/fung.hpp"

#include <cmath>

#include "materials/laws/first_invariant.hpp"

namespace snug::materials {

// With q = (J^(-2/3) I1 - 3)/2: W = mu/(2 b) (exp(2 b q) - 1).
SolidResponse Fung::isochoric(const Eigen::Matrix3d& F) const {
  const SolidResponse q = first_invariant_energy(F, 1.0);
  const double growth = std::expm1(2.0 * stiffening * q.energy), slope = shear_modulus * (growth + 1.0);
  return response_of({.energy = 0.5 * shear_modulus / stiffening * growth, .slope = slope, .curvature = 2.0 * stiffening * slope}, q);
}

}  // namespace snug::materials
