// Maps of the skin against exact answers and against each other.
#include "postproc/skin_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace snug::postproc {
namespace {

/// A cylinder of radius 50 mm and height 100 mm with `around` nodes round it; fields smooth in angle and height.
SkinMap cylinder(int around) {
  SkinMap map;
  const int along = around / 3;
  for (int j = 0; j <= along; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / around, z = 0.1 * j / along;
      map.nodes.emplace_back(0.05 * std::cos(angle), 0.05 * std::sin(angle), z);
      map.displacement.push_back(-1e-3 * (1.0 + z) * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0));
      map.pressure.push_back(1000.0 + 100.0 * std::cos(angle) * std::cos(20.0 * z));
      map.coverage.push_back(1.0);
    }
  return map;
}

// A map that is an exact answer everywhere has no error; one node that is off counts by its share.
TEST(SkinMap, ErrorAgainstAnExactAnswerIsTheRmsOverTheCoveredNodesOfTheZone) {
  SkinMap map = cylinder(24);
  for (std::size_t n = 0; n < map.nodes.size(); ++n) {
    map.pressure[n] = 1000.0;
    map.displacement[n] = -2e-3 * Eigen::Vector3d(map.nodes[n].x(), map.nodes[n].y(), 0.0) / 0.05;
  }
  EXPECT_NEAR(error_against(map, {}, 1000.0, -2e-3).pressure_rms, 0.0, 1e-14);
  EXPECT_NEAR(error_against(map, {}, 1000.0, -2e-3).displacement_rms, 0.0, 1e-12);
  map.pressure[0] = 1100.0;
  const double count = static_cast<double>(map.nodes.size());
  EXPECT_NEAR(error_against(map, {}, 1000.0, -2e-3).pressure_rms, 0.1 / std::sqrt(count), 1e-12);
  EXPECT_NEAR(error_against(map, {}, 1000.0, -2e-3).pressure_max, 0.1, 1e-12);
  EXPECT_NEAR(error_against(map, {0.01, 0.1}, 1000.0, -2e-3).pressure_rms, 0.0, 1e-14) << "node 0 is not in the zone";
  map.coverage[0] = 0.4;
  EXPECT_NEAR(error_against(map, {}, 1000.0, -2e-3).pressure_rms, 0.0, 1e-14) << "node 0 is not covered";
}

// Interpolation between meshes is of third order: the error falls eightfold when the finer mesh is halved.
TEST(SkinMap, InterpolationErrorFallsWithTheThirdPowerOfTheSpacing) {
  const SkinMap here = cylinder(31);  // no node of the others
  const double coarse = error_against(here, {}, cylinder(48)).pressure_rms;
  const double fine = error_against(here, {}, cylinder(96)).pressure_rms;
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(std::log2(coarse / fine), 2.5);
}

}  // namespace
}  // namespace snug::postproc
