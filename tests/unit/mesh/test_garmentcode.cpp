#include "tests/unit/mesh/patterns.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "mesh/pattern/json_values.hpp"

namespace snug::mesh {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Json, EveryValueHasItsPlace) {
  input::Diagnostics diagnostics;
  const input::Table table =
      parse_json("{\n \"a\": [1, -2.5e1,true],\n \"b\" : {\"c\": \"x, :y\"\n, \"d\": null}}\n", "f", diagnostics);
  EXPECT_FALSE(diagnostics.any());
  const auto place = [](const input::Location& where) {
    return std::to_string(where.line) + ":" + std::to_string(where.column);
  };
  const auto& items = *table.find("a")->array();
  EXPECT_EQ(place(table.where_is("a")), "2:2");
  EXPECT_EQ(place(items[0].where), "2:8");
  EXPECT_EQ(place(items[1].where), "2:11");
  EXPECT_EQ(place(items[2].where), "2:18");
  EXPECT_EQ(place(table.table("b")->where), "3:8");
  EXPECT_EQ(place(table.table("b")->find("c")->where), "3:14");
  EXPECT_EQ(place(table.table("b")->where_is("d")), "4:3");
}

TEST(Json, WrongSyntaxIsToldWithItsPlace) {
  const auto said = [](const std::string& text) {
    input::Diagnostics diagnostics;
    parse_json(text, "f", diagnostics);
    return diagnostics.any() ? to_string(diagnostics.errors()[0]) : std::string();
  };
  EXPECT_THAT(said("{\n \"a\": [1, 2\n}"), AllOf(HasSubstr("f:3:1: error: no JSON"), HasSubstr("']'")));
  EXPECT_THAT(said("[1, 2]"), HasSubstr("f:1:1"));
  EXPECT_THAT(said(""), HasSubstr("f:1:1"));
  EXPECT_THAT(said("{\"a\": " + std::string(60, '[') + std::string(60, ']') + "}"),
              HasSubstr("nested deeper than 32"));
  EXPECT_THAT(said("{\"a\": 1e999}"), HasSubstr("no JSON"));
}

/// A shirt's body of a front and a back half a side, as pattern programs draw them: all upright, mirrored pieces listed
/// the other way round, both halves drawn as seen from the front; nothing says how the seams run.
std::string drawn() {
  const auto panel = [](const std::string& name, double side, double neck) {
    const auto v = [&](double x, double y) { return fmt::format("[{}, {}]", side * x, y); };
    const std::string sign = side > 0 ? "" : "-";
    return "\"" + name + "\": {\"vertices\": [" + v(0, 0) + ", " + v(25, 0) + ", " + v(25, 35) + ", " + v(18, 55) +
           ", " + v(8, 57) + ", " + v(0, neck) +
           "], \"edges\": [{\"endpoints\": [0, 1], \"names\": [\"cHem\", \"sHem\"]}, {\"endpoints\": [1, 2], "
           "\"names\": [\"sHem\", \"arm\"]}, {\"endpoints\": [2, 3], \"names\": [\"arm\", "
           "\"out\"], \"curvature\": {\"type\": \"cubic\", \"params\": [[0.3, " +
           (side > 0 ? "0.2" : "-0.2") + "], [0.7, " + (side > 0 ? "0.2" : "-0.2") +
           "]]}}, {\"endpoints\": [3, 4], \"names\": [\"out\", \"in\"]}, "
           "{\"endpoints\": [4, 5], \"names\": [\"in\", \"cNeck\"]}, {\"endpoints\": [5, 0], \"names\": [\"cNeck\", "
           "\"cHem\"]}]}";
  };
  std::string text = "{\"units_in_meter\": 100, \"pattern\": {\"panels\": {" + panel("fr", 1, 48) + ",\n" +
                     panel("fl", -1, 48) + ",\n" + panel("br", 1, 54) + ",\n" + panel("bl", -1, 54) +
                     "},\n\"stitches\": [";
  const auto stitch = [](const std::string& label, const std::string& a, const std::string& b, int edge) {
    const std::string n = std::to_string(edge);
    return "{\"label\": \"" + label + "\", \"a\": {\"panel\": \"" + a + "\", \"edges\": [" + n +
           "]}, \"b\": {\"panel\": \"" + b + "\", \"edges\": [" + n + "]}}";
  };
  return text + stitch("side r", "fr", "br", 1) + ",\n" + stitch("side l", "fl", "bl", 1) + ",\n" +
         stitch("shoulder r", "fr", "br", 3) + ",\n" + stitch("shoulder l", "fl", "bl", 3) + ",\n" +
         stitch("front", "fr", "fl", 5) + ",\n" + stitch("back", "br", "bl", 5) + "]}}";
}

TEST(GarmentCode, DrawingsAreTurnedUntilTheirSeamsRunUpTogether) {
  const CheckedPattern body = checked_json(drawn());
  ASSERT_EQ(body.pattern.pieces.size(), 4u);
  for (const Piece& piece : body.pattern.pieces)
    EXPECT_EQ(piece.from_inside, piece.name[0] == 'b');  // backs are seen through the fronts
  EXPECT_EQ(body.sewing.open.size(), 4u);                // hem, neck, two armholes
  EXPECT_TRUE(body.warnings.empty());
  for (const OpenLoop& loop : body.sewing.open)
    for (std::size_t n = 0; n < loop.angles.size(); ++n)
      EXPECT_GT(loop.angles[n], 0.7 * std::numbers::pi) << loop.name;  // no corner is left over
}

TEST(GarmentCode, NamesAreThoseOfTheEnds) {
  const Pattern body = parse_garmentcode(drawn(), "f");
  EXPECT_EQ(body.pieces[1].find("arm-out") >= 0, true);
  EXPECT_EQ(body.seams[0].name, "side r");
  EXPECT_EQ(name_of(body, body.seams[0].a), "fr.sHem-arm");
}

/// A sleeveless tube in the layout that the program itself writes: placed, every outline counter-clockwise from the
/// outside.
const std::string placed = R"({
 "pattern": {
  "panels": {
   "front": {"translation": [0, 100, 20], "rotation": [0, 0, 0],
    "vertices": [[-20, 0], [20, 0], [20, 40], [-20, 40]],
    "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2], "curvature": [0.5, -0.1]}, {"endpoints": [2, 3], "label": "top"}, {"endpoints": [3, 0]}]},
   "back": {"translation": [0, 100, -20], "rotation": [0, 0, 0],
    "vertices": [[20, 0], [-20, 0], [-20, 40], [20, 40]],
    "edges": [{"endpoints": [0, 1]}, {"endpoints": [1, 2]}, {"endpoints": [2, 3], "curvature": {"type": "circle", "params": [25, 0, 1]}},
     {"endpoints": [3, 0], "curvature": {"type": "quadratic", "params": [[0.5, -0.1]]}}]}
  },
  "stitches": [[{"panel": "front", "edge": 1}, {"panel": "back", "edge": 3}], [{"panel": "front", "edge": 3}, {"panel": "back", "edge": 1}]]
 },
 "properties": {"curvature_coords": "relative", "units_in_meter": 100}
})";

TEST(GarmentCode, PlacedPanelsAreSeenFromTheOutside) {
  const CheckedPattern tube = checked_json(placed);
  const Piece &front = tube.pattern.pieces[0], &back = tube.pattern.pieces[1];
  EXPECT_FALSE(front.from_inside);
  EXPECT_TRUE(back.from_inside);
  // Wherever the piece is turned over, its points stay in space.
  const Vector2d corner = back.edges[0].curve.begin();
  EXPECT_LT((corner - Vector2d(-0.2, 0.0)).norm(), 1e-15);
  EXPECT_LT((back.place->rotation * Vector3d(corner.x(), corner.y(), 0.0) + back.place->translation -
             Vector3d(0.2, 1.0, -0.2))
                .norm(),
            1e-15);
  EXPECT_NEAR(back.place->rotation.determinant(), 1.0, 1e-15);
  EXPECT_LT((back.place->rotation.col(2) - Vector3d(0, 0, -1)).norm(), 1e-15);  // its outside looks back
  EXPECT_EQ(tube.sewing.open.size(), 2u);
}

/// Control points stand along and to the left of the chord, in its lengths; a circle that is "right" bulges to its
/// right.
TEST(GarmentCode, CurvesAreThoseOfTheLayout) {
  const Pattern tube = parse_garmentcode(placed, "f");
  const Curve& side = tube.pieces[0].edges[1].curve;
  EXPECT_LT((std::get<Quadratic>(side.spans[0]).control - Vector2d(0.24, 0.2)).norm(), 1e-15);
  const Curve& round = tube.pieces[1].edges[2].curve;  // as drawn from (-20, 40) to (20, 40); its right is below
  EXPECT_NEAR(ArcLength(round).length(), 2.0 * 0.25 * std::asin(0.2 / 0.25), 1e-14);
  EXPECT_NEAR(at(round.spans[0], 0.5).y(), 0.4 - (0.25 - 0.15), 1e-14);
}

TEST(GarmentCode, AbsoluteControlPointsAndOtherUnitsAreRead) {
  std::string text =
      with(with(placed, "\"relative\"", "\"absolute\""), "\"units_in_meter\": 100", "\"units_in_meter\": 1000");
  text = with(text, "[0.5, -0.1]}", "[24, 20]}");
  text = with(text, "[[0.5, -0.1]]", "[[24, 20]]");
  const Pattern tube = parse_garmentcode(text, "f");
  EXPECT_LT((std::get<Quadratic>(tube.pieces[0].edges[1].curve.spans[0]).control - Vector2d(0.024, 0.02)).norm(),
            1e-15);
}

TEST(GarmentCode, APanelThatIsInsideOutIsRefusedByItsName) {
  // The front listed clockwise; its stitches keep their edges.
  const std::string front =
      "[{\"endpoints\": [0, 1]}, {\"endpoints\": [1, 2], \"curvature\": [0.5, -0.1]}, {\"endpoints\": [2, 3], "
      "\"label\": \"top\"}, {\"endpoints\": [3, 0]}]";
  const std::string turned =
      "[{\"endpoints\": [0, 3]}, {\"endpoints\": [3, 2], \"label\": \"top\"}, {\"endpoints\": [2, 1], \"curvature\": "
      "[0.5, 0.1]}, {\"endpoints\": [1, 0]}]";
  std::string text = with(placed, front, turned);
  text = with(text, "[{\"panel\": \"front\", \"edge\": 1}", "[{\"panel\": \"front\", \"edge\": 2}");
  text = with(text, "[{\"panel\": \"front\", \"edge\": 3}", "[{\"panel\": \"front\", \"edge\": 0}");
  EXPECT_THAT(refusal([&] { checked_json(text); }),
              AllOf(HasSubstr("test.json:4:4"), HasSubstr("the piece front is inside out")));
}

TEST(GarmentCode, WhatIsWrongIsToldWithItsPlace) {
  struct Wrong {
    std::string what, by, place, says;
  };
  const std::vector<Wrong> wrongs = {
      {", \"units_in_meter\": 100", "", "test.json", "does not say its unit"},
      {"{\"endpoints\": [2, 3], \"label\": \"top\"}", "{\"endpoints\": [2, 9], \"label\": \"top\"}", "test.json:6:87",
       "from vertex 2 to 9, of 4"},
      {"{\"endpoints\": [2, 3], \"label\": \"top\"}", "{\"endpoints\": [2, 1], \"label\": \"top\"}",
       "test.json:6:", "outline of front is open after top"},
      {"{\"panel\": \"back\", \"edge\": 3}", "{\"panel\": \"back\", \"edge\": 4}",
       "test.json:12:", "the bare number 4 as an edge of back, which has 4"},
      {"{\"panel\": \"back\", \"edge\": 3}", "{\"panel\": \"bakc\", \"edge\": 3}",
       "test.json:12:", "the panel \"bakc\", which is not there"},
      {"{\"panel\": \"back\", \"edge\": 3}]", "{\"panel\": \"back\", \"edge\": 3}, \"right_wrong\"]",
       "test.json:12:", "outside to the inside"},
      {"\"params\": [25, 0, 1]", "\"params\": [5, 0, 1]", "test.json:9:", "a circle of radius 5 over a chord of 40"},
      {"[[20, 0], [-20, 0], [-20, 40], [20, 40]]", "[[20, 0], [-20, 0], [-20], [20, 40]]",
       "test.json:8:", "a vertex of back is no list of 2 numbers"},
      {"\"type\": \"circle\"", "\"type\": \"ellipse\"", "test.json:9:", "a curvature of \"ellipse\""},
      {"\"panels\"", "\"pannels\"", "test.json:2:13", "there are no \"panels\""},
  };
  for (const Wrong& wrong : wrongs) {
    const std::string said = refusal([&] { checked_json(with(placed, wrong.what, wrong.by)); });
    EXPECT_THAT(said, HasSubstr(wrong.place)) << wrong.by;
    EXPECT_THAT(said, HasSubstr(wrong.says)) << wrong.by;
  }
}

/// What a format holds of two patterns: areas, lengths of seams and open edges.
std::vector<double> measures(const CheckedPattern& checked) {
  std::vector<double> all;
  for (const Piece& piece : checked.pattern.pieces) all.push_back(area(piece));
  double sewn = 0.0;
  for (const Stretch& stretch : checked.sewing.stretches) sewn += stretch.partner >= 0 ? stretch.length : 0.0;
  all.push_back(sewn);
  for (const OpenLoop& loop : checked.sewing.open) {
    all.push_back(0.0);
    for (const int s : loop.stretches) all.back() += checked.sewing.stretches[s].length;
  }
  std::sort(all.begin(), all.end());
  return all;
}

TEST(GarmentCode, WhatIsWrittenIsReadBackTheSame) {
  const std::string waisted =
      with(two_halves, "{ name = \"left\", from = [200, 0] }",
           "{ name = \"left\", kind = \"spline\", from = [200, 0], through = [[180, 100], [190, 200]] }");
  for (const CheckedPattern& one : {checked_toml(cone), checked_toml(waisted), checked_json(drawn()),
                                    checked_json(placed), checked(graded(parse_toml_pattern(cone, "t"), 1.3, 1.0))}) {
    const CheckedPattern again = checked_json(garmentcode_text(one));
    const auto before = measures(one), after = measures(again);
    ASSERT_EQ(before.size(), after.size());
    for (std::size_t n = 0; n < before.size(); ++n) EXPECT_NEAR(after[n], before[n], 1e-7 * before[n]);
    for (std::size_t p = 0; p < one.pattern.pieces.size(); ++p) {
      const auto &place = one.pattern.pieces[p].place, &place_again = again.pattern.pieces[p].place;
      ASSERT_EQ(place.has_value(), place_again.has_value());
      if (!place) continue;
      EXPECT_LT(
          (place->rotation - place_again->rotation).norm() + (place->translation - place_again->translation).norm(),
          1e-12);
    }
  }
}

}  // namespace
}  // namespace snug::mesh
