// The folds of a hem are counted by their crests.
#include "solver/scene/hem_folds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace snug::solver {
namespace {

/// A hem of so many folds of that depth (m, crest to valley) round a circle of 0.2 m, 0.1 m up, and an edge above it.
mesh::GarmentMesh hem(int folds, double depth, int nodes, std::vector<Eigen::Vector3d>& places) {
  mesh::GarmentMesh garment;
  for (const char* edge : {"lower", "upper"})
    for (int n = 0; n < nodes; ++n) {
      const double turn = 2.0 * std::numbers::pi * (n + 0.3) / nodes, r = 0.2 + 0.5 * depth * std::cos(folds * turn);
      garment.edges[edge].push_back(static_cast<int>(places.size()));
      places.emplace_back(0.4 + r * std::cos(turn), r * std::sin(turn), std::string(edge) == "lower" ? 0.1 : 0.6);
    }
  return garment;
}

TEST(HemFolds, AreAsManyAsTheHemHasCrestsDeeperThanTheLeast) {
  // Of the lowest edge, wherever its middle is; ripples below `least_fold` and the waves of a round hem are none.
  for (const int folds : {2, 5, 12}) {
    std::vector<Eigen::Vector3d> places;
    const mesh::GarmentMesh garment = hem(folds, 0.04, 300, places);
    const HemFolds found = hem_folds(garment, places);
    EXPECT_EQ(found.edge, "lower");
    EXPECT_EQ(found.count, folds);
    EXPECT_NEAR(found.least, 0.18, 2e-3);
    EXPECT_NEAR(found.largest, 0.22, 1e-3);
    EXPECT_NEAR(found.height, 0.1, 1e-12);
  }
  for (const double depth : {0.0, 0.8 * least_fold}) {
    std::vector<Eigen::Vector3d> places;
    const mesh::GarmentMesh garment = hem(7, depth, 300, places);
    EXPECT_EQ(hem_folds(garment, places).count, 0) << depth;
  }
}

TEST(HemFolds, CrestsNeedBothValleysBesideThem) {
  EXPECT_EQ(crests({1.0, 2.0, 1.0, 1.9, 1.8, 2.0, 1.0}, 0.5), 2);  // the dent of 0.1 is none
  EXPECT_EQ(crests({3.0, 1.0, 2.0}, 0.5), 1);                      // round the end of the list
  EXPECT_EQ(crests({1.0, 1.0, 1.0}, 0.5), 0);
  EXPECT_EQ(crests({}, 0.5), 0);
}

}  // namespace
}  // namespace snug::solver
