// Mooney-Rivlin: W = C10 (J^(-2/3) I1 - 3) + C01 (J^(-4/3) I2 - 3) + U(J), mu = 2 (C10 + C01).
// Source: Mooney, J. Appl. Phys. 11 (1940) 582-592; Rivlin, Phil. Trans. R. Soc. A 241 (1948) 379-397.
#pragma once

#include "materials/laws/response.hpp"
#include "materials/laws/volumetric.hpp"

namespace snug::materials {

struct MooneyRivlin {
  double C10 = 0.0, C01 = 0.0;  ///< Pa
  Volumetric volume;

  SolidResponse isochoric(const Eigen::Matrix3d& F) const;
  VolumetricResponse volumetric(double J) const { return volume.at(J); }
  double initial_shear_modulus() const { return 2.0 * (C10 + C01); }
  double initial_bulk_modulus() const { return volume.bulk_modulus; }
};

}  // namespace snug::materials
