// Automatic differentiation as an oracle: each law's energy, written here once more from its formula and as plainly as
// can be, differentiated twice by Sacado, against the hand-derived stress and tangent.
#include <gtest/gtest.h>

#include <Sacado_No_Kokkos.hpp>
#include <array>

#include "tests/unit/materials/laws_under_test.hpp"

namespace snug::testing {
namespace {

using First = Sacado::Fad::DFad<double>;
using Second = Sacado::Fad::DFad<First>;
using Tensor = std::array<std::array<Second, 3>, 3>;

struct Invariants {
  Second I1, I2, J;
};

Tensor right_cauchy_green(const Tensor& F) {
  Tensor C;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C[i][j] = F[0][i] * F[0][j] + F[1][i] * F[1][j] + F[2][i] * F[2][j];
  return C;
}
Invariants invariants(const Tensor& F) {
  const Tensor C = right_cauchy_green(F);
  Second I1 = C[0][0] + C[1][1] + C[2][2], square = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) square += C[i][j] * C[i][j];
  const Second J = F[0][0] * (F[1][1] * F[2][2] - F[1][2] * F[2][1]) -
                   F[0][1] * (F[1][0] * F[2][2] - F[1][2] * F[2][0]) +
                   F[0][2] * (F[1][0] * F[2][1] - F[1][1] * F[2][0]);
  return {I1, 0.5 * (I1 * I1 - square), J};
}
// U of the examples: the barrier.
Second barrier(const materials::Volumetric& volume, const Second& J) {
  return 0.25 * volume.bulk_modulus * (J * J - 1.0 - 2.0 * log(J));
}

Second energy(const materials::NeoHooke& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  return 0.5 * law.shear_modulus * (pow(J, -2.0 / 3.0) * I1 - 3.0) + barrier(law.volume, J);
}
Second energy(const materials::MooneyRivlin& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  return law.C10 * (pow(J, -2.0 / 3.0) * I1 - 3.0) + law.C01 * (pow(J, -4.0 / 3.0) * I2 - 3.0) + barrier(law.volume, J);
}
Second energy(const materials::Yeoh& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  const Second x = pow(J, -2.0 / 3.0) * I1 - 3.0;
  return law.C10 * x + law.C20 * x * x + law.C30 * x * x * x + barrier(law.volume, J);
}
Second energy(const materials::ArrudaBoyce& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  const Second I = pow(J, -2.0 / 3.0) * I1;
  const double y = 1.0 / (law.locking_stretch * law.locking_stretch);
  return law.mu * ((I - 3.0) / 2.0 + y / 20.0 * (I * I - 9.0) + y * y * 11.0 / 1050.0 * (I * I * I - 27.0) + y * y * y * 19.0 / 7000.0 * (I * I * I * I - 81.0) +
                   y * y * y * y * 519.0 / 673750.0 * (I * I * I * I * I - 243.0)) +
         barrier(law.volume, J);
}
Second energy(const materials::Fung& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  const Second Q = law.stiffening * (pow(J, -2.0 / 3.0) * I1 - 3.0);
  return 0.5 * law.shear_modulus / law.stiffening * (exp(Q) - 1.0) + barrier(law.volume, J);
}
Second energy(const materials::CompressibleNeoHooke& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  return 0.5 * law.shear_modulus * (I1 - 3.0) - law.shear_modulus * log(J) + 0.5 * law.lame_parameter * log(J) * log(J);
}
Second energy(const materials::LinearElastic& law, const Tensor& F) {
  const Tensor C = right_cauchy_green(F);
  Second trace = 0.0, square = 0.0;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const Second E = 0.5 * (C[i][j] - (i == j ? 1.0 : 0.0));
      square += E * E;
      if (i == j) trace += E;
    }
  const double E = law.youngs_modulus, nu = law.poisson_ratio;
  return 0.5 * E * nu / ((1 + nu) * (1 - 2 * nu)) * trace * trace + 0.5 * E / (1 + nu) * square;
}
// The eigenvalues of C are roots of c^3 - I1 c^2 + I2 c - J^2; Newton steps from the numbers give them their
// derivatives.
Second energy(const materials::Ogden& law, const Tensor& F) {
  const auto [I1, I2, J] = invariants(F);
  Eigen::Matrix3d C;
  const Tensor tensor = right_cauchy_green(F);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) C(i, j) = tensor[i][j].val().val();
  const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(C).eigenvalues();
  Second W = barrier(law.volume, J);
  for (int a = 0; a < 3; ++a) {
    Second c = values[a];
    for (int i = 0; i < 4; ++i) c = c - (((c - I1) * c + I2) * c - J * J) / ((3.0 * c - 2.0 * I1) * c + I2);
    for (const materials::OgdenTerm& term : law.terms)
      W += term.mu / term.alpha * (pow(c * pow(J, -2.0 / 3.0), 0.5 * term.alpha) - 1.0);
  }
  return W;
}

template <class Law>
class OracleOfEveryLaw : public ::testing::Test {};
TYPED_TEST_SUITE(OracleOfEveryLaw, AllLaws);

TYPED_TEST(OracleOfEveryLaw, StressAndTangentAgree) {
  // Energy, stress and tangent are those that automatic differentiation finds from the formula, to rounding.
  const TypeParam law = example<TypeParam>();
  for (const Eigen::Matrix3d& gradient : {reference_gradient(), large_gradient()}) {
    Tensor F;
    for (int i = 0; i < 3; ++i)
      for (int J = 0; J < 3; ++J) {
        F[i][J] = Second(9, 3 * i + J, First(9, 3 * i + J, gradient(i, J)));
      }
    const Second W = energy(law, F);
    const auto r = materials::coupled(materials::SolidLaw(law), gradient);
    const Eigen::VectorXd P = packed(r.stress);
    const double size = r.tangent.cwiseAbs().maxCoeff();
    EXPECT_NEAR(r.energy, W.val().val(), 1e-13 * size);
    for (int a = 0; a < 9; ++a) {
      EXPECT_NEAR(P[a], W.dx(a).val(), 1e-13 * size) << a;
      for (int b = 0; b < 9; ++b) EXPECT_NEAR(r.tangent(a, b), W.dx(a).dx(b), 1e-12 * size) << a << " " << b;
    }
  }
}

}  // namespace
}  // namespace snug::testing
