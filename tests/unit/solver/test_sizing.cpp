// The search for a size, a population, and what a sensor's bulge adds.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "materials/fabric/inputs.hpp"
#include "solver/library/population.hpp"
#include "solver/library/sensor.hpp"
#include "solver/library/size_search.hpp"

namespace snug::solver {
namespace {

/// A garment on a wearer of girth 1 that is stretched to 1 / size: cheap as the law of Laplace tells it, true with a body that gives way.
double cheap(double size) { return std::max(0.0, 30.0 * (1.0 / size - 1.0)); }
double truth(double size) { return cheap(size) * (0.8 + 0.3 * (1.0 - size)); }

TEST(SizeSearch, MeetsOnePressureInThreeSolutions) {
  // Where the cheap law is a fifth to a third off, by an amount that changes with the size, the third solution is within 1 % of what is wanted.
  for (const double wanted : {2.0, 6.0, 12.0, 25.0}) {
    SizeSearch search({wanted}, [](std::size_t, double size) { return cheap(size); }, 0.4, 1.02);
    double found = 0.0;
    for (int solution = 0; solution < 3; ++solution) {
      const double size = search.next();
      found = truth(size);
      search.found(size, {found});
    }
    EXPECT_NEAR(found / wanted, 1.0, 0.01) << wanted;
  }
}

TEST(SizeSearch, MeetsAtOnceWhatIsOffByTheSameFactorAtEverySize) {
  // The first solution tells the factor 0.7, so that the second is exact.
  SizeSearch search({6.0}, [](std::size_t, double size) { return cheap(size); }, 0.4, 1.02);
  const double first = search.next();
  search.found(first, {0.7 * cheap(first)});
  EXPECT_NEAR(0.7 * cheap(search.next()), 6.0, 1e-5);
}

TEST(SizeSearch, OfSeveralTheSquaresAreLeast) {
  // Two places of which one has twice the pressure of the other at any size: wanted alike, the least squares of (p/w - 1) and (2p/w - 1) are at p = 0.6 w.
  SizeSearch search({10.0, 10.0}, [](std::size_t place, double size) { return (place ? 2.0 : 1.0) * cheap(size); }, 0.4, 1.02);
  EXPECT_NEAR(cheap(search.next()), 6.0, 1e-4);
}

TEST(SizeSearch, SaysWhatIsNotWithinReach) {
  // Pressures above that of the smallest size, and below that of the largest, end at the ends.
  SizeSearch high({1000.0}, [](std::size_t, double size) { return cheap(size); }, 0.4, 1.02);
  EXPECT_FALSE(high.within_reach(high.next()));
  SizeSearch fine({10.0}, [](std::size_t, double size) { return cheap(size); }, 0.4, 1.02);
  EXPECT_TRUE(fine.within_reach(fine.next()));
}

GarmentModel garment() {
  return {.spec = {}, .fabric = materials::LinearFabric{.warp = 300.0, .weft = 200.0, .shear = 60.0, .sheet = {.poisson = 0.0}}.fabric()};
}

TEST(Worn, FollowsTheLawOfLaplaceWithGirthAndSize) {
  // St. Venant-Kirchhoff cloth of 200 N/m: T = 100 (l^2 - 1) l at a stretch l, p ~ T / girth. Scaled to meet 2000 Pa on a girth of 0.25 m at 0.2 m.
  const GarmentModel cloth = garment();
  const WornPressure place(cloth, {.height = 0.0, .girth = 0.2}, true, 0.25, 2000.0);
  const auto law = [](double girth, double own) {
    const double l = girth / own;
    return 100.0 * (l * l - 1.0) * l / girth;
  };
  for (const double girth : {0.21, 0.25, 0.3})
    for (const double size : {0.9, 1.0, 1.04}) EXPECT_NEAR(place.at(girth, size), 2000.0 * law(girth, 0.2 * size) / law(0.25, 0.2), 1e-6) << girth << " " << size;
  EXPECT_EQ(place.at(0.19, 1.0), 0.0);  // slack
  EXPECT_NEAR(place.girth_for(place.at(0.27, 1.02), 1.02), 0.27, 1e-9);
}

TEST(Population, TheQuantilesOfTheNormalDistributionAreItsOwn) {
  // Girths of 220 +- 15 mm: the median is the mean, 15.87 % are below one deviation less (tables of the normal distribution).
  const std::vector<Wearer> wearers = normal_wearers(0.22, 0.015, {0.22, 0.36});
  EXPECT_NEAR(girth_below(wearers, 0.5), 0.22, 1e-4);
  EXPECT_NEAR(girth_below(wearers, 0.1587), 0.205, 2e-4);
  for (const Wearer& one : wearers) EXPECT_NEAR(one.girths[1] / one.girths[0], 0.36 / 0.22, 1e-12);
}

TEST(Population, EverybodyTakesOneSizeAndMoreSizesReachMore) {
  // Shares add up to 1, what is inside is worn, ease is that of the girths, and a wide range holds everybody.
  const GarmentModel cloth = garment();
  const std::vector<WornPressure> places = {WornPressure(cloth, {.height = 0.0, .girth = 0.2}, true, 0.25, 2500.0)};
  const std::vector<Wearer> wearers = normal_wearers(0.25, 0.02, {0.25});
  double before = 0.0;
  for (const int sizes : {1, 2, 3, 6}) {
    const std::vector<SizeRow> rows = size_table(wearers, places, {2500.0}, {{2250.0, 2750.0}}, sizes);
    double worn = 0.0, inside = 0.0;
    for (const SizeRow& row : rows) {
      worn += row.worn, inside += row.inside;
      EXPECT_LE(row.inside, row.worn + 1e-12);
      EXPECT_NEAR(places[0].at(row.from_girth, row.size), 2250.0, 1.0);
      EXPECT_NEAR(row.from_ease, 0.2 * row.size / row.from_girth - 1.0, 1e-12);
    }
    EXPECT_NEAR(worn, 1.0, 1e-9);
    EXPECT_GT(inside, before);
    before = inside;
  }
  double all = 0.0;
  for (const SizeRow& row : size_table(wearers, places, {2500.0}, {{1.0, 1e6}}, 3)) all += row.inside;
  EXPECT_NEAR(all, 1.0, 1e-9);
}

TEST(Population, GirthsComeFromATableAndSlipsAreNamed) {
  // Columns called like the places in any unit, shares beside; a girth typed ten times too large and a missing column are errors with their place.
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "snug-girths.csv";
  const auto read = [&](const std::string& text) {
    std::ofstream(file) << text;
    return read_wearers(file, {"Ankle", "Calf"}, {0.22, 0.36});
  };
  const std::vector<Wearer> wearers = read("name;Calf [cm];Ankle [cm];share\nA;36;21,5;3\nB;40;24;1\n");
  ASSERT_EQ(wearers.size(), 2u);
  EXPECT_DOUBLE_EQ(wearers[0].girths[0], 0.215);
  EXPECT_DOUBLE_EQ(wearers[1].girths[1], 0.40);
  EXPECT_DOUBLE_EQ(wearers[0].share, 0.75);
  EXPECT_NEAR(read("ankle [mm]\n220\n242\n")[1].girths[1], 0.396, 1e-12);  // in proportion
  EXPECT_THROW(read("Ankle [mm]\n2200\n"), input::InputError);
  EXPECT_THROW(read("Wrist [mm]\n220\n"), input::InputError);
  EXPECT_THROW(read("Ankle [mm]\n"), input::InputError);
  std::filesystem::remove(file);
}

TEST(Sensor, TheBulgeIsThatOfItsCapOnARigidSkinAndLessOnASoftOne) {
  // 150 N/m over a cap of 3 mm on 28 mm: curvature 8 h / (d^2 + 4 h^2) = 29.27 1/m, 4390 Pa. A skin that yields easily lets nothing stand out; in
  // between the cap's pressure is that of the round punch, 16 G (t - h) / (pi d).
  const double rigid = bulge_pressure(150.0, 3e-3, 28e-3, std::numeric_limits<double>::infinity());
  EXPECT_NEAR(rigid, 150.0 * 8 * 3e-3 / (28e-3 * 28e-3 + 4 * 9e-6), 1e-9);
  EXPECT_LT(bulge_pressure(150.0, 3e-3, 28e-3, 1.0), 1e-3 * rigid);
  const double soft = bulge_pressure(150.0, 3e-3, 28e-3, 10e3), yields = soft * std::numbers::pi * 28e-3 / (16 * 10e3), height = 3e-3 - yields;
  EXPECT_NEAR(soft, 150.0 * 8 * height / (28e-3 * 28e-3 + 4 * height * height), 1e-6 * soft);
  EXPECT_EQ(bulge_pressure(0.0, 3e-3, 28e-3, 10e3), 0.0);
  EXPECT_EQ(bulge_pressure(150.0, 0.0, 28e-3, 10e3), 0.0);
}

}  // namespace
}  // namespace snug::solver
