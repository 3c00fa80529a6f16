#include "tests/unit/mesh/patterns.hpp"

#include <cmath>
#include <numbers>

namespace snug::mesh {
namespace {

using Eigen::Vector2d;
using testing::HasSubstr;
using std::numbers::pi;

TEST(TomlPattern, LengthsAndAreasAreThoseOfTheDrawing) {
  const CheckedPattern leg = checked_toml(cone);
  const Piece& piece = leg.pattern.pieces[0];
  EXPECT_NEAR(area(piece), pi / 3.0 * (0.25 * 0.25 - 0.1 * 0.1), 1e-14);
  EXPECT_NEAR(length(leg.pattern, leg.pattern.seams[0].a), 0.15, 1e-14);
  ASSERT_EQ(leg.sewing.open.size(), 2u);
  EXPECT_EQ(leg.sewing.open[0].name, "inner");
  EXPECT_EQ(leg.sewing.open[1].name, "outer");
  EXPECT_TRUE(leg.warnings.empty());
}

TEST(TomlPattern, EveryKindOfEdgeIsRead) {
  const Pattern pattern = parse_toml_pattern(R"(unit = "1 mm"
fabric = "N85L15"
[[piece]]
name = "all kinds"
grain = [[0, 0], [30, 40]]
fabric = { E = "1 MPa" }
edges = [
  { name = "straight", from = [0, 0] },
  { name = "bow", kind = "quadratic", from = [100, 0], control = [[120, 50]] },
  { name = "wave", kind = "cubic", from = [100, 100], control = [[80, 120], [60, 80]] },
  { name = "round", kind = "arc", from = [40, 100], through = [[15, 95]] },
  { name = "spline", kind = "spline", from = [0, 80], through = [[-10, 60], [10, 20]] },
]
holes = [{ name = "eye", edges = [{ kind = "arc", from = [40, 50], through = [[50, 60]] }, { kind = "arc", from = [60, 50], through = [[50, 40]] }] }]
notches = [{ name = "n", edge = "straight", at = 0.25 }, { name = "p", edge = "straight", point = [60, 0.5] }]
lines = [{ name = "fold", from = [10, 10], to = [20, 90] }]
)",
                                             "test.toml");
  const Piece& piece = pattern.pieces[0];
  ASSERT_EQ(piece.edges.size(), 7u);
  EXPECT_LT((piece.grain - Vector2d(0.6, 0.8)).norm(), 1e-15);
  EXPECT_TRUE(std::holds_alternative<Quadratic>(piece.edges[1].curve.spans[0]));
  EXPECT_TRUE(std::holds_alternative<Cubic>(piece.edges[2].curve.spans[0]));
  EXPECT_TRUE(std::holds_alternative<Arc>(piece.edges[3].curve.spans[0]));
  EXPECT_EQ(piece.edges[4].curve.spans.size(), 3u);
  EXPECT_EQ(piece.edges[5].name, "eye edge1");
  EXPECT_LT(swept_area(piece.edges[5].curve) + swept_area(piece.edges[6].curve), 0.0);  // a hole runs clockwise
  EXPECT_NEAR(piece.notches[0].share, 0.25, 1e-15);
  EXPECT_NEAR(piece.notches[1].share, 0.6, 1e-6);
  EXPECT_EQ(piece.lines.size(), 1u);
  EXPECT_EQ(pattern.fabric->name, "N85L15");
  EXPECT_TRUE(piece.fabric->is_inline());
}

/// Seen from its inside the same piece is drawn with x the other way; as read it is the same again.
TEST(TomlPattern, APieceDrawnFromItsInsideIsTurnedOver) {
  const std::string inside = R"(unit = "1 mm"
[[piece]]
name = "p"
seen_from = "inside"
grain = [[0, 0], [10, 20]]
edges = [{ name = "a", from = [0, 0] }, { name = "b", from = [-100, 0] }, { name = "c", from = [-20, 50] }]
holes = [{ edges = [{ kind = "arc", from = [-40, 10], through = [[-45, 15]] }, { kind = "arc", from = [-50, 10], through = [[-45, 5]] }] }]
)";
  const CheckedPattern turned = checked_toml(inside);
  const Piece& piece = turned.pattern.pieces[0];
  EXPECT_TRUE(piece.from_inside);
  EXPECT_LT((piece.edges[1].curve.begin() - Vector2d(0.1, 0.0)).norm(), 1e-15);
  EXPECT_LT(piece.grain.x(), 0.0);
  EXPECT_NEAR(area(piece), 0.5 * 0.1 * 0.05 - pi * 25e-6, 1e-15);
}

TEST(TomlPattern, AMirrorImageHasTheSameAreaAndItsEdgesRunTheOtherWay) {
  const std::string text = R"(unit = "1 mm"
[[piece]]
name = "left"
edges = [{ name = "a", from = [0, 0] }, { name = "b", from = [100, 0] }, { name = "in", from = [60, 80] }, { name = "out", from = [50, 40] }, { name = "c", from = [40, 80] }]
darts = [{ name = "dart", sides = ["in", "out"] }]
notches = [{ name = "n", edge = "b", at = 0.25 }]
[[piece]]
name = "right"
mirror_of = "left"
[[seam]]
name = "middle"
a = "left.b"
b = "right.b"
)";
  const CheckedPattern both = checked_toml(text);
  const Piece &left = both.pattern.pieces[0], &right = both.pattern.pieces[1];
  EXPECT_NEAR(area(left), area(right), 1e-16);
  const Curve &b = left.edges[left.find("b")].curve, &image = right.edges[right.find("b")].curve;
  EXPECT_LT((image.begin() - Vector2d(-b.end().x(), b.end().y())).norm(), 1e-15);
  EXPECT_NEAR(right.notches[0].share, 0.75, 1e-15);
  EXPECT_EQ(both.pattern.seams.size(), 3u);  // its dart, too
  EXPECT_EQ(both.sewing.open.size(), 1u);
}

TEST(TomlPattern, PartsOfEdgesAreReadAndNamed) {
  const Pattern pattern = parse_toml_pattern(two_halves, "t");
  input::Diagnostics diagnostics;
  const EdgeChain chain = edge_chain("front.left[0..0.4] + back.hem", pattern, {}, diagnostics);
  ASSERT_EQ(chain.size(), 2u);
  EXPECT_NEAR(length(pattern, chain), 0.4 * 0.3 + 0.2, 1e-15);
  EXPECT_EQ(name_of(pattern, chain), "front.left[0..0.4] + back.hem");
}

struct Wrong {
  std::string what, by, place, says;
};

/// Each error of a text stands with its place and names what it means.
TEST(TomlPattern, WhatIsWrongIsToldWithItsPlace) {
  const std::vector<Wrong> wrongs = {
      {"unit = \"1 mm\"", "unit = 1", "test.toml:2:8", "bare number"},
      {"unit = \"1 mm\"\n", "", "test.toml", "unit"},
      {"name = \"top\", from = [200, 300] },\n  { name = \"right\", from = [0, 300]",
       "name = \"top\", from = [200, \"300\"] },\n  { name = \"right\", from = [0, 300]", "test.toml:8:32", "from"},
      {"a = \"front.left\"", "a = \"front.lefft\"",
       "test.toml:19:", "the piece front has no edge \"lefft\"; did you mean left"},
      {"a = \"front.left\"", "a = \"fromt.left\"", "test.toml:19:", "no piece \"fromt\"; did you mean front"},
      {"a = \"front.left\"", "a = \"front.left[0.5..0.4]\"", "test.toml:19:", "no part of an edge"},
      {"a = \"front.left\"", "a = \"front.left[0..1.5]\"", "test.toml:19:", "no part of an edge"},
      {"a = \"front.left\"", "a = \"left\"", "test.toml:19:", "names no edge"},
      {"a = \"front.left\"", "c = \"front.left\"", "test.toml:21:1", "unknown key c"},
      {"name = \"front\"", "name = \"front.1\"", "test.toml:3:", "no name for a piece"},
      {"{ name = \"left\", from = [200, 0] }",
       "{ name = \"left\", kind = \"cubic\", from = [200, 0], control = [[1, 1]] }", "test.toml:7:3",
       "cubic with 1 control points"},
      {"{ name = \"left\", from = [200, 0] }",
       "{ name = \"left\", kind = \"spline\", from = [200, 0], through = [[200, 0]] }", "test.toml:7:3",
       "a point twice"},
      {"{ name = \"left\", from = [200, 0] }", "{ name = \"left\", kind = \"zigzag\", from = [200, 0] }",
       "test.toml:7:", "\"zigzag\" is no kind"},
  };
  for (const Wrong& wrong : wrongs) {
    const std::string said = refusal([&] { checked_toml(with(two_halves, wrong.what, wrong.by)); });
    EXPECT_THAT(said, HasSubstr(wrong.place)) << wrong.by;
    EXPECT_THAT(said, HasSubstr(wrong.says)) << wrong.by;
  }
}

}  // namespace
}  // namespace snug::mesh
