// Arruda-Boyce: W = mu sum_i C_i / lambda_m^(2 i - 2) (I^i - 3^i) + U(J), I = J^(-2/3) I1, i = 1 ... 5: eight chains in a cube whose stretch has the limit
// lambda_m; the series of the inverse Langevin function, C = 1/2, 1/20, 11/1050, 19/7000, 519/673750. A large lambda_m is neo-Hooke.
// Source: Arruda & Boyce, J. Mech. Phys. Solids 41 (1993) 389-412.
#pragma once

#include "materials/laws/response.hpp"
#include "materials/laws/volumetric.hpp"

namespace snug::materials {

struct ArrudaBoyce {
  double mu = 0.0;               ///< Pa; less than the initial shear modulus
  double locking_stretch = 0.0;  ///< lambda_m
  Volumetric volume;

  SolidResponse isochoric(const Eigen::Matrix3d& F) const;
  VolumetricResponse volumetric(double J) const { return volume.at(J); }
  double initial_shear_modulus() const;
  double initial_bulk_modulus() const { return volume.bulk_modulus; }
};

}  // namespace snug::materials
