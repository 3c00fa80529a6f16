#include "materials/fabric/packing.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <random>

#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using Eigen::Vector3d;
using materials::MembraneResponse;

MembraneResponse packing(const Vector3d& strain, double stiffness = 200.0) {
  MembraneResponse response;
  materials::add_packing(strain, stiffness, response);
  return response;
}

TEST(Packing, NothingResistsAboveNineTenthsOfTheArea) {
  // Cloth that keeps 0.9 of its area is left alone, however it is stretched and sheared; at less it pushes back.
  for (const Vector3d& strain : {Vector3d(0.0, 0.0, 0.0), Vector3d(0.3, -0.2, 0.0), Vector3d(0.05, 0.05, 0.6), Vector3d(-0.09, 0.0, 0.0)}) {
    EXPECT_EQ(packing(strain).energy, 0.0) << strain.transpose();
    EXPECT_EQ(packing(strain).force.norm(), 0.0) << strain.transpose();
  }
  EXPECT_GT(packing({-0.1, 0.0, 0.0}).energy, 0.0);   // J = 0.894
  EXPECT_LT(packing({-0.1, 0.0, 0.0}).force[0], 0.0);
}

TEST(Packing, ForceAndStiffnessAreTheDerivativesOfTheEnergy) {
  // By rate, at strains with shear and with one side stretched.
  for (const Vector3d& strain : {Vector3d(-0.2, -0.1, 0.05), Vector3d(-0.42, 0.1, -0.2), Vector3d(-0.3, -0.3, 0.1)}) {
    const MembraneResponse r = packing(strain);
    expect_derivative_by_rate([](const Eigen::VectorXd& e) { return Eigen::VectorXd::Constant(1, packing(e).energy); }, strain, r.force.transpose(), 1e-3);
    expect_derivative_by_rate([](const Eigen::VectorXd& e) -> Eigen::VectorXd { return packing(e).force; }, strain, r.tangent, 1e-3);
  }
}

TEST(Packing, IsConvexInTheStrain) {
  // The tangent has no negative eigenvalue at any of a thousand strains drawn by lot.
  std::mt19937 random(1);
  std::uniform_real_distribution<double> normal(-0.48, 0.2), shear(-0.3, 0.3);
  int resists = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3d strain(normal(random), normal(random), shear(random));
    if ((1.0 + 2.0 * strain[0]) * (1.0 + 2.0 * strain[1]) - strain[2] * strain[2] <= 1e-4) continue;
    const MembraneResponse r = packing(strain);
    const Eigen::Vector3d values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(r.tangent).eigenvalues();
    EXPECT_GE(values[0], -1e-12 * std::max(1.0, values[2])) << strain.transpose();
    resists += r.energy > 0.0;
  }
  EXPECT_GT(resists, 500);
}

TEST(Packing, BearsWhatFoldsOfSomeTenMillimetresBear) {
  // A knit of 200 N/m gathered to half its length: k (J0 - J)^2 (2 J + J0) / (3 J0 J^2) = 0.90 N/m across the gathers, and 0.03 N/m at four
  // fifths; a fold of 13 mm of cloth of 3e-6 N m buckles at 4 pi^2 B / length^2 = 0.70 N/m.
  const auto across = [](double stretch) {  // force per width as worn: S11 times the stretch
    return packing({0.5 * (stretch * stretch - 1.0), 0.0, 0.0}).force[0] * stretch;
  };
  EXPECT_NEAR(across(0.5), -2.0 * 0.4 * 0.4 * (2.0 * 0.5 + 0.9) / (3.0 * 0.9 * 0.5 * 0.5), 1e-12);
  EXPECT_NEAR(across(0.8), -0.0289, 1e-4);
}

}  // namespace
}  // namespace snug::testing
