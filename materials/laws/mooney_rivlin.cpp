#include "materials/laws/mooney_rivlin.hpp"

#include <cmath>

#include "materials/laws/first_invariant.hpp"
#include "materials/laws/tensor.hpp"

namespace snug::materials {

// The second term, with C = F^T F, b = F F^T, G = F^-T, g = C01 J^(-4/3) and H = dI2/dF = 2 (I1 F - F C):
//   P_iJ    = g (H_iJ - 4/3 I2 G_iJ)
//   A_iJ,kL = g (2 (2 F_iJ F_kL + I1 d_ik d_JL - d_ik C_JL - F_iL F_kJ - b_ik d_JL)
//                - 4/3 (H_iJ G_kL + G_iJ H_kL) + I2 (16/9 G_iJ G_kL + 4/3 G_iL G_kJ))
SolidResponse MooneyRivlin::isochoric(const Eigen::Matrix3d& F) const {
  SolidResponse r = first_invariant_energy(F, 2.0 * C10);
  const Eigen::Matrix3d cof = cofactor(F);
  const double J = determinant(F, cof);
  const Eigen::Matrix3d G = cof / J, C = F.transpose() * F, b = F * F.transpose();
  const double root = std::cbrt(J);
  const double g = C01 / (J * root);
  const double I1 = C.trace(), I2 = 0.5 * (I1 * I1 - C.squaredNorm());
  const Eigen::Matrix3d H = 2.0 * (I1 * F - F * C);

  r.energy += g * I2 - 3.0 * C01;
  r.stress += g * (H - 4.0 / 3.0 * I2 * G);
  const Eigen::Matrix<double, 9, 1> f = components(F), h = components(H), n = components(G);
  r.tangent += g * (4.0 * f * f.transpose() - 4.0 / 3.0 * (h * n.transpose() + n * h.transpose()) +
                    16.0 / 9.0 * I2 * n * n.transpose());
  add_geometric(r.tangent, 2.0 * g * (I1 * Eigen::Matrix3d::Identity() - C));
  add_swapped(r.tangent, -2.0 * g, F);
  add_swapped(r.tangent, 4.0 / 3.0 * g * I2, G);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      for (int J = 0; J < 3; ++J) r.tangent(3 * i + J, 3 * k + J) -= 2.0 * g * b(i, k);
  return r;
}

}  // namespace snug::materials
