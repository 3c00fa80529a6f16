#include <gtest/gtest.h>
#include <Eigen/Dense>

#include <set>

#include "mesh/garment/arc_length.hpp"
#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

constexpr double cell = 0.015;

GarmentMesh sleeve(const Limb& limb) { return make_tube_mesh(tube_spec(), limb, cell); }

TEST(GarmentMesh, SeamNodesPairExactlyInPatternAndSpace) {
  const GarmentMesh mesh = sleeve(ellipse());
  std::set<double> left, right;
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) {
    if (mesh.pattern[n].x() < 1e-12) left.insert(mesh.pattern[n].y());
    if (mesh.pattern[n].x() < 0.28 - 1e-12) {
      EXPECT_EQ(mesh.merged[n], static_cast<int>(n));
    } else {
      right.insert(mesh.pattern[n].y());
      const int partner = mesh.merged[n];
      EXPECT_NEAR(mesh.pattern[partner].x(), 0.0, 1e-12);
      EXPECT_NEAR(mesh.pattern[partner].y(), mesh.pattern[n].y(), 1e-12);
      EXPECT_EQ(mesh.placed[partner], mesh.placed[n]);
    }
    EXPECT_EQ(mesh.merged[mesh.merged[n]], mesh.merged[n]);
  }
  EXPECT_EQ(left.size(), 2u * 4 + 1);
  EXPECT_EQ(right.size(), left.size());
}

TEST(GarmentMesh, TrianglesCoverThePatternAndKeepTheirOrientationSeenFromOutside) {
  const Limb limb = ellipse();
  const GarmentMesh mesh = sleeve(limb);
  double area = 0.0;
  for (const auto& t : mesh.triangles) {
    const auto p = [&](int n) { return mesh.pattern[t[n]]; };
    const Eigen::Vector2d u = p(1) - p(0), v = p(2) - p(0);
    const double twice = u.x() * v.y() - u.y() * v.x();
    EXPECT_GT(twice, 0.0);
    area += twice / 2.0;
    for (int n = 0; n < 3; ++n) EXPECT_LT((p(3 + n) - 0.5 * (p(n) + p((n + 1) % 3))).norm(), 1e-12);
    const auto x = [&](int n) { return mesh.placed[t[n]]; };
    const Eigen::Vector3d normal = (x(1) - x(0)).cross(x(2) - x(0)).normalized();
    const Eigen::Vector3d outward(x(3).x() - 0.01, x(3).y() + 0.02, 0.0);
    EXPECT_GT(normal.dot(outward.normalized()), 0.5);
  }
  EXPECT_NEAR(area, 0.28 * 0.06, 1e-12);
}

TEST(GarmentMesh, TrianglesAreIrregularAndOfTheSizeAskedFor) {
  const GarmentMesh mesh = sleeve(cylinder());
  EXPECT_NEAR(mesh.mean_edge, cell, 0.15 * cell);
  std::set<long> heights;
  for (const auto& t : mesh.triangles)
    for (int n = 0; n < 3; ++n) heights.insert(std::lround(1e7 * mesh.pattern[t[n]].y()));
  EXPECT_GT(heights.size(), 20u);  // a regular grid would have 5 rows of vertices
}

/// A garment of half the limb's girth has as many cells round it as the limb asks for; a size that the case gives is that of
/// the cut.
TEST(GarmentMesh, CellsAreAsFineAsAskedForOnTheWornGarment) {
  const Limb limb = cylinder();
  const double girth = limb.girth(0.1);
  input::GarmentSpec spec = tube_spec();
  spec.pattern.flat_circumference = 0.5 * girth;
  const auto cells_round = [&] { return static_cast<double>(make_tube_mesh(spec, limb, cell).edges.at("lower").size()) / 2.0; };
  EXPECT_NEAR(cells_round(), girth / cell, 1.0);
  spec.cell_size = cell;
  EXPECT_NEAR(cells_round(), 0.5 * girth / cell, 1.0);
}

TEST(GarmentMesh, NodesStandTheLiftOffTheSkinAtEqualArcLengths) {
  const Limb limb = ellipse();
  const GarmentMesh mesh = sleeve(limb);
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) {
    const double z = 0.14 + mesh.pattern[n].y();
    const double turn = SectionArc(*limb.skin, z, 0.5).turn_at(mesh.pattern[mesh.merged[n]].x() / 0.28);
    EXPECT_NEAR((mesh.placed[n] - limb.skin->at(turn, z)).norm(), 2e-4, 1e-12);
  }
  // On a circle equal arc length is equal angle, from the inner side counter-clockwise.
  const GarmentMesh round = sleeve(cylinder());
  for (std::size_t n = 0; n < round.pattern.size(); ++n) {
    const double angle = std::numbers::pi + 2 * std::numbers::pi * round.pattern[round.merged[n]].x() / 0.28;
    EXPECT_NEAR((round.placed[n] -
                 Eigen::Vector3d(0.0502 * std::cos(angle), 0.0502 * std::sin(angle), 0.14 + round.pattern[n].y()))
                    .norm(),
                0.0, 1e-10);
  }
}

TEST(GarmentMesh, WiderThanTheLimbItIsPlacedAtItsOwnSize) {
  // On a circle: a circle of its own circumference. On an ellipse: the parallel curve of that length, evenly divided.
  const double width = 0.36;
  const GarmentMesh round = make_tube_mesh(tube_spec(width), cylinder(), cell);
  const double radius = width / (2.0 * std::numbers::pi);
  for (const Eigen::Vector3d& x : round.placed) EXPECT_NEAR(x.head<2>().norm(), radius, 1e-9);
  EXPECT_NEAR(round.stand_off, radius - 0.05, 1e-9);
  const Limb limb = ellipse();
  const GarmentMesh oval = make_tube_mesh(tube_spec(width), limb, cell);
  EXPECT_NEAR(oval.stand_off, (width - limb.girth(0.14)) / (2.0 * std::numbers::pi), 1e-9);
  for (const auto& t : oval.triangles)  // chords of straight and even pieces: as long as the pattern says, and no longer
    for (int k = 0; k < 3; ++k) {
      const double flat = (oval.pattern[t[k]] - oval.pattern[t[(k + 1) % 3]]).norm();
      const double stands = (oval.placed[t[k]] - oval.placed[t[(k + 1) % 3]]).norm();
      EXPECT_LT(stands, flat + 1e-9);
      EXPECT_GT(stands, 0.97 * flat);
    }
  EXPECT_EQ(sleeve(cylinder()).stand_off, 0.0);
  EXPECT_EQ(make_tube_mesh(tube_spec(0.1 * std::numbers::pi), cylinder(), cell).stand_off, 0.0);  // just as wide
}

TEST(GarmentMesh, ASewnTubeHasTheEulerNumberOfATube) {
  const GarmentMesh mesh = sleeve(cylinder());
  std::set<int> vertices, all;
  std::set<std::set<int>> edges;
  for (const auto& t : mesh.triangles)
    for (int n = 0; n < 3; ++n) {
      const int a = mesh.merged[t[n]], b = mesh.merged[t[(n + 1) % 3]];
      vertices.insert(a);
      edges.insert({a, b});
      all.insert({a, mesh.merged[t[3 + n]]});
    }
  const int euler = static_cast<int>(vertices.size() + mesh.triangles.size()) - static_cast<int>(edges.size());
  EXPECT_EQ(euler, 0);
  EXPECT_EQ(all.size(), vertices.size() + edges.size());
}

TEST(GarmentMesh, EdgesListEachSewnNodeOnceWithMidNodes) {
  const Limb limb = cylinder();
  const GarmentMesh mesh = sleeve(limb);
  for (const char* name : {"lower", "upper"}) {
    const auto& edge = mesh.edges.at(name);
    EXPECT_EQ(edge.size(), 2 * std::lround(limb.girth(0.17) / cell));
    EXPECT_EQ(std::set<int>(edge.begin(), edge.end()).size(), edge.size());
    for (int node : edge) {
      EXPECT_EQ(mesh.merged[node], node);
      EXPECT_NEAR(mesh.pattern[node].y(), std::string(name) == "lower" ? 0.0 : 0.06, 1e-12);
    }
  }
}

TEST(GarmentMesh, TheWarpFollowsThePattern) {
  auto spec = tube_spec();
  EXPECT_EQ(make_tube_mesh(spec, cylinder(), cell).warp.at(0), Eigen::Vector2d(0, 1));
  spec.warp = input::WarpDirection::around;
  EXPECT_EQ(make_tube_mesh(spec, cylinder(), cell).warp.at(0), Eigen::Vector2d(1, 0));
}

TEST(GarmentMesh, AGarmentThatDoesNotFitIsRefused) {
  EXPECT_THROW(make_tube_mesh(tube_spec(0.28, 0.06, 0.15), cylinder(), cell), input::InputError);
  EXPECT_THROW(make_tube_mesh(tube_spec(0.28, 0.06, -0.01), cylinder(), cell), input::InputError);
  EXPECT_THROW(make_tube_mesh(tube_spec(0.0), cylinder(), cell), input::InputError);
  EXPECT_THROW(make_tube_mesh(tube_spec(), cylinder(), 0.0), input::InputError);
  EXPECT_NO_THROW(make_tube_mesh(tube_spec(0.28, 0.2, 0.0), cylinder(), cell));
}

/// The seam lies at the angle that the case gives, and the whole mesh goes with it.
TEST(GarmentMesh, TheSeamLiesWhereTheCaseSays) {
  input::GarmentSpec spec = tube_spec();
  const GarmentMesh inner = make_tube_mesh(spec, cylinder(), cell);
  spec.seam = 0.3;
  const GarmentMesh side = make_tube_mesh(spec, cylinder(), cell);
  const Eigen::AngleAxisd turn(0.3 - std::numbers::pi, Eigen::Vector3d::UnitZ());
  int on_seam = 0;
  for (std::size_t n = 0; n < side.placed.size(); ++n) {
    EXPECT_LT((side.placed[n] - turn * inner.placed[n]).norm(), 1e-12) << n;
    if (side.pattern[n].x() != 0.0) continue;
    EXPECT_NEAR(std::atan2(side.placed[n].y(), side.placed[n].x()), 0.3, 1e-12);
    ++on_seam;
  }
  EXPECT_GT(on_seam, 3);
}

/// On an ellipse, too, the seam's angle is the one that is seen from its middle, in every quarter and beyond a full turn.
TEST(GarmentMesh, TheSeamOfAnEllipseLiesAtItsAngle) {
  const Limb limb = straight_limb(ellipse_of_girth(0.0, 0.4, 2.5, 0.0, 0.0), ellipse_of_girth(0.0, 0.1, 1.0, 0.0, 0.0), 0.0, 0.2);
  for (const double angle : {0.3, 1.0, 2.0, 3.5, 5.0, 7.0, -1.0}) {
    input::GarmentSpec spec = tube_spec(0.3, 0.06, 0.05);
    spec.seam = angle;
    const GarmentMesh mesh = make_tube_mesh(spec, limb, cell, 0.0);
    int on_seam = 0;
    for (std::size_t n = 0; n < mesh.placed.size(); ++n) {
      if (mesh.pattern[n].x() != 0.0) continue;
      const Eigen::Vector3d along(std::cos(angle), std::sin(angle), 0.0);
      EXPECT_LT(along.cross(Eigen::Vector3d(mesh.placed[n].x(), mesh.placed[n].y(), 0.0)).norm(), 1e-12) << angle;
      EXPECT_GT(along.dot(mesh.placed[n]), 0.0) << angle;
      ++on_seam;
    }
    EXPECT_GT(on_seam, 3);
  }
}

}  // namespace
}  // namespace snug::mesh
