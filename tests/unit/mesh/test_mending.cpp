// What is wrong with scanned surfaces is found, mended and said; cuts take a limb away and nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/surface/cutting.hpp"
#include "mesh/surface/level_surface.hpp"
#include "mesh/surface/mending.hpp"
#include "mesh/surface/smooth_surface.hpp"
#include "tests/unit/mesh/scanned_shapes.hpp"

namespace snug::mesh {
namespace {

using tests::Tube;

bool says(const MendedSurface& surface, const std::string& part) {
  return std::any_of(surface.mendings.begin(), surface.mendings.end(), [&](const Mending& one) { return one.what.find(part) != std::string::npos; });
}

TEST(Mending, ASoundSurfaceStaysAsItIs) {
  const TriangleSurface tube = tests::tube({});
  const MendedSurface mended = mend(tube);
  EXPECT_TRUE(mended.mendings.empty());
  EXPECT_EQ(mended.surface.triangles.size(), tube.triangles.size());
  EXPECT_NEAR(enclosed_volume(mended.surface) / enclosed_volume(tube), 1.0, 1e-12);
}

TEST(Mending, EachDefectIsMendedAndSaid) {
  const TriangleSurface sound = tests::tube({});
  const double volume = enclosed_volume(sound);
  TriangleSurface twice = sound, turned = sound, hole = sound, inside_out = sound, crumbs = sound;
  twice.triangles.push_back(twice.triangles[100]);
  for (int n = 300; n < 310; ++n) std::swap(turned.triangles[n][0], turned.triangles[n][1]);
  hole.triangles.erase(hole.triangles.begin() + 500, hole.triangles.begin() + 506);
  for (auto& t : inside_out.triangles) std::swap(t[0], t[1]);
  for (int n = 0; n < 3; ++n) crumbs.vertices.push_back({0.3 + 0.001 * n, 0.001 * n * n, 0.0});
  const int last = static_cast<int>(crumbs.vertices.size()) - 1;
  crumbs.triangles.push_back({last - 2, last - 1, last});
  for (const auto& [surface, said] : {std::pair{twice, "1 face given twice"}, std::pair{turned, "10 faces that turned"}, std::pair{hole, "1 hole"}, std::pair{inside_out, "showed its inside"},
                                      std::pair{crumbs, "1 small piece apart"}}) {
    const MendedSurface mended = mend(surface);
    EXPECT_TRUE(says(mended, said)) << said;
    EXPECT_EQ(mended.mendings.size(), 1u) << said;
    EXPECT_NEAR(enclosed_volume(mended.surface) / volume, 1.0, 1e-3) << said;
    EXPECT_TRUE(border_loops(mended.surface).empty()) << said;
  }
}

TEST(Mending, AWideHoleIsListedApartWithItsPlace) {
  TriangleSurface open = tests::tube({});
  std::erase_if(open.triangles, [&](const auto& t) { return std::all_of(t.begin(), t.end(), [&](int v) { return open.vertices[v].x() > 0.03 && std::abs(open.vertices[v].z() - 0.2) < 0.03; }); });
  const MendedSurface mended = mend(open);
  ASSERT_EQ(mended.wide_holes.size(), 1u);
  EXPECT_GT(mended.wide_holes[0].width, 0.03);
  EXPECT_GT(mended.wide_holes[0].rim.x(), 0.0);
  EXPECT_FALSE(says(mended, "hole"));
}

TEST(Cutting, TakesTheLimbAtThePointAwayAndLeavesTheOthersThatThePlaneMeets) {
  TriangleSurface legs = tests::trousers({});
  const double whole = enclosed_volume(legs);
  const Cut cut{"left", {0.08, 0.0, 0.1}, {0.0, 0.0, -1.0}, {}};
  const auto rims = cut_off(legs, cut, section_at_origin);
  ASSERT_EQ(rims.size(), 1u);
  double low_left = 1.0, low_right = 1.0;
  for (const auto& t : legs.triangles)
    for (const int v : t) (legs.vertices[v].x() > 0.0 ? low_left : low_right) = std::min(legs.vertices[v].x() > 0.0 ? low_left : low_right, legs.vertices[v].z());
  EXPECT_NEAR(low_left, 0.1, 1e-4);
  EXPECT_NEAR(low_right, 0.0, 1e-4);
  EXPECT_EQ(border_loops(compacted(legs)).size(), 1u);
  EXPECT_LT(enclosed_volume(legs), whole);
}

TEST(Cutting, ACutThatPartsNothingIsRefusedByItsName) {
  TriangleSurface ring = tests::ring(0.1, 0.03);
  try {
    cut_off(ring, {"once", {0.1, 0.0, 0.0}, {0.0, 1.0, 0.0}, {}}, section_at_origin);
    FAIL() << "no error";
  } catch (const input::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("\"once\" does not part"), std::string::npos) << error.what();
  }
}

// A sphere of 50 mm less 20 mm is one of 30 mm.
TEST(LevelSurface, UnderASphereIsASphere) {
  const TriangleSurface inner = level_surface([](const Eigen::Vector3d& x) { return 0.03 - x.norm(); }, {Eigen::Vector3d::Constant(-0.06), Eigen::Vector3d::Constant(0.06)}, 0.004);
  EXPECT_TRUE(border_loops(inner).empty());
  EXPECT_NEAR(enclosed_volume(inner) / (4.0 / 3.0 * std::numbers::pi * std::pow(0.03, 3)), 1.0, 0.01);
  EXPECT_TRUE(self_intersections(inner).empty());
}

// A tube of n flat strips has the mean radius R (1 - (pi/n)^2 / 3); a quarter of the weight at the corners leaves three quarters of that.
TEST(SmoothSurface, DrawsFacetsOfATubeOntoACircleBetweenThemAndKeepsAPlane) {
  constexpr int around = 60;
  const SmoothSurface smooth(tests::tube({.radius = 0.05, .around = around}), 0.01);
  const double radius = 0.05 * (1.0 - 0.75 / 3.0 * std::pow(std::numbers::pi / around, 2));
  for (double turn = 0.003; turn < 1.0; turn += 0.0713) {
    const double angle = 2.0 * std::numbers::pi * turn;
    const Eigen::Vector3d on(0.0498 * std::cos(angle), 0.0498 * std::sin(angle), 0.2137);
    EXPECT_NEAR(smooth.onto(on).x.head<2>().norm(), radius, 1e-5);
    EXPECT_NEAR(smooth.onto(on).normal.dot(Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0)), 1.0, 1e-5);
    const Eigen::Vector3d held = smooth.onto(on, {0.0, 0.0, 0.21}, Eigen::Vector3d::UnitZ());
    EXPECT_NEAR(held.z(), 0.21, 1e-12);
    EXPECT_NEAR(held.head<2>().norm(), radius, 1e-5);
  }
}

}  // namespace
}  // namespace snug::mesh
