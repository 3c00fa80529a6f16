#include "tests/verification/rigid_surfaces.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace {

using namespace snug;
using tests::RigidCase;
using tests::Surface;

tests::RigidAnswer print(const RigidCase& rigid) {
  tests::RigidAnswer a = tests::run(rigid);
  fmt::print("{:9} {:4} {:5} {:5} {:6.3f} | {:6.2f} {:6.2f} {:6.2f} | {:6.2f} {:6.2f} {:6.2f} | {:5.1f}{}\n",
             rigid.surface == Surface::sphere ? "sphere" : "cylinder", rigid.order == 2 ? "P2" : "P1",
             rigid.flat ? "flat" : "Q2", input::text_of(rigid.basis), a.edge, 100 * a.skin.rms, 100 * a.skin.max, 100 * a.skin.mean,
             100 * a.garment.rms, 100 * a.garment.max, 100 * a.garment.mean, a.seconds,
             a.converged ? "" : "  NOT CONVERGED");
  std::fflush(stdout);
  return a;
}

void print_head() {
  fmt::print("pressure error in %: at the skin's nodes | raw multipliers of the garment\n");
  fmt::print("{:9} {:4} {:5} {:5} {:>6} | {:>6} {:>6} {:>6} | {:>6} {:>6} {:>6} | {:>5}\n", "surface", "gar.", "skin",
             "basis", "h/R", "rms", "max", "mean", "rms", "max", "mean", "s");
}

class RigidSurfaces : public testing::TestWithParam<Surface> {};

// A stretched sleeve presses on a rigid cylinder with T/R and on a sphere with 2T/R: quadratic triangles on quadratic
// skin find it at every node within 2 % (rms) at h = R/10, and the error falls under refinement.
TEST_P(RigidSurfaces, NodalPressureIsTensionTimesCurvature) {
  print_head();
  double before = 1.0;
  for (const double h : {0.2, 0.1, 0.05}) {
    const auto answer = print({.surface = GetParam(), .h = h});
    EXPECT_TRUE(answer.converged);
    EXPECT_LT(answer.skin.rms, 0.005) << "at h = " << h << " R";  // asked: 2 % at R/10
    EXPECT_LT(answer.garment.rms, 0.02) << "at h = " << h << " R";
    EXPECT_LT(answer.skin.rms, 0.6 * before) << "at h = " << h << " R";
    before = answer.skin.rms;
  }
}

// Dual multipliers meet the same pressure, less smoothly on the skin and more sharply on the garment.
TEST_P(RigidSurfaces, DualMultipliersMeetItToo) {
  print_head();
  const auto coarse = print({.surface = GetParam(), .h = 0.2, .basis = input::GapTests::dual});
  const auto fine = print({.surface = GetParam(), .basis = input::GapTests::dual});
  EXPECT_TRUE(coarse.converged && fine.converged);
  EXPECT_LT(fine.skin.rms, 0.02);
  EXPECT_LT(fine.skin.rms, 0.6 * coarse.skin.rms);
}

// Linear triangles and straight facets miss the same pressure, alone and together: by more than 5 % where the quadratic
// ones are within 2 %.
TEST_P(RigidSurfaces, StraightTrianglesOrFacetsMissIt) {
  print_head();
  for (const bool flat : {false, true})
    for (const int order : {2, 1})
      if (flat || order == 1) {
        const auto answer = print({.surface = GetParam(), .order = order, .flat = flat});
        EXPECT_TRUE(answer.converged);
        EXPECT_GT(answer.skin.rms, 0.05);
      }
}

INSTANTIATE_TEST_SUITE_P(Rigid, RigidSurfaces, testing::Values(Surface::cylinder, Surface::sphere),
                         [](const auto& info) { return info.param == Surface::sphere ? "Sphere" : "Cylinder"; });

}  // namespace
