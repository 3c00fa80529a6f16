// The energy m/2 (J^(-2/3) I1 - 3): all of neo-Hooke, a part of Mooney-Rivlin, the argument of Fung.
#pragma once

#include "materials/laws/response.hpp"

namespace snug::materials {

/// `modulus` in Pa; F: deformation gradient with det F > 0.
SolidResponse first_invariant_energy(const Eigen::Matrix3d& F, double modulus);

}  // namespace snug::materials
