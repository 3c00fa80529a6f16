#include <gtest/gtest.h>

#include "materials/laws/skin_membrane.hpp"
#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using Eigen::Vector3d, Eigen::VectorXd;
using materials::SkinMembrane;

const SkinMembrane skin{.shear_modulus = 8e3, .thickness = 1.5e-3};

Vector3d metric(const VectorXd& E) { return {1 + 2 * E[0], 1 + 2 * E[1], E[2]}; }

TEST(SkinMembrane, ForceAndTangentByRate) {
  // Force and tangent are the derivatives of the energy by E11, E22 and 2 E12.
  for (const Vector3d& E : {Vector3d(0.2, -0.1, 0.15), Vector3d(1.0, 0.4, -0.8), Vector3d(-0.2, -0.15, 0.1)}) {
    const auto r = skin.at(metric(E));
    const auto energy = [](const VectorXd& x) { return VectorXd::Constant(1, skin.at(metric(x)).energy); };
    const auto force = [](const VectorXd& x) -> VectorXd { return skin.at(metric(x)).force; };
    expect_derivative_by_rate(energy, E, r.force.transpose(), 1e-3);
    expect_derivative_by_rate(force, E, r.tangent, 1e-3);
    EXPECT_LT((r.tangent - r.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13 * r.tangent.norm());
  }
}

TEST(SkinMembrane, IncompressibleClosedForms) {
  // Nominal stress of incompressible neo-Hooke in plane stress: equibiaxial mu (l - l^-5), planar mu (l - l^-3) and
  // mu (1 - l^-2) along the held side (reference book 1.2), times the thickness.
  const double k = skin.shear_modulus * skin.thickness;
  for (double l : {0.8, 1.1, 1.5, 2.0}) {
    const auto both = skin.at({l * l, l * l, 0});
    EXPECT_NEAR(l * both.force[0], k * (l - std::pow(l, -5)), 1e-12 * k);
    EXPECT_NEAR(l * both.force[1], k * (l - std::pow(l, -5)), 1e-12 * k);
    const auto planar = skin.at({l * l, 1, 0});
    EXPECT_NEAR(l * planar.force[0], k * (l - std::pow(l, -3)), 1e-12 * k);
    EXPECT_NEAR(planar.force[1], k * (1 - std::pow(l, -2)), 1e-12 * k);
  }
}

}  // namespace
}  // namespace snug::testing
