// Fung: W = mu/(2 b) (exp(b (J^(-2/3) I1 - 3)) - 1) + U(J): soft at first, then stiffening exponentially as skin and
// vessels do. b -> 0 is neo-Hooke. Isotropic form of Demiray, J. Biomech. 5 (1972) 309-311, of the exponential energy
// of Fung, Am. J. Physiol. 213 (1967) 1532-1544.
#pragma once

#include "materials/laws/response.hpp"
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

}  // namespace snug::materials
