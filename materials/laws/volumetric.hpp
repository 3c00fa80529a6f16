// The volumetric energy U(J) of a law with split, in the three forms that finite-element programs use:
//   barrier      U = kappa/4 (J^2 - 1 - 2 ln J)   grows without bound as J -> 0 and as J -> oo, convex
//   logarithmic  U = kappa/2 (ln J)^2             grows without bound, not convex beyond J = e
//   quadratic    U = kappa/2 (J - 1)^2            finite at J = 0: the form of CalculiX, Abaqus and Ansys (kappa =
//   2/D1)
// Source: Simo & Miehe, Comput. Methods Appl. Mech. Engrg. 98 (1992) 41-104 (barrier); Doll & Schweizerhof, J. Appl.
// Mech. 67 (2000) 17-21 (comparison). They agree to first order in J - 1.
#pragma once

#include <cmath>

#include "materials/laws/response.hpp"

namespace snug::materials {

enum class VolumetricForm { barrier, logarithmic, quadratic };

struct Volumetric {
  VolumetricForm form = VolumetricForm::barrier;
  double bulk_modulus = 0.0;  ///< Pa

  /// J > 0 (the caller's duty); the first two forms are not finite at J <= 0.
  VolumetricResponse at(double J) const;
};

// Energies are written in d = J - 1 to keep digits near J = 1.
inline VolumetricResponse Volumetric::at(double J) const {
  const double kappa = bulk_modulus, d = J - 1.0;
  switch (form) {
    case VolumetricForm::logarithmic: {
      const double log = std::log1p(d);
      return {.energy = 0.5 * kappa * log * log, .pressure = kappa * log / J, .modulus = kappa * (1.0 - log) / (J * J)};
    }
    case VolumetricForm::quadratic:
      return {.energy = 0.5 * kappa * d * d, .pressure = kappa * d, .modulus = kappa};
    case VolumetricForm::barrier:
      break;
  }
  return {.energy = 0.25 * kappa * (d * (2.0 + d) - 2.0 * std::log1p(d)),
          .pressure = 0.5 * kappa * (d * (2.0 + d) / J),
          .modulus = 0.5 * kappa * (1.0 + 1.0 / (J * J))};
}

}  // namespace snug::materials
