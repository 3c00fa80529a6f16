#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <functional>
#include <numbers>

#include "mesh/garment/garment_cut.hpp"
#include "mesh/garment/limb_placement.hpp"
#include "mesh/garment/tube_chart.hpp"
#include "tests/pattern_texts.hpp"
#include "tests/unit/mesh/bodies.hpp"
#include "tests/unit/mesh/patterns.hpp"

namespace snug::mesh {
namespace {

/// A round limb of a radius by height (m), without a bone.
class Revolved : public Outline {
 public:
  explicit Revolved(std::function<double(double)> radius) : radius_(std::move(radius)) {}
  Eigen::Vector3d at(double turn, double z) const override {
    const double angle = 2.0 * std::numbers::pi * turn;
    return {radius_(z) * std::cos(angle), radius_(z) * std::sin(angle), z};
  }

 private:
  std::function<double(double)> radius_;
};

Limb cone_limb(const std::function<double(double)>& radius, double lower, double upper) {
  Limb limb;
  limb.skin = std::make_unique<Revolved>(radius);
  limb.lower = lower, limb.upper = upper;
  return limb;
}

constexpr double lift = 2e-4;

using tests::tube_text;

input::GarmentSpec spec_at(double position) {
  input::GarmentSpec spec;
  spec.position = position;
  return spec;
}

LimbPlacement placed(const SewnMesh& sewn, const Limb& limb, const input::GarmentSpec& spec) { return place_on_limb(sewn, spec, limb, lift); }

// Principal stretches of a placed triangle between its vertices.
Eigen::Vector2d stretches(const SewnMesh& sewn, const LimbPlacement& placement, int t) {
  const auto& n = sewn.triangles[t];
  Eigen::Matrix2d flat;
  flat << sewn.flat[n[1]] - sewn.flat[n[0]], sewn.flat[n[2]] - sewn.flat[n[0]];
  Eigen::Matrix<double, 3, 2> x;
  x << placement.placed[n[1]] - placement.placed[n[0]], placement.placed[n[2]] - placement.placed[n[0]];
  return (x * flat.inverse()).jacobiSvd().singularValues();
}

TEST(SewnGarment, ATubeIsPlacedAlikeHoweverItIsCut) {
  // One piece, two halves, four quarters and slanting seams lie on a cylinder evenly: every height is the pattern's, every turn its share.
  const Limb limb = cylinder();
  const double girth = limb.girth(0.1), width = 0.8 * girth;
  const double chords = 1e-4;  // m: irregular triangles of 12 mm cut the circle of 50 mm by chords of unequal length
  for (const auto& [pieces, lean] : {std::pair{1, 0.0}, std::pair{2, 0.0}, std::pair{4, 0.0}, std::pair{3, 40.0}}) {
    const SewnMesh sewn = mesh_pattern(checked_toml(tube_text(pieces, 1e3 * width, 60.0, lean)), 0.012);
    const LimbPlacement placement = placed(sewn, limb, spec_at(0.05));
    EXPECT_NEAR(placement.fit.lower, 0.05, 1e-9) << pieces;
    EXPECT_NEAR(placement.fit.upper, 0.11, chords) << pieces;
    for (const double z : {0.051, 0.08, 0.109}) {
      EXPECT_NEAR(placement.fit.girth_at(z), width, 1e-3 * width) << pieces << " at " << z;
      EXPECT_NEAR(placement.fit.cover_at(z), 1.0, 1e-9);
    }
    for (std::size_t n = 0; n < sewn.flat.size(); ++n) ASSERT_NEAR(placement.placed[n].z(), 0.05 + sewn.flat[n].y(), chords) << pieces << " node " << n;
    EXPECT_EQ(placement.stand_off, 0.0);
  }
}

TEST(SewnGarment, TheFirstSeamLiesAtItsAngleAndAFrontPieceInFront) {
  // The middle of the seam comes to the angle the case gives, of a slanting one too; pieces called front come to +y without being told.
  const Limb limb = ellipse();
  input::GarmentSpec spec = spec_at(0.15);
  spec.seam = 0.3;
  const double width = 0.9 * limb.girth(0.18);
  const SewnMesh sewn = mesh_pattern(checked_toml(tube_text(2, 1e3 * width, 60.0, 30.0)), 0.012);
  const LimbPlacement placement = placed(sewn, limb, spec);
  const auto& pairs = sewn.seams.front().pairs;
  const Eigen::Vector3d middle = placement.placed[pairs[pairs.size() / 2][0]];
  const Eigen::Vector3d wanted = limb.skin->at(limb.skin->turn_at_angle(0.3, middle.z()), middle.z());
  EXPECT_LT((middle - wanted).norm(), 1.5 * lift);

  const SewnMesh halves = mesh_pattern(checked_toml(two_halves), 0.02);
  const Limb wide = cone_limb([](double) { return 0.08; }, 0.0, 0.4);
  const LimbPlacement trunk = placed(halves, wide, spec_at(0.02));
  Eigen::Vector3d front = Eigen::Vector3d::Zero();
  for (std::size_t n = 0; n < halves.flat.size(); ++n)
    if (halves.pieces[halves.node_piece[n]] == "front") front += trunk.placed[n];
  EXPECT_GT(front.y(), 10.0 * std::abs(front.x()));
}

TEST(SewnGarment, TheOutsideOfThePiecesLooksOutwards) {
  // Every triangle that is counter-clockwise in its drawing is so seen from outside the limb, on a tapering oval one, too.
  const Limb limb = ellipse();
  const SewnMesh sewn = mesh_pattern(checked_toml(tube_text(3, 1e3 * 0.85 * limb.girth(0.18), 80.0, 25.0)), 0.012);
  const LimbPlacement placement = placed(sewn, limb, spec_at(0.15));
  for (const auto& t : sewn.triangles) {
    const Eigen::Vector3d a = placement.placed[t[0]], b = placement.placed[t[1]], c = placement.placed[t[2]];
    Eigen::Vector3d out = (a + b + c) / 3.0;
    out.head<2>() -= section_centre(*limb.skin, out.z());
    out.z() = 0.0;
    ASSERT_GT((b - a).cross(c - a).normalized().dot(out.normalized()), 0.5);
  }
}

TEST(SewnGarment, AConeOfOneSectorLiesOnAConeWithoutStrain) {
  // The leg of a cone (annulus of 100 to 250 mm, 120 degrees) on the limb of that cone keeps its lengths: what strain there is comes from the
  // triangles, at most 1.5 hundredths at 8 mm and in the mean a few thousandths that fall with the size of the cells.
  const double sine = 1.0 / 3.0, cosine = std::sqrt(1.0 - sine * sine);  // girth 2 pi/3 of the slant length
  const Limb limb = cone_limb([&](double z) { return -z / cosine * sine; }, -0.26 * cosine, -0.09 * cosine);
  input::GarmentSpec spec = spec_at(-0.25 * cosine);
  spec.bottom = "outer";
  std::array<double, 2> mean{};
  for (const int half : {0, 1}) {
    const SewnMesh sewn = mesh_pattern(checked_toml(cone), half ? 0.004 : 0.008);
    const LimbPlacement placement = place_on_limb(sewn, spec, limb, 1e-6);
    EXPECT_NEAR(placement.fit.upper, -0.10 * cosine, 1e-4);
    EXPECT_NEAR(placement.fit.girth_at(-0.2 * cosine), 2.0 * std::numbers::pi * 0.2 / 3.0, 1e-3);
    for (int t = 0; t < static_cast<int>(sewn.triangles.size()); ++t) {
      const double strain = (stretches(sewn, placement, t) - Eigen::Vector2d::Ones()).cwiseAbs().maxCoeff();
      EXPECT_LT(strain, 0.015);
      mean[half] += strain / static_cast<double>(sewn.triangles.size());
    }
  }
  EXPECT_LT(mean[0], 5e-3);
  EXPECT_LT(mean[1], 0.6 * mean[0]) << mean[0];
}

TEST(SewnGarment, SlidingLowersTheDistortionOnABulgingLimb) {
  // Three pieces with curved sides, as a calf stocking has, on a barrel: the distortion after sliding is less than that of the chart, no triangle is
  // turned over and stretches stay near those of the girths.
  const Limb barrel = cone_limb([](double z) { return 0.05 + 0.012 * std::sin(std::numbers::pi * z / 0.3); }, 0.0, 0.3);
  const SewnMesh sewn = mesh_pattern(checked_toml(tube_text(2, 280.0, 250.0, 60.0)), 0.015);
  const LimbPlacement placement = placed(sewn, barrel, spec_at(0.02));
  EXPECT_GT(placement.least_stretch, 0.9);
  EXPECT_LT(placement.largest_stretch, 2.0 * std::numbers::pi * 0.0622 / 0.280 * 1.03);
}

TEST(SewnGarment, UnevenHemsCoverAPartOfTheWayRound) {
  // A tube whose upper hem falls from 100 to 60 mm on one side covers all of the way round below 60 mm and a part of it above.
  const std::string text = R"(unit = "1 mm"
[[piece]]
name = "leg"
edges = [
  { name = "hem", from = [0, 0] },
  { name = "right", from = [280, 0] },
  { name = "top right", from = [280, 60] },
  { name = "top left", from = [140, 100] },
  { name = "left", from = [0, 60] },
]
[[seam]]
name = "seam"
a = "leg.left"
b = "leg.right"
)";
  const Limb limb = cylinder();
  const SewnMesh sewn = mesh_pattern(checked_toml(text), 0.01);
  const LimbPlacement placement = placed(sewn, limb, spec_at(0.03));
  EXPECT_NEAR(placement.fit.cover_at(0.06), 1.0, 1e-9);
  EXPECT_NEAR(placement.fit.cover_at(0.112), 0.5, 0.15);  // the flap shrinks round the limb, and its sides rise
  EXPECT_NEAR(placement.fit.girth_at(0.06), 0.28, 0.003);
}

TEST(SewnGarment, ALoosePatternStandsOffAsATubeOfItsWidth) {
  // A tube of two halves that is wider than the limb stands where the tube of one rectangle stands.
  const Limb limb = cylinder();
  const double width = 1.2 * limb.girth(0.1);
  const SewnMesh sewn = mesh_pattern(checked_toml(tube_text(2, 1e3 * width, 60.0)), 0.012);
  const LimbPlacement placement = placed(sewn, limb, spec_at(0.05));
  EXPECT_NEAR(placement.stand_off, (width - limb.girth(0.1)) / (2.0 * std::numbers::pi), 1e-5);
  for (int t = 0; t < static_cast<int>(sewn.triangles.size()); ++t) {
    const Eigen::Vector2d s = stretches(sewn, placement, t);
    ASSERT_NEAR(s[0], 1.0, 5e-3);
    ASSERT_NEAR(s[1], 1.0, 1e-2);
  }
}

TEST(SewnGarment, WhatGoesRoundNoLimbIsRefusedByName) {
  // One opening, unsewn pieces, an edge that is none, a garment longer than the limb, and one far too narrow each say what is wrong.
  const Limb limb = cylinder();
  const auto refused = [&](const std::string& text, const input::GarmentSpec& spec) {
    return refusal([&] { placed(mesh_pattern(checked_toml(text), 0.02), limb, spec); });
  };
  const std::string square = "unit = \"1 mm\"\n[[piece]]\nname = \"cloth\"\nedges = [ { from = [0, 0] }, { from = [200, 0] }, { from = [200, 200] }, { from = [0, 200] } ]\n";
  EXPECT_THAT(refused(square, spec_at(0.0)), testing::HasSubstr("1 opening"));
  EXPECT_THAT(refused(with(two_halves, "[[seam]]\nname = \"left\"\na = \"front.left\"\nb = \"back.left\"\n[[seam]]\nname = \"right\"\na = \"front.right\"\nb = \"back.right\"\n", ""), spec_at(0.0)),
              testing::HasSubstr("front and back are not sewn together"));
  input::GarmentSpec wrong = spec_at(0.0);
  wrong.bottom = "ankle";
  EXPECT_THAT(refused(tube_text(2, 280.0, 60.0), wrong), testing::AllOf(testing::HasSubstr("\"ankle\" is no open edge"), testing::HasSubstr("\"lower\"")));
  EXPECT_THAT(refused(tube_text(2, 280.0, 400.0), spec_at(0.0)), testing::HasSubstr("the garment covers heights 0.0 to 400.0 mm"));
  EXPECT_THAT(refused(tube_text(2, 60.0, 60.0), spec_at(0.0)), testing::HasSubstr("would be stretched to"));
}

TEST(SewnGarment, PiecesOfALargerPatternCanBeWornAlone) {
  // Of a pattern of two tubes one is chosen by the names of its pieces; a name that is none is refused with the nearest.
  std::string text = tube_text(2, 280.0, 60.0);
  text += "[[piece]]\nname = \"pocket\"\nedges = [ { from = [0, 0] }, { from = [50, 0] }, { from = [50, 50] }, { from = [0, 50] } ]\n";
  const Pattern all = parse_toml_pattern(text, "test.toml");
  const Pattern tube = selected(all, {"part 0", "part 1"}, {});
  EXPECT_EQ(tube.pieces.size(), 2u);
  EXPECT_EQ(tube.seams.size(), 2u);
  const Pattern half = selected(all, {"part 1"}, {});
  EXPECT_EQ(half.seams.size(), 0u);
  EXPECT_THAT(refusal([&] { selected(all, {"part 2"}, {}); }), testing::HasSubstr("\"part 2\" is no piece of test.toml"));
}

}  // namespace
}  // namespace snug::mesh
