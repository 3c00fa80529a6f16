// Registered only when the folder SNUG_SCAN_DIR holds the scan.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <filesystem>
#include <iostream>

#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

input::BodySpec thigh_spec() {
  input::BodySpec spec = layered_spec();
  spec.kind = input::BodyKind::scan;
  spec.cells_around = 32;
  spec.cells_along = 12;
  spec.scan.emplace();
  spec.scan->surface = std::filesystem::path(SNUG_SCAN_DIR) / "mean_female.obj";
  spec.scan->up = input::FileAxis::y;
  spec.scan->front = input::FileAxis::z;
  spec.scan->lower = input::CutPlane{{0.09, 0.55, 0.0}, {0, -1, 0}};
  spec.scan->upper = input::CutPlane{{0.09, 0.72, 0.0}, {0, 1, 0}};
  spec.scan->smoothing_radius = 0.02;
  spec.scan->bone = input::BoneSpec{.girth = 0.1};
  return spec;
}

TEST(RealScan, AThighComesOutWithThePlausibleGirthAndASmallResidual) {
  const Limb limb = make_limb(thigh_spec());
  for (const auto& row : girth_table(limb, 6))
    std::cout << fmt::format("height {:.3f} m  girth {:.1f} mm  width {:.1f} mm  depth {:.1f} mm\n", row.height,
                             1e3 * row.girth, 1e3 * row.width, 1e3 * row.depth);
  std::cout << fmt::format("residual rms {:.3f} mm, max {:.3f} mm\n", 1e3 * limb.residual.rms, 1e3 * limb.residual.max);
  EXPECT_GT(limb.girth(0.55), 0.40);
  EXPECT_LT(limb.girth(0.72), 0.65);
  EXPECT_GT(limb.girth(0.70), limb.girth(0.56));
  EXPECT_LT(limb.residual.rms, 1e-3);
  EXPECT_LT(limb.residual.max, 5e-3);
}

TEST(RealScan, TheThighsCurvatureIsThatOfItsGirthOnAverageAndNowhereWild) {
  const Limb limb = make_limb(thigh_spec());
  for (double z : {0.57, 0.62, 0.70}) {
    // The curvature of a closed section integrates to one full turn over its arc.
    double turns = 0.0, length = 0.0;
    for (int i = 0; i < 256; ++i) {
      const double step = limb.skin->derivatives(i / 256.0, z).x_t.norm() / 256.0;
      const double k = limb.skin_curvature(i / 256.0, z)[0];
      turns += k * step / (2 * std::numbers::pi);
      length += step;
      EXPECT_LT(std::abs(k), 40.0) << z;  // a radius of at least 25 mm
    }
    EXPECT_NEAR(turns, 1.0, 0.05);  // below one where the skin leans, because the normal curvature is taken
    EXPECT_NEAR(length, limb.girth(z), 1e-9);
  }
}

TEST(RealScan, TheThighIsMeshedWithSoundCellsAndWearsASleeve) {
  const input::BodySpec spec = thigh_spec();
  const Limb limb = make_limb(spec);
  const BodyMesh mesh = make_body_mesh(spec, limb);
  for (const auto& row : quality(mesh)) EXPECT_GT(row.min_scaled_jacobian, 0.3) << row.layer;
  const GarmentMesh sleeve = make_tube_mesh(tube_spec(0.42, 0.1, 0.58), limb, 0.015);
  EXPECT_GT(sleeve.triangles.size(), 100u);
}

TEST(RealScan, CutPlanesThatReachIntoTheHipsAreRefused) {
  input::BodySpec spec = thigh_spec();
  spec.scan->upper->point[1] = 0.9;
  EXPECT_THROW(make_limb(spec), input::InputError);
}

}  // namespace
}  // namespace snug::mesh
