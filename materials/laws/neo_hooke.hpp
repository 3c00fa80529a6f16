// Neo-Hooke: W = mu/2 (J^(-2/3) I1 - 3) + U(J). The network theory's energy; right for small and moderate stretch.
// Source: Treloar, Trans. Faraday Soc. 39 (1943) 36-41; isochoric split: Simo & Miehe, Comput. Methods Appl. Mech.
// Engrg. 98 (1992) 41-104.
#pragma once

#include "materials/laws/first_invariant.hpp"
#include "materials/laws/volumetric.hpp"

namespace snug::materials {

struct NeoHooke {
  double shear_modulus = 0.0;  ///< Pa
  Volumetric volume;

  SolidResponse isochoric(const Eigen::Matrix3d& F) const { return first_invariant_energy(F, shear_modulus); }
  VolumetricResponse volumetric(double J) const { return volume.at(J); }
  double initial_shear_modulus() const { return shear_modulus; }
  double initial_bulk_modulus() const { return volume.bulk_modulus; }
};

}  // namespace snug::materials
