// Newton's method on the tube sleeve: quadratic at the end, and in balance where it stops.
#include <gtest/gtest.h>

#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

/// Residuals (over the contact force) of the last solve: of the body under the tightened garment.
std::vector<double> last_residuals(const postproc::RunResult& result) {
  std::vector<double> residuals;
  for (const auto& row : result.history) {
    if (row.iteration == 0) residuals.clear();
    residuals.push_back(row.residual);
  }
  return residuals;
}

void expect_balance(const postproc::Balance& balance, double length) {
  EXPECT_GT(balance.contact_force, 1.0);
  EXPECT_LE(balance.force_error.norm(), 1e-8 * balance.contact_force);
  EXPECT_LE(balance.moment_error.norm(), 1e-8 * balance.contact_force * length);
  EXPECT_LE((balance.garment_force + balance.skin_force).norm(), 1e-12 * balance.contact_force);
}

TEST(Newton, TheTubeSleeveConvergesQuadraticallyAtTheEndAndIsInBalance) {
  const TubeCase tube;
  const postproc::RunResult result = run(tube);
  ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
  const std::vector<double> r = last_residuals(result);
  ASSERT_GE(r.size(), 4u);
  EXPECT_LE(r.size(), 8u);
  for (std::size_t k = 1; k < r.size(); ++k) EXPECT_LT(r[k], 0.2 * r[k - 1]);
  const double last = r.back(), before = r[r.size() - 2];  // garment points have come to rest on their facets
  EXPECT_LE(last, std::max(100.0 * before * before, 1e-13)) << "from " << before;
  EXPECT_EQ(result.history.back().changed, 0);
  EXPECT_LE(result.max_penetration, 1e-6 * 0.011);
  expect_balance(result.balance, tube.radius);
}

TEST(Newton, TheRigidTierIsInBalanceToo) {
  TubeCase tube;
  tube.tier = input::Tier::L1;
  const postproc::RunResult result = run(tube);
  ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
  expect_balance(result.balance, tube.radius);
}

TEST(Newton, TheDualBasisGivesTheSameMeanPressure) {
  TubeCase tube;
  const double hat = run(tube).numbers.at("mean_contact_pressure_Pa");
  tube.basis = input::GapTests::dual;
  const postproc::RunResult dual = run(tube);
  ASSERT_EQ(dual.status, postproc::Status::converged) << dual.message;
  EXPECT_NEAR(dual.numbers.at("mean_contact_pressure_Pa"), hat, 1e-3 * hat);
}

}  // namespace
}  // namespace snug::tests
