#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

#include "materials/laws/solid_law.hpp"
#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::VectorXd;
using materials::NeoHooke;

const double kPa = 1e3;

Matrix3d reference_gradient() {
  Matrix3d F;
  F << 1.1, 0.2, 0.0, 0.05, 0.95, 0.1, 0.0, 0.1, 1.05;
  return F;
}
Matrix3d large_gradient() {
  Matrix3d F;
  F << 1.8, -0.4, 0.3, 0.6, 0.7, 0.2, -0.3, 0.5, 1.4;
  return F;
}
VectorXd packed(const Matrix3d& F) {
  VectorXd x(9);
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) x[3 * i + J] = F(i, J);
  return x;
}
Matrix3d unpacked(const VectorXd& x) {
  Matrix3d F;
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J) F(i, J) = x[3 * i + J];
  return F;
}
template <class Law>
Matrix3d cauchy(const Law& law, const Matrix3d& F) {
  const double J = F.determinant();
  return law.isochoric(F).stress * F.transpose() / J + law.volumetric(J).pressure * Matrix3d::Identity();
}

// The typed test list: one line a law, with parameters of its own.
template <class Law>
Law example();
template <>
NeoHooke example<NeoHooke>() {
  return {.shear_modulus = 10 * kPa, .poisson_ratio = 0.49};
}

template <class Law>
class EverySolidLaw : public ::testing::Test {};
using Laws = ::testing::Types<NeoHooke>;
TYPED_TEST_SUITE(EverySolidLaw, Laws);

TYPED_TEST(EverySolidLaw, StressAndTangentByRate) {
  // Stress and tangent are the first and second derivative of the isochoric energy.
  const TypeParam law = example<TypeParam>();
  for (const Matrix3d& F : {reference_gradient(), large_gradient()}) {
    const auto r = law.isochoric(F);
    const auto energy = [&](const VectorXd& x) { return VectorXd::Constant(1, law.isochoric(unpacked(x)).energy); };
    const auto stress = [&](const VectorXd& x) { return packed(law.isochoric(unpacked(x)).stress); };
    expect_derivative_by_rate(energy, packed(F), packed(r.stress).transpose(), 1e-2);
    expect_derivative_by_rate(stress, packed(F), r.tangent, 1e-2);
  }
}

TYPED_TEST(EverySolidLaw, VolumetricByRate) {
  // U' and U'' are the derivatives of U.
  const TypeParam law = example<TypeParam>();
  for (double J : {0.3, 0.98, 1.0757, 2.0}) {
    const auto r = law.volumetric(J);
    const auto energy = [&](const VectorXd& x) { return VectorXd::Constant(1, law.volumetric(x[0]).energy); };
    const auto pressure = [&](const VectorXd& x) { return VectorXd::Constant(1, law.volumetric(x[0]).pressure); };
    expect_derivative_by_rate(energy, VectorXd::Constant(1, J), MatrixXd::Constant(1, 1, r.pressure), 1e-2 * J);
    expect_derivative_by_rate(pressure, VectorXd::Constant(1, J), MatrixXd::Constant(1, 1, r.modulus), 1e-2 * J);
  }
}

TYPED_TEST(EverySolidLaw, TangentIsMajorSymmetric) {
  // The tangent is a second derivative of a scalar.
  const auto r = example<TypeParam>().isochoric(large_gradient());
  EXPECT_LT((r.tangent - r.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13 * r.tangent.cwiseAbs().maxCoeff());
}

TYPED_TEST(EverySolidLaw, DoesNotSeeRotation) {
  // F -> Q F leaves the energy and turns the stress: sigma -> Q sigma Q^T.
  const TypeParam law = example<TypeParam>();
  const Matrix3d Q = Eigen::AngleAxisd(1.234, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  const Matrix3d F = large_gradient();
  const Matrix3d sigma = cauchy(law, F), turned = cauchy(law, Matrix3d(Q * F));
  EXPECT_NEAR(law.isochoric(Q * F).energy, law.isochoric(F).energy, 1e-13 * law.isochoric(F).energy);
  EXPECT_LT((turned - Q * sigma * Q.transpose()).cwiseAbs().maxCoeff(), 1e-13 * sigma.cwiseAbs().maxCoeff() * 10);
}

TYPED_TEST(EverySolidLaw, DoesNotSeeVolumeInTheIsochoricPart) {
  // W_iso depends on J^(-1/3) F alone, so its Kirchhoff stress has no trace and scaling F changes nothing.
  const TypeParam law = example<TypeParam>();
  const Matrix3d F = large_gradient();
  EXPECT_NEAR(law.isochoric(1.7 * F).energy, law.isochoric(F).energy, 1e-13 * law.isochoric(F).energy);
  const Matrix3d tau = law.isochoric(F).stress * F.transpose();
  EXPECT_NEAR(tau.trace(), 0.0, 1e-13 * tau.norm());
}

TYPED_TEST(EverySolidLaw, RestIsFreeOfStressAndHasTheShearModulus) {
  // At F = 1 nothing is stored, nothing pulls, and simple shear meets the initial shear modulus.
  const TypeParam law = example<TypeParam>();
  const auto r = law.isochoric(Matrix3d::Identity());
  EXPECT_NEAR(r.energy, 0.0, 1e-12);
  EXPECT_NEAR(r.stress.norm(), 0.0, 1e-12);
  EXPECT_NEAR(r.tangent(1, 1), law.shear_modulus, 1e-12 * law.shear_modulus);
  EXPECT_EQ(law.volumetric(1.0).pressure, 0.0);
  EXPECT_NEAR(law.volumetric(1.0).modulus, law.bulk_modulus(), 1e-12 * law.bulk_modulus());
}

TEST(NeoHooke, OnePoint) {
  // Energy and Cauchy stress at a general F: reference book 1.1, row NH-V1 (kPa), to the printed digits.
  const NeoHooke law{.shear_modulus = 10, .poisson_ratio = 0.49};
  const Matrix3d F = reference_gradient();
  EXPECT_NEAR(law.isochoric(F).energy + law.volumetric(F.determinant()).energy, 1.9997818774, 6e-11);
  const Matrix3d s = cauchy(law, F);
  EXPECT_NEAR(s(0, 0), 37.692418638, 6e-10);
  EXPECT_NEAR(s(1, 1), 34.726272468, 6e-10);
  EXPECT_NEAR(s(2, 2), 36.474970583, 6e-10);
  EXPECT_NEAR(s(0, 1), 2.169271080, 6e-10);
  EXPECT_NEAR(s(1, 2), 1.770833535, 6e-10);
  EXPECT_NEAR(s(0, 2), 0.177083353, 6e-10);
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Matrix3d>(s).eigenvalues();
  EXPECT_NEAR(principal[2], 39.24325800, 6e-9);
  EXPECT_NEAR(principal[1], 36.71981655, 6e-9);
  EXPECT_NEAR(principal[0], 32.93058714, 6e-9);
}

struct Homogeneous {
  char mode;  // u: uniaxial, e: equibiaxial, p: planar (l2 = 1)
  double nu, lateral, J, sigma;
};

TEST(NeoHooke, HomogeneousStates) {
  // Stretched to 1.5 with a free side, the side settles where its stress vanishes: reference book 1.3, rows V1.
  const std::vector<Homogeneous> rows = {{'u', 0.3, 0.888406366571, 1.183898808247, 11.0250407590},
                                         {'u', 0.45, 0.836835816989, 1.050441276894, 14.2767590910},
                                         {'u', 0.49, 0.820752471735, 1.010451929789, 15.4928313139},
                                         {'u', 0.499, 0.816926962549, 1.001054493210, 15.7985278862},
                                         {'u', 0.4999, 0.816539668318, 1.000105544905, 15.8298450035},
                                         {'u', 0.49999, 0.816500890160, 1.000010555449, 15.8329844223},
                                         {'e', 0.3, 0.616635923314, 1.387430827456, 10.8334553287},
                                         {'e', 0.45, 0.498081039241, 1.120682338292, 16.5567394610},
                                         {'e', 0.49, 0.456257229604, 1.026578766609, 19.5448486395}};
  for (const Homogeneous& row : rows) {
    const NeoHooke law{.shear_modulus = 10, .poisson_ratio = row.nu};
    const auto stress = [&](double x) {
      const Eigen::Vector3d l = row.mode == 'u' ? Eigen::Vector3d(1.5, x, x) : Eigen::Vector3d(1.5, 1.5, x);
      return cauchy(law, Matrix3d(l.asDiagonal()));
    };
    double low = 0.3, high = 1.2;  // the free side's stress rises with its stretch
    for (int k = 0; k < 100; ++k) {
      const double middle = 0.5 * (low + high);
      (stress(middle)(2, 2) < 0 ? low : high) = middle;
    }
    EXPECT_NEAR(low, row.lateral, 1e-11) << row.mode << row.nu;
    EXPECT_NEAR(stress(low)(0, 0), row.sigma, 1e-9 * std::max(1.0, law.bulk_modulus() / 100)) << row.mode << row.nu;
    EXPECT_NEAR(row.mode == 'u' ? 1.5 * low * low : 2.25 * low, row.J, 1e-11);
  }
}

TEST(NeoHooke, IncompressibleShear) {
  // Simple shear g keeps the volume: tau = mu g, s11 - s22 = mu g^2, s22 = s33 (reference book 1.2).
  const NeoHooke law{.shear_modulus = 10, .poisson_ratio = 0.49};
  for (double g : {0.1, 0.5, 2.0}) {
    Matrix3d F = Matrix3d::Identity();
    F(0, 1) = g;
    const Matrix3d s = cauchy(law, F);
    EXPECT_NEAR(s(0, 1), 10 * g, 1e-12);
    EXPECT_NEAR(s(0, 0) - s(2, 2), 10 * g * g, 1e-11);
    EXPECT_NEAR(s(1, 1) - s(2, 2), 0.0, 1e-12);
  }
}

TEST(NeoHooke, ResistsCollapseWithoutBound) {
  // The volumetric energy is a barrier: it grows beyond all bounds as J goes to zero.
  const NeoHooke law{.shear_modulus = 10, .poisson_ratio = 0.49};
  EXPECT_GT(law.volumetric(1e-8).energy, law.volumetric(1e-4).energy * 1.9);
  EXPECT_LT(law.volumetric(1e-8).pressure, -1e9);
}

}  // namespace
}  // namespace snug::testing
