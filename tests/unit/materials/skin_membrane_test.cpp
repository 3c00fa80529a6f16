#include <gtest/gtest.h>

#include "materials/laws/skin_membrane.hpp"
#include "tests/unit/materials/laws_under_test.hpp"
#include "tests/unit/materials/rates.hpp"

namespace snug::testing {
namespace {

using Eigen::Vector3d, Eigen::VectorXd;
using materials::SkinMembrane;

Vector3d metric(const VectorXd& E) { return {1 + 2 * E[0], 1 + 2 * E[1], E[2]}; }

template <class Law>
class SkinOfEveryLaw : public ::testing::Test {
 protected:
  const SkinMembrane skin{.law = example<Law>(), .thickness = 1.5e-3};
};
TYPED_TEST_SUITE(SkinOfEveryLaw, SplitLaws);

TYPED_TEST(SkinOfEveryLaw, ForceAndTangentByRate) {
  // Force and tangent are the derivatives of the energy by E11, E22 and 2 E12; at rest they are those of an
  // incompressible sheet, 4 mu t [1 1/2 0; 1/2 1 0; 0 0 1/4], free of force.
  const SkinMembrane& skin = this->skin;
  for (const Vector3d& E : {Vector3d(0.2, -0.1, 0.15), Vector3d(1.0, 0.4, -0.8), Vector3d(-0.2, -0.15, 0.1)}) {
    const auto r = skin.at(metric(E));
    const auto energy = [&](const VectorXd& x) { return VectorXd::Constant(1, skin.at(metric(x)).energy); };
    const auto force = [&](const VectorXd& x) -> VectorXd { return skin.at(metric(x)).force; };
    expect_derivative_by_rate(energy, E, r.force.transpose(), 1e-3);
    expect_derivative_by_rate(force, E, r.tangent, 1e-3);
    EXPECT_LT((r.tangent - r.tangent.transpose()).cwiseAbs().maxCoeff(), 1e-13 * r.tangent.norm());
  }
  const double k = 10e3 * 1.5e-3;
  const auto rest = skin.at({1.0, 1.0, 0.0});
  Eigen::Matrix3d sheet;
  sheet << 4, 2, 0, 2, 4, 0, 0, 0, 1;
  EXPECT_LT(rest.force.norm(), 1e-13 * k);
  EXPECT_LT((rest.tangent - k * sheet).norm(), 1e-12 * k);
}

TEST(SkinMembrane, NeoHookeInClosedForm) {
  // Neo-Hooke has the closed form W = t mu/2 (C11 + C22 + 1/det C - 3): force and tangent of the general way agree.
  const SkinMembrane skin{.law = example<materials::NeoHooke>(), .thickness = 1.5e-3};
  const double c11 = 1.7, c22 = 0.8, c12 = 0.4, det = c11 * c22 - c12 * c12, k = 10e3 * 1.5e-3;
  const auto r = skin.at({c11, c22, c12});
  EXPECT_NEAR(r.energy, 0.5 * k * (c11 + c22 + 1 / det - 3), 1e-13 * k);
  const Vector3d force = k * Vector3d(1 - c22 / (det * det), 1 - c11 / (det * det), c12 / (det * det));
  EXPECT_LT((r.force - force).norm(), 1e-13 * k);
  const Vector3d g(c22, c11, -c12);
  Eigen::Matrix3d tangent = 4 * k / (det * det * det) * g * g.transpose();
  tangent(0, 1) -= 2 * k / (det * det);
  tangent(1, 0) -= 2 * k / (det * det);
  tangent(2, 2) += k / (det * det);
  EXPECT_LT((r.tangent - tangent).norm(), 1e-13 * tangent.norm());
}

}  // namespace
}  // namespace snug::testing
