// The energy m/2 (J^(-2/3) I1 - 3): all of neo-Hooke, a part of Mooney-Rivlin, the argument of Yeoh, Arruda-Boyce and Fung.
#pragma once

#include "materials/laws/response.hpp"

namespace snug::materials {

/// `modulus` in Pa; F: deformation gradient with det F > 0.
SolidResponse first_invariant_energy(const Eigen::Matrix3d& F, double modulus);

/// W, dW/dq and d2W/dq2, Pa, of a law that knows q = (J^(-2/3) I1 - 3)/2 alone.
struct FirstInvariantLaw {
  double energy = 0.0, slope = 0.0, curvature = 0.0;
};

/// The response to F of such a law; `q`: what first_invariant_energy(F, 1) gives, its energy the place of the law.
SolidResponse response_of(const FirstInvariantLaw& law, const SolidResponse& q);

}  // namespace snug::materials
