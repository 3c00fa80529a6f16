// Sizes for pressures that are wanted, on pressures known in closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "solver/app/suggestion.hpp"

namespace snug::app {
namespace {

/// A tube on a limb of girth 1: p = k (1/size - 1), nothing where it is wider than the limb.
std::map<std::string, double> tube_pressure(double stiffness, double size) {
  const double pressure = std::max(0.0, stiffness * (1.0 / size - 1.0));
  return {{"front", pressure}, {"back", 0.5 * pressure}};
}

TEST(Suggestion, TheSizeThatMeetsATargetIsFoundInAFewGuesses) {
  // k/s - k = 100 at s = k/(k + 100), from 400 to 4000 Pa, within one percent of the pressure and ten guesses, though the tube hangs free in a part of the range.
  for (const double stiffness : {400.0, 1000.0, 4000.0}) {
    int guesses = 0;
    const Proposal found = best_size("knit", {{"front", 100.0}}, 0.75, 1.1, [&](double size) { return ++guesses, tube_pressure(stiffness, size); });
    EXPECT_NEAR(found.pressures.at("front"), 100.0, 1.0) << stiffness;
    EXPECT_NEAR(found.size, stiffness / (stiffness + 100.0), 2e-3);
    EXPECT_LE(guesses, 10);
    EXPECT_NEAR(found.per_percent, 100.0 * (tube_pressure(stiffness, 1.01 * found.size)["front"] / found.pressures.at("front") - 1.0), 1e-9);
  }
}

TEST(Suggestion, TargetsThatDisagreeAreMissedByTheLeastAndOutOfReachAtTheEnd) {
  // front = p and back = p/2 cannot both be 100: (p/100 - 1)^2 + (p/200 - 1)^2 is least at p = 120. 1e6 Pa is out of reach: the smallest size is the nearest.
  const Proposal both = best_size("knit", {{"front", 100.0}, {"back", 100.0}}, 0.7, 1.05, [](double size) { return tube_pressure(1000.0, size); });
  EXPECT_NEAR(both.pressures.at("front"), 120.0, 1.0);
  EXPECT_NEAR(both.off, std::sqrt(0.5 * (0.04 + 0.16)), 1e-3);
  const Proposal none = best_size("knit", {{"front", 1e6}}, 0.7, 1.05, [](double size) { return tube_pressure(1000.0, size); });
  EXPECT_EQ(none.size, 0.7);
  EXPECT_GT(none.off, 0.99);
}

TEST(Suggestion, OfEquallyGoodOnesTheOneThatForgivesComesFirst) {
  std::vector<Proposal> all = {{.fabric = "stiff", .off = 0.001, .per_percent = -12.0}, {.fabric = "far", .off = 0.3, .per_percent = -1.0}, {.fabric = "soft", .off = 0.003, .per_percent = -4.0}};
  rank(all);
  EXPECT_EQ(all[0].fabric, "soft");
  EXPECT_EQ(all[1].fabric, "stiff");
  EXPECT_EQ(all[2].fabric, "far");
}

}  // namespace
}  // namespace snug::app
