#include "materials/laws/yeoh.hpp"

#include "materials/laws/first_invariant.hpp"

namespace snug::materials {

// With q = (J^(-2/3) I1 - 3)/2 and x = 2 q: W = 2 C10 q + 4 C20 q^2 + 8 C30 q^3.
SolidResponse Yeoh::isochoric(const Eigen::Matrix3d& F) const {
  const SolidResponse at = first_invariant_energy(F, 1.0);
  const double q = at.energy;
  return response_of({.energy = q * (2.0 * C10 + q * (4.0 * C20 + 8.0 * C30 * q)),
                      .slope = 2.0 * C10 + q * (8.0 * C20 + 24.0 * C30 * q),
                      .curvature = 8.0 * C20 + 48.0 * C30 * q},
                     at);
}

}  // namespace snug::materials
