#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <cmath>
#include <random>

#include "materials/fabric/inputs.hpp"
#include "tests/unit/materials/fabrics_under_test.hpp"

namespace snug::testing {
namespace {

using Eigen::Matrix2d, Eigen::Vector3d;
using materials::Fabric, materials::TensionCurve;

// Reference book 2.7: E1 = 1000, E2 = 300, G = 50 N/m, nu12 = 0.3.
Fabric off_axis_fabric() {
  return fabric(TensionCurve::linear(1027.749229188078), TensionCurve::linear(308.3247687564234), 0.3, 50);
}

TEST(Fabric, UnrelaxedIsConvex) {
  // The Hessian of the energy is positive definite for every strain, with the coupling of warp and weft.
  std::mt19937 random(11);
  for (const auto& [name, f] : all_fabrics())
    for (int k = 0; k < 2000; ++k) {
      const auto r = f.unrelaxed(random_strain(random, 1.0));
      ASSERT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(r.tangent).eigenvalues()[0], 0.0) << name;
    }
}

TEST(Fabric, TheSofterDirectionGivesTheCoupling) {
  // As a case writes it: with the stiffer one, half of 1000 N/m against 1000 and 100 N/m, energy would be gained by stretching.
  const materials::LinearFabric written{.warp = 1000.0, .weft = 100.0, .shear = 30.0, .sheet = {.poisson = 0.5}};
  EXPECT_EQ(written.fabric().coupling, 50.0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(written.fabric().unrelaxed(Vector3d::Zero()).tangent).eigenvalues()[0], 0.0);
}

TEST(Fabric, OffAxisStiffness) {
  // An orthotropic strip pulled at an angle to the warp has the small-strain modulus of reference book 2.7.
  const Eigen::Matrix3d compliance = off_axis_fabric().unrelaxed(Vector3d::Zero()).tangent.inverse();
  const double rows[][2] = {
      {0, 1000}, {15, 476.6511567527}, {30, 226.8431001890}, {45, 168.5393258427}, {75, 242.7952745455}, {90, 300}};
  for (const auto& [degrees, modulus] : rows) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    const Vector3d M(c * c, s * s, c * s);
    EXPECT_NEAR(1 / M.dot(compliance * M), modulus, 1e-9) << degrees;
  }
}

TEST(Fabric, FiniteStrainOffAxis) {
  // First Piola-Kirchhoff line forces under a prescribed F with the warp turned by theta: reference book 2.7.
  const Fabric f = off_axis_fabric();
  struct Row {
    double theta;
    Matrix2d F, P;
  };
  const auto matrix = [](double a, double b, double c, double d) { return (Matrix2d() << a, b, c, d).finished(); };
  for (const Row& row :
       {Row{0, matrix(1.2, 0, 0, 1), matrix(271.32579651, 0, 0, 20.34943474)},
        Row{45, matrix(1.2, 0, 0, 1), matrix(113.59054471, 47.48201439, 39.56834532, 72.65878726)},
        Row{30, matrix(1.1, 0.2, 0.05, 0.95), matrix(163.22787282, 102.55132978, 89.32389212, 36.64437801)}}) {
    const double c = std::cos(row.theta * M_PI / 180), s = std::sin(row.theta * M_PI / 180);
    const Matrix2d R = matrix(c, -s, s, c);  // columns: warp, weft
    const Matrix2d E = R.transpose() * 0.5 * (row.F.transpose() * row.F - Matrix2d::Identity()) * R;
    const auto r = f.unrelaxed({E(0, 0), E(1, 1), 2 * E(0, 1)});
    const Matrix2d S = R * matrix(r.force[0], r.force[2], r.force[2], r.force[1]) * R.transpose();
    EXPECT_LT((row.F * S - row.P).cwiseAbs().maxCoeff(), 6e-9) << row.theta;
  }
}

}  // namespace
}  // namespace snug::testing
