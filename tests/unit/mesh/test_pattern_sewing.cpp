#include "tests/unit/mesh/patterns.hpp"

#include <cmath>
#include <numbers>

namespace snug::mesh {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> open_names(const CheckedPattern& checked) {
  std::vector<std::string> names;
  for (const OpenLoop& loop : checked.sewing.open) names.push_back(loop.name);
  return names;
}

/// Vertices - sides + pieces of the sewn surface, each piece a disc: 2 - 2 (handles) - (open edges), for one part.
int euler(const CheckedPattern& checked) {
  const Sewing& sewing = checked.sewing;
  const std::set<int> corners(sewing.corners.begin(), sewing.corners.end());
  int sides = 0;
  for (std::size_t s = 0; s < sewing.stretches.size(); ++s) sides += sewing.stretches[s].partner < static_cast<int>(s);
  return static_cast<int>(corners.size()) - sides + static_cast<int>(checked.pattern.pieces.size());
}

TEST(PatternSewing, TwoHalvesMakeATubeWithTwoHems) {
  const CheckedPattern tube = checked_toml(two_halves);
  EXPECT_EQ(euler(tube), 0);
  EXPECT_THAT(open_names(tube), ElementsAre("hem", "top"));
  for (const OpenLoop& loop : tube.sewing.open)
    for (const double angle : loop.angles) EXPECT_NEAR(angle, std::numbers::pi, 1e-12);  // straight over the seams
}

TEST(PatternSewing, OutsidesMeetOneSideForwardsAndTheOtherBackwards) {
  const CheckedPattern tube = checked_toml(two_halves);
  for (const Stretch& one : tube.sewing.stretches) {
    if (one.partner < 0) continue;
    const Stretch& other = tube.sewing.stretches[one.partner];
    EXPECT_EQ(tube.sewing.corners[one.begin], tube.sewing.corners[other.end]);
    EXPECT_EQ(tube.sewing.corners[one.end], tube.sewing.corners[other.begin]);
    EXPECT_NE(tube.sewing.corners[one.begin], tube.sewing.corners[one.end]);
  }
}

/// The lower end of one side meets the lower end of the other: both pieces are drawn upright.
TEST(PatternSewing, WhatIsDrawnUprightIsSewnUpright) {
  const CheckedPattern tube = checked_toml(two_halves);
  for (const Stretch& one : tube.sewing.stretches) {
    if (one.partner < 0) continue;
    const EdgePart other = tube.sewing.stretches[one.partner].part;
    const auto& pieces = tube.pattern.pieces;
    EXPECT_EQ(pieces[one.part.piece].edges[one.part.edge].curve.begin().y(),
              pieces[other.piece].edges[other.edge].curve.end().y());
  }
}

TEST(PatternSewing, ADartClosesToAPointInsideTheCloth) {
  const CheckedPattern dart = checked_toml(R"(unit = "1 mm"
[[piece]]
name = "p"
edges = [
  { name = "a", from = [0, 0] }, { name = "b", from = [200, 0] }, { name = "t1", from = [200, 100] }, { name = "in", from = [110, 100] },
  { name = "out", from = [100, 40] }, { name = "t2", from = [90, 100] }, { name = "c", from = [0, 100] },
]
darts = [{ sides = ["in", "out"] }]
)");
  EXPECT_EQ(euler(dart), 1);  // a disc
  ASSERT_EQ(dart.sewing.open.size(), 1u);
  EXPECT_EQ(dart.sewing.open[0].stretches.size(), 5u);
  EXPECT_EQ(dart.pattern.seams[0].name, "p.dart 1");
}

/// A square pocket bag: four seams, all of a square on a square; nothing stays open, a sphere.
TEST(PatternSewing, TwoSquaresSewnAllRoundAreClosed) {
  const std::string square =
      R"(edges = [{ name = "s", from = [0, 0] }, { name = "e", from = [100, 0] }, { name = "n", from = [100, 100] }, { name = "w", from = [0, 100] }])";
  std::string text =
      "unit = \"1 mm\"\n[[piece]]\nname = \"a\"\n" + square + "\n[[piece]]\nname = \"b\"\n" + square + "\n";
  // Seen from its own outside the other square has its west where this one has its east.
  for (const auto& [one, other] : {std::pair("s", "s"), std::pair("e", "w"), std::pair("n", "n"), std::pair("w", "e")})
    text += std::string("[[seam]]\na = \"a.") + one + "\"\nb = \"b." + other + "\"\n";
  const CheckedPattern bag = checked_toml(text);
  EXPECT_EQ(euler(bag), 2);
  EXPECT_TRUE(bag.sewing.open.empty());
  EXPECT_TRUE(bag.warnings.empty());
}

/// A sleeve of one piece into the armhole of two: corners of either side are corners of the other, at equal shares.
const std::string armhole = R"(unit = "1 mm"
[[piece]]
name = "front"
edges = [{ name = "hem", from = [0, 0] }, { name = "side", from = [200, 0] }, { name = "armhole", from = [200, 300] }, { name = "shoulder", from = [150, 480] }, { name = "centre", from = [0, 480] }]
[[piece]]
name = "back"
edges = [{ name = "hem", from = [-200, 0] }, { name = "centre", from = [0, 0] }, { name = "shoulder", from = [0, 480] }, { name = "armhole", from = [-150, 480] }, { name = "side", from = [-200, 300] }]
[[piece]]
name = "sleeve"
edges = [{ name = "cuff", from = [0, 0] }, { name = "right", from = [370, 0] }, { name = "cap", from = [373, 200] }, { name = "left", from = [0, 200] }]
[[seam]]
name = "side"
a = "front.side"
b = "back.side"
[[seam]]
name = "shoulder"
a = "front.shoulder"
b = "back.shoulder"
[[seam]]
name = "cap"
a = "sleeve.cap"
b = "back.armhole + front.armhole"
[[seam]]
name = "under arm"
a = "sleeve.left"
b = "sleeve.right"
)";

/// The armhole is a loop: begun at the shoulder or under the arm, it is sewn all round, and that is where the sleeve's
/// own seam ends.
TEST(PatternSewing, ASideMayRunOverSeveralPieces) {
  for (const bool shoulder : {true, false}) {
    const CheckedPattern shirt = checked_toml(
        shoulder ? armhole : with(armhole, "back.armhole + front.armhole", "front.armhole + back.armhole"));
    EXPECT_TRUE(shirt.warnings.empty());
    EXPECT_EQ(shirt.sewing.open.size(), 2u);  // cuff, and hem with centres and neck
    std::map<std::string, int> corner;        // where an edge begins, after sewing
    for (const Stretch& stretch : shirt.sewing.stretches)
      if (stretch.part.from == 0.0)
        corner[name_of(shirt.pattern, EdgePart{stretch.part.piece, stretch.part.edge})] =
            shirt.sewing.corners[stretch.begin];
    EXPECT_EQ(corner.at("sleeve.cap") == corner.at("front.shoulder"), shoulder);
    EXPECT_EQ(corner.at("sleeve.cap") == corner.at("front.armhole"), !shoulder);
    EXPECT_EQ(corner.at("sleeve.cap"), corner.at("sleeve.left"));
  }
}

TEST(PatternSewing, EaseIsSpreadEvenly) {
  const CheckedPattern shirt =
      checked_toml(with(armhole, "back.armhole + front.armhole", "front.armhole + back.armhole"));
  int stretches = 0;
  for (const Stretch& stretch : shirt.sewing.stretches) {
    if (stretch.partner < 0 || shirt.pattern.seams[stretch.seam].name != "cap") continue;
    ++stretches;
    EXPECT_NEAR(ease(stretch.length, shirt.sewing.stretches[stretch.partner].length),
                ease(373.0, 2.0 * std::hypot(50.0, 180.0)), 1e-12);
  }
  EXPECT_EQ(stretches, 4);  // two of the cap, one of each armhole
}

TEST(PatternSewing, NotchesOfOneNameMeet) {
  std::string text = with(two_halves, "name = \"front\"\n",
                          "name = \"front\"\nnotches = [{ name = \"n\", edge = \"left\", at = 0.45 }]\n");
  text = with(text, "name = \"back\"\n", "name = \"back\"\nnotches = [{ name = \"n\", edge = \"left\", at = 0.5 }]\n");
  const CheckedPattern tube = checked_toml(text);
  const auto places = stations(tube.pattern, tube.pattern.seams[0]);
  ASSERT_EQ(places.size(), 3u);
  EXPECT_NEAR(places[1][0], 0.45, 1e-12);
  EXPECT_NEAR(places[1][1], 0.5, 1e-12);
}

TEST(PatternSewing, NotchesThatCrossAreRefused) {
  std::string text = with(two_halves, "name = \"front\"\n",
                          "name = \"front\"\nnotches = [{ name = \"m\", edge = \"left\", at = 0.3 }, { name = \"n\", "
                          "edge = \"left\", at = 0.6 }]\n");
  text = with(text, "name = \"back\"\n",
              "name = \"back\"\nnotches = [{ name = \"m\", edge = \"left\", at = 0.3 }, { name = \"n\", edge = "
              "\"left\", at = 0.6 }]\n");
  EXPECT_THAT(refusal([&] { checked_toml(text); }),
              HasSubstr("do not come in the same order on both sides"));  // back.left is walked from its end
}

/// Corners of the two sides that nearly meet are one; a drafted pattern agrees to some tenths of a millimetre.
TEST(PatternSewing, CornersThatNearlyMeetAreOne) {
  std::string text = with(two_halves, "{ name = \"left\", from = [200, 0] }",
                          "{ name = \"left\", from = [200, 0] }, { name = \"left2\", from = [200, 100] }");
  text = with(text, "{ name = \"left\", from = [0, 300] }",
              "{ name = \"left\", from = [0, 300] }, { name = \"left2\", from = [0, 100.4] }");
  text = with(with(text, "a = \"front.left\"", "a = \"front.left + front.left2\""), "b = \"back.left\"",
              "b = \"back.left + back.left2\"");
  const CheckedPattern tube = checked_toml(text);
  EXPECT_EQ(stations(tube.pattern, tube.pattern.seams[0]).size(), 3u);
  EXPECT_EQ(stations(checked_toml(with(text, "[0, 100.4]", "[0, 110]")).pattern, tube.pattern.seams[0]).size(), 4u);
}

TEST(PatternSewing, AHemNamesALoopOrAPartOfOne) {
  EXPECT_THAT(open_names(checked_toml(two_halves + "[[hem]]\nname = \"waist\"\nedges = \"front.top + back.top\"\n")),
              ElementsAre("hem", "waist"));
  const CheckedPattern part = checked_toml(two_halves + "[[hem]]\nname = \"fly\"\nedges = \"front.top[0.2..0.6]\"\n");
  EXPECT_THAT(open_names(part), ElementsAre("hem", "top"));
  EXPECT_EQ(part.sewing.open[1].stretches.size(), 4u);
}

/// A sleeve that is drawn for the other arm: its seams run from the neck to the underarm on one side and back on the
/// other.
TEST(PatternSewing, ASleeveOfTheOtherArmIsWarnedOf) {
  const std::string raglan = R"(unit = "1 cm"
[[piece]]
name = "front"
edges = [{ name = "hem", from = [-25, 0] }, { name = "side_l", from = [25, 0] }, { name = "raglan_l", from = [25, 35] }, { name = "neck", from = [9, 56] }, { name = "raglan_r", from = [-9, 56] }, { name = "side_r", from = [-25, 35] }]
[[piece]]
name = "back"
edges = [{ name = "hem", from = [-25, 0] }, { name = "side_r", from = [25, 0] }, { name = "raglan_r", from = [25, 35] }, { name = "neck", from = [9, 56] }, { name = "raglan_l", from = [-9, 56] }, { name = "side_l", from = [-25, 35] }]
[[piece]]
name = "left"
edges = [{ name = "cuff", from = [-14, -20] }, { name = "under_b", from = [14, -20] }, { name = "back", from = [18, 10] }, { name = "top", from = [4, 32] }, { name = "front", from = [-4, 32] }, { name = "under_f", from = [-18, 10] }]
[[piece]]
name = "right"
mirror_of = "left"
)";
  std::string seams;
  for (const char* seam : {"front.side_l=back.side_l", "front.side_r=back.side_r", "front.raglan_l=left.front",
                           "back.raglan_l=left.back", "front.raglan_r=right.front", "back.raglan_r=right.back",
                           "left.under_f=left.under_b", "right.under_f=right.under_b"}) {
    const std::string both = seam;
    seams +=
        "[[seam]]\na = \"" + both.substr(0, both.find('=')) + "\"\nb = \"" + both.substr(both.find('=') + 1) + "\"\n";
  }
  const CheckedPattern right = checked_toml(raglan + seams);
  EXPECT_TRUE(right.warnings.empty());
  EXPECT_EQ(right.sewing.open.size(), 4u);  // hem, neck, two cuffs
  std::string other = raglan;               // the left sleeve with front and back exchanged
  for (const auto& [what, by] : {std::pair("\"under_b\", from = [14", "\"under_f\", from = [14"),
                                 std::pair("\"back\", from = [18", "\"front\", from = [18"),
                                 std::pair("\"front\", from = [-4", "\"back\", from = [-4"),
                                 std::pair("\"under_f\", from = [-18", "\"under_b\", from = [-18")})
    other = with(other, what, by);
  const CheckedPattern wrong = checked_toml(other + seams);
  ASSERT_FALSE(wrong.warnings.empty());
  EXPECT_THAT(to_string(wrong.warnings[0]), HasSubstr("degrees of cloth meet at an open edge"));
}

TEST(PatternSewing, GradingStretchesAcrossAndAlong) {
  const Pattern pattern = parse_toml_pattern(cone, "t"), larger = graded(pattern, 1.1, 0.9);
  EXPECT_NEAR(area(larger.pieces[0]), 0.99 * area(pattern.pieces[0]), 1e-15);
  const Eigen::Vector2d before = box(pattern.pieces[0]).sizes(), after = box(larger.pieces[0]).sizes();
  EXPECT_NEAR(after.x(), 1.1 * before.x(), 1e-12);
  EXPECT_NEAR(after.y(), 0.9 * before.y(), 1e-12);
  EXPECT_TRUE(checked(larger).warnings.empty());
}

}  // namespace
}  // namespace snug::mesh
