#include "materials/laws/yeoh.hpp"

#include "materials/laws/first_invariant.hpp"
#include "materials/laws/tensor.hpp"

namespace snug::materials {

// With q = (J^(-2/3) I1 - 3)/2, its first and second derivative q', q'' by F and x = 2 q:
//   P = w q', A = w q'' + w' q' (x) q', w = dW/dq = 2 C10 + 8 C20 q + 24 C30 q^2, w' = 8 C20 + 48 C30 q.
SolidResponse Yeoh::isochoric(const Eigen::Matrix3d& F) const {
  SolidResponse r = first_invariant_energy(F, 1.0);
  const double q = r.energy;
  const double w = 2.0 * C10 + q * (8.0 * C20 + 24.0 * C30 * q), slope_of_w = 8.0 * C20 + 48.0 * C30 * q;
  const Eigen::Matrix<double, 9, 1> slope = components(r.stress);
  r.energy = q * (2.0 * C10 + q * (4.0 * C20 + 8.0 * C30 * q));
  r.stress *= w;
  r.tangent = w * r.tangent + slope_of_w * slope * slope.transpose();
  return r;
}

}  // namespace snug::materials
