#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "materials/laws/solid_law.hpp"
#include "tests/unit/materials/laws_under_test.hpp"
#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::VectorXd;
using materials::coupled, materials::SolidLaw, materials::Volumetric, materials::VolumetricForm;

double largest(const MatrixXd& m) { return m.cwiseAbs().maxCoeff(); }

std::vector<Matrix3d> gradients() {
  return {reference_gradient(), large_gradient(), equal_stretches(0.7), equal_stretches(1.2),
          equal_stretches(1.2 + 1e-9)};
}

template <class Law>
class EveryLaw : public ::testing::Test {};
TYPED_TEST_SUITE(EveryLaw, AllLaws);
template <class Law>
class EverySplitLaw : public ::testing::Test {};
TYPED_TEST_SUITE(EverySplitLaw, SplitLaws);

TYPED_TEST(EveryLaw, StressAndTangentByRate) {
  // Stress and tangent are the first and second derivative of the energy, at equal principal stretches too.
  const SolidLaw law = example<TypeParam>();
  for (const Matrix3d& F : gradients()) {
    const auto r = coupled(law, F);
    const auto energy = [&](const VectorXd& x) { return VectorXd::Constant(1, coupled(law, unpacked(x)).energy); };
    const auto stress = [&](const VectorXd& x) { return packed(coupled(law, unpacked(x)).stress); };
    expect_derivative_by_rate(energy, packed(F), packed(r.stress).transpose(), 1e-2);
    expect_derivative_by_rate(stress, packed(F), r.tangent, 1e-2);
  }
}

TYPED_TEST(EveryLaw, TangentIsMajorSymmetric) {
  // The tangent is a second derivative of a scalar.
  for (const Matrix3d& F : gradients()) {
    const auto r = coupled(example<TypeParam>(), F);
    EXPECT_LT(largest(r.tangent - r.tangent.transpose()), 1e-13 * largest(r.tangent));
  }
}

TYPED_TEST(EveryLaw, DoesNotSeeRotation) {
  // F -> Q F leaves the energy and turns the stress: sigma -> Q sigma Q^T, to 1e-13 of the moduli the stress is made
  // of.
  const SolidLaw law = example<TypeParam>();
  const Matrix3d Q = Eigen::AngleAxisd(1.234, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  for (const Matrix3d& F : gradients()) {
    const double size = initial_bulk_modulus(law);
    const Matrix3d sigma = cauchy(law, F), turned = cauchy(law, Matrix3d(Q * F));
    EXPECT_NEAR(coupled(law, Q * F).energy, coupled(law, F).energy, 1e-13 * size);
    EXPECT_LT(largest(turned - Q * sigma * Q.transpose()), 1e-13 * std::max(size, largest(sigma)));
  }
}

TYPED_TEST(EveryLaw, IsIsotropic) {
  // F -> F Q changes neither energy nor Cauchy stress.
  const SolidLaw law = example<TypeParam>();
  const Matrix3d Q = Eigen::AngleAxisd(-0.7, Eigen::Vector3d(2, 1, 0.5).normalized()).toRotationMatrix();
  const Matrix3d F = large_gradient(), sigma = cauchy(law, F);
  EXPECT_LT(largest(cauchy(law, Matrix3d(F * Q)) - sigma), 1e-13 * std::max(initial_bulk_modulus(law), largest(sigma)));
}

TYPED_TEST(EveryLaw, RestIsFreeOfStressAndHasTheModuli) {
  // At F = 1 nothing is stored, nothing pulls, and the tangent is isotropic linear elasticity with mu and kappa:
  // A_ijkl = (kappa - 2/3 mu) d_ij d_kl + mu (d_ik d_jl + d_il d_jk).
  const SolidLaw law = example<TypeParam>();
  const double mu = initial_shear_modulus(law), kappa = initial_bulk_modulus(law);
  EXPECT_NEAR(mu, 10e3, 1e-9);
  EXPECT_NEAR(kappa, 1490e3 / 3, 1e-8);
  EXPECT_NEAR(initial_youngs_modulus(law), 29.8e3, 1e-8);
  const auto r = coupled(law, Matrix3d::Identity());
  EXPECT_NEAR(r.energy, 0.0, 1e-15 * kappa);
  EXPECT_NEAR(largest(r.stress), 0.0, 1e-15 * kappa);
  Eigen::Matrix<double, 9, 9> hooke;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k)
        for (int l = 0; l < 3; ++l)
          hooke(3 * i + j, 3 * k + l) =
              (kappa - 2.0 / 3.0 * mu) * (i == j) * (k == l) + mu * ((i == k) * (j == l) + (i == l) * (j == k));
  EXPECT_LT(largest(r.tangent - hooke), 1e-14 * kappa);
}

TYPED_TEST(EveryLaw, ResistsCollapse) {
  // Squeezed towards J = 0 a law pushes back ever harder: energy and pressure grow without bound. The linear law has no
  // such barrier, as its page says: its energy stays below the value at J = 0, 9/8 kappa (E = -1/2).
  const SolidLaw law = example<TypeParam>();
  const auto squeezed = [&](double J) { return Matrix3d(std::cbrt(J) * Matrix3d::Identity()); };
  if (std::holds_alternative<materials::LinearElastic>(law)) {
    EXPECT_NEAR(coupled(law, squeezed(1e-30)).energy, 9.0 / 8.0 * initial_bulk_modulus(law),
                1e-9 * initial_bulk_modulus(law));
    return;
  }
  EXPECT_GT(coupled(law, squeezed(1e-8)).energy, 1.9 * coupled(law, squeezed(1e-4)).energy);
  EXPECT_LT(cauchy(law, squeezed(1e-8))(0, 0), 1e3 * cauchy(law, squeezed(1e-4))(0, 0));
  EXPECT_LT(cauchy(law, squeezed(1e-4))(0, 0), 0.0);
}

TYPED_TEST(EverySplitLaw, IsochoricPartByRate) {
  // The isochoric part alone has the derivatives it says, and depends on J^(-1/3) F only: scaling changes nothing, and
  // its Kirchhoff stress has no trace.
  const TypeParam law = example<TypeParam>();
  for (const Matrix3d& F : gradients()) {
    const auto r = law.isochoric(F);
    const auto energy = [&](const VectorXd& x) { return VectorXd::Constant(1, law.isochoric(unpacked(x)).energy); };
    const auto stress = [&](const VectorXd& x) { return packed(law.isochoric(unpacked(x)).stress); };
    expect_derivative_by_rate(energy, packed(F), packed(r.stress).transpose(), 1e-2);
    expect_derivative_by_rate(stress, packed(F), r.tangent, 1e-2);
    EXPECT_LT(largest(r.tangent - r.tangent.transpose()), 1e-13 * largest(r.tangent));
    EXPECT_NEAR(law.isochoric(1.7 * F).energy, r.energy, 1e-13 * std::max(r.energy, law.initial_shear_modulus()));
    EXPECT_NEAR((r.stress * F.transpose()).trace(), 0.0,
                1e-13 * std::max(r.stress.norm(), law.initial_shear_modulus()));
  }
}

TYPED_TEST(EverySplitLaw, AnswersItsParts) {
  // A law with split says so and gives its parts through the variant.
  const SolidLaw law = example<TypeParam>();
  EXPECT_TRUE(is_split(law));
  const Matrix3d F = reference_gradient();
  EXPECT_NEAR(isochoric(law, F).energy + volumetric(law, F.determinant()).energy, coupled(law, F).energy, 1e-9);
}

TEST(LawsWithoutSplit, RefuseTheParts) {
  // Asking one for a part it does not have is a fault of the program, not a silent zero.
  const SolidLaw law = example<materials::LinearElastic>();
  EXPECT_FALSE(is_split(law));
  EXPECT_THROW(isochoric(law, Matrix3d::Identity()), std::logic_error);
  EXPECT_THROW(volumetric(law, 1.0), std::logic_error);
}

TEST(Volumetric, ByRate) {
  // U' and U'' are the derivatives of U, in every form; at J = 1 U'' is the bulk modulus.
  for (auto form : {VolumetricForm::barrier, VolumetricForm::logarithmic, VolumetricForm::quadratic}) {
    const Volumetric law{form, 497e3};
    for (double J : {0.3, 0.98, 1.0757, 2.0}) {
      const auto r = law.at(J);
      const auto energy = [&](const VectorXd& x) { return VectorXd::Constant(1, law.at(x[0]).energy); };
      const auto pressure = [&](const VectorXd& x) { return VectorXd::Constant(1, law.at(x[0]).pressure); };
      expect_derivative_by_rate(energy, VectorXd::Constant(1, J), MatrixXd::Constant(1, 1, r.pressure), 1e-2 * J);
      expect_derivative_by_rate(pressure, VectorXd::Constant(1, J), MatrixXd::Constant(1, 1, r.modulus), 1e-2 * J);
    }
    EXPECT_EQ(law.at(1.0).pressure, 0.0);
    EXPECT_NEAR(law.at(1.0).modulus, 497e3, 1e-9);
  }
}

TEST(Fung, BecomesNeoHookeWithoutStiffening) {
  // b -> 0 leaves neo-Hooke (difference of order b).
  const materials::Fung fung{.shear_modulus = 10e3, .stiffening = 1e-10, .volume = example_volume};
  const auto a = coupled(SolidLaw(fung), large_gradient());
  const auto b = coupled(SolidLaw(example<materials::NeoHooke>()), large_gradient());
  EXPECT_LT(largest(a.tangent - b.tangent), 1e-8 * largest(b.tangent));
}

TEST(Yeoh, IsNeoHookeWithItsFirstConstantAlone) {
  // C20 = C30 = 0 leaves mu = 2 C10; in simple tension the stress is 2 (l^2 - 1/l) (C10 + 2 C20 x + 3 C30 x^2), x = l^2 + 2/l - 3.
  const materials::Yeoh plain{.C10 = 5e3, .C20 = 0.0, .C30 = 0.0, .volume = example_volume};
  const auto a = coupled(SolidLaw(plain), large_gradient()), b = coupled(SolidLaw(example<materials::NeoHooke>()), large_gradient());
  EXPECT_LT(largest(a.tangent - b.tangent), 1e-13 * largest(b.tangent));
  const double stretch = 1.7, x = stretch * stretch + 2.0 / stretch - 3.0;
  const Matrix3d F = Eigen::Vector3d(stretch, 1.0 / std::sqrt(stretch), 1.0 / std::sqrt(stretch)).asDiagonal();
  const auto yeoh = example<materials::Yeoh>();
  const Matrix3d cauchy = yeoh.isochoric(F).stress * F.transpose();  // the pressure that keeps the volume is the same all round
  EXPECT_NEAR(cauchy(0, 0) - cauchy(1, 1), 2.0 * (stretch * stretch - 1.0 / stretch) * (yeoh.C10 + 2.0 * yeoh.C20 * x + 3.0 * yeoh.C30 * x * x), 1e-9);
}

TEST(ArrudaBoyce, IsNeoHookeWithLongChainsAndStiffensTowardsTheirLength) {
  // lambda_m -> infinity leaves neo-Hooke with mu; at rest mu is not the shear modulus, mu (1 + 3/(5 m^2) + ...) is (Abaqus, Theory Guide 4.6.1). In simple tension
  // the stress of chains follows the inverse Langevin function up to what the series of five terms leaves out: L^-1(z) by Newton's method, sigma1 - sigma2 =
  // mu m/3 L^-1(l_c/m)/l_c (l^2 - 1/l), l_c = sqrt(I1/3) the stretch of the chains, 0.41 of m here.
  const materials::ArrudaBoyce loose{.mu = 10e3, .locking_stretch = 1e7, .volume = example_volume};
  const auto a = coupled(SolidLaw(loose), large_gradient()), b = coupled(SolidLaw(example<materials::NeoHooke>()), large_gradient());
  EXPECT_LT(largest(a.tangent - b.tangent), 1e-12 * largest(b.tangent));
  const double m2 = 1.6 * 1.6;
  EXPECT_NEAR((materials::ArrudaBoyce{.mu = 8e3, .locking_stretch = 1.6, .volume = example_volume}.initial_shear_modulus()),
              8e3 * (1 + 3 / (5 * m2) + 99 / (175 * m2 * m2) + 513 / (875 * m2 * m2 * m2) + 42039 / (67375 * m2 * m2 * m2 * m2)), 1e-9);
  const materials::ArrudaBoyce chains{.mu = 8e3, .locking_stretch = 3.0, .volume = example_volume};
  const double stretch = 1.9, chain = std::sqrt((stretch * stretch + 2.0 / stretch) / 3.0), z = chain / 3.0;
  double beta = 3.0 * z;
  for (int n = 0; n < 30; ++n) beta -= (1.0 / std::tanh(beta) - 1.0 / beta - z) / (1.0 / (beta * beta) - 1.0 / (std::sinh(beta) * std::sinh(beta)));
  const Matrix3d F = Eigen::Vector3d(stretch, 1.0 / std::sqrt(stretch), 1.0 / std::sqrt(stretch)).asDiagonal();
  const Matrix3d cauchy = chains.isochoric(F).stress * F.transpose();
  const double exact = 8e3 * 3.0 / 3.0 * beta / chain * (stretch * stretch - 1.0 / stretch);
  EXPECT_NEAR(cauchy(0, 0) - cauchy(1, 1), exact, 1e-3 * exact);
  EXPECT_GT(exact, 1.1 * 8e3 * (stretch * stretch - 1.0 / stretch));
}

TEST(Ogden, OneTermOfTwoIsNeoHooke) {
  // alpha = 2, mu_1 = mu is neo-Hooke; alpha = 2 and -2 with 2 C10 and -2 C01 is Mooney-Rivlin: stress and tangent.
  for (const Matrix3d& F : gradients()) {
    const materials::Ogden one{.terms = {{10e3, 2.0}}, .volume = example_volume};
    const materials::Ogden two{.terms = {{8e3, 2.0}, {-2e3, -2.0}}, .volume = example_volume};
    const auto neo_hooke = example<materials::NeoHooke>().isochoric(F);
    const auto mooney_rivlin = example<materials::MooneyRivlin>().isochoric(F);
    EXPECT_LT(largest(one.isochoric(F).stress - neo_hooke.stress), 1e-13 * 10e3);
    EXPECT_LT(largest(one.isochoric(F).tangent - neo_hooke.tangent), 1e-12 * 10e3);
    EXPECT_LT(largest(two.isochoric(F).stress - mooney_rivlin.stress), 1e-13 * 10e3);
    EXPECT_LT(largest(two.isochoric(F).tangent - mooney_rivlin.tangent), 1e-12 * 10e3);
  }
}

}  // namespace
}  // namespace snug::testing
