// The exact answers that cases state, against the radial equilibrium equation; and that solver against two others.
#include <gtest/gtest.h>

#include "cases/input/case.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/radial_limb.hpp"

namespace snug::tests {
namespace {

const std::vector<RadialLayer> peer_limb = {{0.015, 0.045, 1e4, 0.49}, {0.045, 0.0465, 1e5, 0.49}};

// Three solvers of the radial equation (collocation, shooting, this one) meet in ten digits.
TEST(ExactAnswers, TheRadialSolverMeetsTheReferenceBook) {
  const auto sleeve = [](double r) {
    const double l = r / 0.044;
    return 500.0 * l * (l * l - 1.0) / r;
  };
  const RadialAnswer tube = solve_limb({{0.020, 0.055, 1e4, 0.49}}, Volumetric::barrier, sleeve);
  book("1.6 C exact", "radial solver: pressure, Pa", tube.pressure, 6202.61651745, 1e-11,
       "reference book 1.6 C, 1layer 0.4900 44 SVK 1000, collocation");
  EXPECT_NEAR(tube.displacement, (54.70582574868 - 55.0) * 1e-3, 1e-13);
  const RadialAnswer p0 = solve_limb(peer_limb, Volumetric::quadratic, [](double) { return 5000.0; });
  book("peers P0 exact", "radial solver: displacement of the skin, m", p0.displacement, -0.193284046154e-3, 1e-9,
       "peer baselines section 2, P0 (ABQ), shooting and collocation");
}

// The answer under [study.exact] of cases/verification/peer-limb is that of the radial equation for its layers and
// sleeve: T = k1 (l - 1) per current width, p = T/r.
TEST(ExactAnswers, ThePeerLimbStatesItsOwn) {
  const input::Case c = input::read_case(std::string(SNUG_SOURCE_DIR) + "/cases/verification/peer-limb");
  ASSERT_TRUE(c.study && c.study->exact);
  const double k1 = 500e3 * 0.6e-3 / (1.0 - 0.3 * 0.3), rest = 0.85 * 0.0465;
  const RadialAnswer exact =
      solve_limb(peer_limb, Volumetric::quadratic, [&](double r) { return k1 * (r / rest - 1.0) / r; });
  book("peer limb exact", "contact pressure, Pa", c.study->exact->pressure, exact.pressure, 1e-10, "radial equation");
  book("peer limb exact", "displacement of the skin, m", c.study->exact->skin_radial_displacement, exact.displacement,
       1e-9, "radial equation");
}

}  // namespace
}  // namespace snug::tests
