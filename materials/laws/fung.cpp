#include "materials/laws/fung.hpp"

#include <cmath>

#include "materials/laws/first_invariant.hpp"
#include "materials/laws/tensor.hpp"

namespace snug::materials {

// With q = (J^(-2/3) I1 - 3)/2, its first and second derivative q', q'' by F and e = mu exp(2 b q):
//   W = mu/(2 b) (exp(2 b q) - 1),  P = e q',  A = e (q'' + 2 b q' (x) q').
SolidResponse Fung::isochoric(const Eigen::Matrix3d& F) const {
  SolidResponse r = first_invariant_energy(F, 1.0);
  const double growth = std::expm1(2.0 * stiffening * r.energy);
  const double e = shear_modulus * (growth + 1.0);
  const Eigen::Matrix<double, 9, 1> slope = components(r.stress);
  r.energy = 0.5 * shear_modulus / stiffening * growth;
  r.stress *= e;
  r.tangent = e * (r.tangent + 2.0 * stiffening * slope * slope.transpose());
  return r;
}

}  // namespace snug::materials
