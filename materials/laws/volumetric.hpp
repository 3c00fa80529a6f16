// The volumetric energy U(J) of a law with split, in the three forms that finite-element programs use:
//   barrier      U = kappa/4 (J^2 - 1 - 2 ln J)   grows without bound as J -> 0 and as J -> oo, convex
//   logarithmic  U = kappa/2 (ln J)^2             grows without bound, not convex beyond J = e
//   quadratic    U = kappa/2 (J - 1)^2            finite at J = 0: the form of CalculiX, Abaqus and Ansys (kappa =
//   2/D1)
// Source: Simo & Miehe, Comput. Methods Appl. Mech. Engrg. 98 (1992) 41-104 (barrier); Doll & Schweizerhof, J. Appl.
// Mech. 67 (2000) 17-21 (comparison). They agree to first order in J - 1.
#pragma once

#include "materials/laws/response.hpp"

namespace snug::materials {

enum class VolumetricForm { barrier, logarithmic, quadratic };

struct Volumetric {
  VolumetricForm form = VolumetricForm::barrier;
  double bulk_modulus = 0.0;  ///< Pa

  /// J > 0 (the caller's duty); the first two forms are not finite at J <= 0.
  VolumetricResponse at(double J) const;
};

}  // namespace snug::materials
