// Elastic bands along the edge of a sleeve: tension, line load and balance in closed form.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

using std::numbers::pi;

/// A sleeve over the lower half of a rigid cylinder with a band of 6 N (150 N/m, 40 mm) along its upper edge, 12 % shorter than
/// that; the fabric itself is cut 1 % smaller than the cylinder.
input::Case banded(int around, const std::string& rest_length) {
  TubeCase tube;
  tube.tier = input::Tier::L1, tube.around = around, tube.along = around / 4;
  tube.sleeve = 0.99 * tube.radius;
  tube.fabric = "law = 'linear'\nwarp = '200 N/m'\nweft = '200 N/m'\nshear = '60 N/m'\npoisson = 0";
  input::Case c = describe_tube(tube);
  c.garments.front().pattern.length = 0.035, c.garments.front().position = 0.010;
  c.garments.front().band = {{.edge = "upper", .rest_length = rest_length, .stiffness = 150.0, .width = 0.040}};
  return c;
}

TEST(Bands, ABandOnARigidCylinderPressesWithItsTensionOverTheRadius) {
  constexpr double r = 0.055, l = 1.0 / 0.99, fabric = 200.0 * 0.5 * (l * l - 1.0) * l;
  const double rest = 0.88 * 2.0 * pi * 0.99 * r, T = 6.0 * (2.0 * pi * r / rest - 1.0);
  double coarse = 0.0;
  for (const int around : {24, 48}) {  // the same rest length as a share of the edge and as a length
    const input::Case c = banded(around, around == 24 ? std::string("-12 %") : fmt::format("{:.12f} mm", 1e3 * rest));
    const postproc::RunResult result = tests::solve(c, make_meshes(c));
    EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
    ASSERT_EQ(result.bands.size(), 1u);
    const std::string scene = fmt::format("band on a rigid cylinder, {} cells round", around);
    const double tolerance = around == 24 ? 5e-3 : 1.5e-3;  // falls with the square of the cells
    book(scene, "tension, N", result.bands[0].tension, T, tolerance, "EA (2 pi r/l0 - 1)");
    book(scene, "line load of the band, N/m", result.bands[0].line_load, T / r, tolerance, "T/r");
    book(scene, "contact force, N", result.balance.contact_force, 2.0 * pi * (T + fabric * 0.035), 2.0 * tolerance, "2 pi (T + fabric's tension times length)");
    book(scene, "line load of the hem, N/m", result.hems[1].line_load, T / r, 0.05, "T/r, less what the fabric spreads");
    EXPECT_LE(result.balance.force_error.norm(), 1e-9 * result.balance.contact_force);
    const double error = std::abs(result.bands[0].tension / T - 1.0);
    if (around == 48) {
      EXPECT_LE(error, 0.4 * coarse);
    }
    coarse = error;
  }
}

// A band that is longer than the edge as worn bears nothing and presses nothing: what is felt is the fabric's.
TEST(Bands, ABandThatIsNotStretchedPressesNothing) {
  constexpr double l = 1.0 / 0.99, fabric = 200.0 * 0.5 * (l * l - 1.0) * l;
  const input::Case c = banded(24, "30 %");
  const postproc::RunResult result = tests::solve(c, make_meshes(c));
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  EXPECT_EQ(result.bands.front().largest_tension, 0.0);
  EXPECT_EQ(result.bands.front().line_load, 0.0);
  book("slack band on a rigid cylinder", "contact force, N", result.balance.contact_force, 2.0 * pi * fabric * 0.035, 2e-2, "2 pi fabric's tension times length");
}

}  // namespace
}  // namespace snug::tests
