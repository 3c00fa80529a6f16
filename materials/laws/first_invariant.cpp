#include "materials/laws/first_invariant.hpp"

#include <cmath>

#include "materials/laws/tensor.hpp"

namespace snug::materials {

// With G = F^-T and m = modulus J^(-2/3):
//   P_iJ    = m (F_iJ - I1/3 G_iJ)
//   A_iJ,kL = m (d_ik d_JL - 2/3 (F_iJ G_kL + G_iJ F_kL) + 2/9 I1 G_iJ G_kL + I1/3 G_iL G_kJ)
SolidResponse first_invariant_energy(const Eigen::Matrix3d& F, double modulus) {
  const Eigen::Matrix3d cof = cofactor(F);
  const double J = determinant(F, cof);
  const Eigen::Matrix3d G = cof / J;
  const double root = std::cbrt(J);
  const double m = modulus / (root * root);
  const double first_invariant = F.squaredNorm();
  const double third = first_invariant / 3.0;

  SolidResponse r;
  r.energy = 0.5 * (m * first_invariant - 3.0 * modulus);
  r.stress = m * (F - third * G);
  for (int k = 0; k < 3; ++k)
    for (int L = 0; L < 3; ++L) {
      const double a = -2.0 / 3.0 * m * G(k, L);
      const double b = -2.0 / 3.0 * m * (F(k, L) - third * G(k, L));
      for (int i = 0; i < 3; ++i)
        for (int K = 0; K < 3; ++K)
          r.tangent(3 * i + K, 3 * k + L) = a * F(i, K) + b * G(i, K) + m * third * G(i, L) * G(k, K);
      r.tangent(3 * k + L, 3 * k + L) += m;
    }
  return r;
}

// With q', q'' by F: P = W' q', A = W' q'' + W'' q' (x) q'.
SolidResponse response_of(const FirstInvariantLaw& law, const SolidResponse& q) {
  SolidResponse r;
  const Eigen::Matrix<double, 9, 1> slope = components(q.stress);
  r.energy = law.energy;
  r.stress = law.slope * q.stress;
  r.tangent = law.slope * q.tangent + law.curvature * slope * slope.transpose();
  return r;
}

}  // namespace snug::materials
