// Yeoh: W = C10 x + C20 x^2 + C30 x^3 + U(J), x = J^(-2/3) I1 - 3: stiffens with stretch (skin, muscle) with three constants of
// one invariant. C20 = C30 = 0 is neo-Hooke with mu = 2 C10. Source: Yeoh, Rubber Chem. Technol. 66 (1993) 754-771.
#pragma once

#include "materials/laws/response.hpp"
#include "materials/laws/volumetric.hpp"

namespace snug::materials {

struct Yeoh {
  double C10 = 0.0, C20 = 0.0, C30 = 0.0;  ///< Pa
  Volumetric volume;

  SolidResponse isochoric(const Eigen::Matrix3d& F) const;
  VolumetricResponse volumetric(double J) const { return volume.at(J); }
  double initial_shear_modulus() const { return 2.0 * C10; }
  double initial_bulk_modulus() const { return volume.bulk_modulus; }
};

}  // namespace snug::materials
