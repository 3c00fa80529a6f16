// Fung: W = mu/(2 b) (exp(b (J^(-2/3) I1 - 3)) - 1) + U(J): soft at first, then stiffening exponentially as skin and
// vessels do. b -> 0 is neo-Hooke. Isotropic form of Demiray, J. Biomech. 5 (1972) 309-311, of the exponential energy
// of Fung, Am. J. Physiol. 213 (1967) 1532-1544.
#pragma once

#include <cmath>

#include "materials/laws/first_invariant.hpp"
#include "materials/laws/volumetric.hpp"

namespace snug::materials {

struct Fung {
  double shear_modulus = 0.0;  ///< mu, Pa
  double stiffening = 1.0;     ///< b > 0
  Volumetric volume;

  SolidResponse isochoric(const Eigen::Matrix3d& F) const;
  VolumetricResponse volumetric(double J) const { return volume.at(J); }
  double initial_shear_modulus() const { return shear_modulus; }
  double initial_bulk_modulus() const { return volume.bulk_modulus; }
};

// With q = (J^(-2/3) I1 - 3)/2, its first and second derivative q', q'' by F and e = mu exp(2 b q):
//   W = mu/(2 b) (exp(2 b q) - 1),  P = e q',  A = e (q'' + 2 b q' (x) q').
inline SolidResponse Fung::isochoric(const Eigen::Matrix3d& F) const {
  SolidResponse r = first_invariant_energy(F, 1.0);
  const double growth = std::expm1(2.0 * stiffening * r.energy);
  const double e = shear_modulus * (growth + 1.0);
  const Eigen::Matrix<double, 9, 1> slope = components(r.stress);
  r.energy = 0.5 * shear_modulus / stiffening * growth;
  r.stress *= e;
  r.tangent = e * (r.tangent + 2.0 * stiffening * slope * slope.transpose());
  return r;
}

}  // namespace snug::materials
