// Neo-Hookean tissue: W = mu/2 (J^(-2/3) I1 - 3) + kappa/4 (J^2 - 1 - 2 ln J), a barrier as J -> 0.
// Source: Simo & Miehe, Comput. Methods Appl. Mech. Engrg. 98 (1992) 41-104; reference book law V1.
// Defined in the header because an element calls it at every quadrature point of every iteration.
#pragma once

#include <cmath>

#include "cases/input/field.hpp"
#include "materials/laws/response.hpp"

namespace snug::materials {

struct NeoHooke {
  double shear_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.49;

  /// Pa.
  double bulk_modulus() const {
    return 2.0 * shear_modulus * (1.0 + poisson_ratio) / (3.0 * (1.0 - 2.0 * poisson_ratio));
  }
  /// F: deformation gradient with det F > 0 (the caller's duty: steps are bounded before inversion).
  IsochoricResponse isochoric(const Eigen::Matrix3d& F) const;
  /// J > 0; at J <= 0 the energy is not finite.
  VolumetricResponse volumetric(double J) const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "shear_modulus",
                .unit = "Pa",
                .meaning = "initial shear modulus",
                .required = true,
                .bound = positive()},
          self.shear_modulus);
    field(Field{.key = "poisson_ratio",
                .meaning = "initial Poisson ratio",
                .bound = {.low = 0.0, .high = 0.5, .high_open = true}},
          self.poisson_ratio);
  }
};

/// Matrix of cofactors J F^-T.
inline Eigen::Matrix3d cofactor(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d c;
  c << F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1), F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2),
      F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0), F(2, 1) * F(0, 2) - F(2, 2) * F(0, 1),
      F(2, 2) * F(0, 0) - F(2, 0) * F(0, 2), F(2, 0) * F(0, 1) - F(2, 1) * F(0, 0),
      F(0, 1) * F(1, 2) - F(0, 2) * F(1, 1), F(0, 2) * F(1, 0) - F(0, 0) * F(1, 2),
      F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
  return c;
}

// With G = F^-T and m = mu J^(-2/3):
//   P_iJ    = m (F_iJ - I1/3 G_iJ)
//   A_iJ,kL = m (d_ik d_JL - 2/3 (F_iJ G_kL + G_iJ F_kL) + 2/9 I1 G_iJ G_kL + I1/3 G_iL G_kJ)
inline IsochoricResponse NeoHooke::isochoric(const Eigen::Matrix3d& F) const {
  const Eigen::Matrix3d cof = cofactor(F);
  const double J = F.row(0).dot(cof.row(0));
  const Eigen::Matrix3d G = cof / J;
  const double root = std::cbrt(J);
  const double m = shear_modulus / (root * root);
  const double first_invariant = F.squaredNorm();
  const double third = first_invariant / 3.0;

  IsochoricResponse r;
  r.energy = 0.5 * (m * first_invariant - 3.0 * shear_modulus);
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

// U' = kappa/2 (J - 1/J), U'' = kappa/2 (1 + 1/J^2); the energy is written in d = J - 1 to keep digits near J = 1.
inline VolumetricResponse NeoHooke::volumetric(double J) const {
  const double kappa = bulk_modulus();
  const double d = J - 1.0;
  return {.energy = 0.25 * kappa * (d * (2.0 + d) - 2.0 * std::log1p(d)),
          .pressure = 0.5 * kappa * (J - 1.0 / J),
          .modulus = 0.5 * kappa * (1.0 + 1.0 / (J * J))};
}

}  // namespace snug::materials
