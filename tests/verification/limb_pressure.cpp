// The tube alone under a pressure that follows its surface, against the radial equilibrium equation.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// Reference book 1.5 A (s03_layered_tube_sleeve): law V1, mu = 10 kPa, 20 to 55 mm, plane strain; outer radius in mm.
struct Row {
  std::string poisson_ratio;
  double pressure, outer_radius;  ///< kPa, mm
};

class LimbPressure : public testing::TestWithParam<Row> {};

TEST_P(LimbPressure, TheSkinMovesAsTheExactSolutionSaysWithinATenThousandth) {
  TubeCase tube;
  tube.length = 0.030, tube.around = 24, tube.along = 2, tube.through = 4;
  tube.tissue = "law = 'neo-Hooke'\nshear_modulus = '10 kPa'\npoisson_ratio = " + GetParam().poisson_ratio;
  input::Case c = describe_tube(tube);
  c.garments.clear(), c.contacts.clear();
  c.load.emplace().skin_pressure = 1e3 * GetParam().pressure;
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  ASSERT_EQ(result.status, postproc::Status::converged) << result.message;
  const double exact = 1e-3 * (GetParam().outer_radius - 55.0);
  book(fmt::format("1.5 A tube, nu {} p {} kPa", GetParam().poisson_ratio, GetParam().pressure),
       "displacement of the skin, m", result.numbers.at("mean_skin_radial_displacement_m"), exact, 1e-4,
       "reference book 1.5 A, collocation");
}

INSTANTIATE_TEST_SUITE_P(ReferenceBook, LimbPressure,
                         testing::Values(Row{"0.45", 5, 53.84224547386}, Row{"0.45", 20, 50.61813944797},
                                         Row{"0.49", 5, 54.76269347193}, Row{"0.499", 5, 54.97614945296},
                                         Row{"0.4999", 5, 54.99761376705}));

}  // namespace
}  // namespace snug::tests
