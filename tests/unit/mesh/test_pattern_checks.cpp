#include "tests/unit/mesh/patterns.hpp"

namespace snug::mesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;

std::string left_edge(const std::string& by) { return with(two_halves, "{ name = \"left\", from = [200, 0] }", by); }
std::string warnings(const std::string& text) {
  std::string all;
  for (const input::Diagnostic& one : checked_toml(text).warnings) all += to_string(one) + "\n";
  return all;
}

TEST(PatternChecks, ASoundPatternPassesWithoutAWord) {
  EXPECT_THAT(warnings(two_halves), IsEmpty());
  EXPECT_THAT(warnings(cone), IsEmpty());
}

TEST(PatternChecks, AnOpenOutlineIsRefusedWithBothEdgesAndTheGap) {
  const std::string said =
      refusal([&] { checked_toml(left_edge("{ name = \"left\", from = [200, 0], to = [200, 288] }")); });
  EXPECT_THAT(said,
              AllOf(HasSubstr("test.toml:7:3"), HasSubstr("outline of front is open"),
                    HasSubstr("the edge left ends at (200.0, 288.0) mm"), HasSubstr("top"), HasSubstr("12.0 mm")));
}

TEST(PatternChecks, AnOutlineThatCrossesItselfIsRefusedWithBothEdgesAndThePlace) {
  // The left edge bulges through the right one, which stands 200 mm away.
  const std::string said = refusal([&] {
    checked_toml(left_edge("{ name = \"left\", kind = \"quadratic\", from = [200, 0], control = [[-300, 150]] }"));
  });
  EXPECT_THAT(said,
              AllOf(HasSubstr("test.toml:9:3"), HasSubstr("the edges left and right cross"), HasSubstr("(0.0, ")));
  const std::string loop = refusal([&] {
    checked_toml(
        left_edge("{ name = \"left\", kind = \"cubic\", from = [200, 0], control = [[300, 500], [300, -200]] }"));
  });
  EXPECT_THAT(loop, HasSubstr("crosses or touches itself"));
}

/// A border that runs back over itself bounds nothing there, and a corner on another edge is as bad as a crossing.
TEST(PatternChecks, AnOutlineThatTouchesItselfIsRefused) {
  const std::string back = refusal([&] {
    checked_toml(left_edge("{ name = \"left\", from = [200, 0] }, { name = \"spike\", from = [200, 350] }"));
  });
  EXPECT_THAT(back, HasSubstr("spike"));
  const std::string corner = refusal(
      [&] { checked_toml(left_edge("{ name = \"left\", from = [200, 0] }, { name = \"in\", from = [0, 150] }")); });
  EXPECT_THAT(corner, AllOf(HasSubstr("(0.0, 150.0) mm"), HasSubstr("right")));
}

/// A cut without width is a border that touches itself along a whole edge: a ring that is slit open.
TEST(PatternChecks, ACutWithoutWidthIsRefused) {
  const std::string slit = R"(unit = "1 cm"
[[piece]]
name = "skirt"
edges = [
  { name = "hem_1", kind = "arc", from = [70, 0], through = [[0, 70]] }, { name = "hem_2", kind = "arc", from = [-70, 0], through = [[0, -70]] },
  { name = "slit_a", from = [70, 0] }, { name = "waist_2", kind = "arc", from = [15, 0], through = [[0, -15]] },
  { name = "waist_1", kind = "arc", from = [-15, 0], through = [[0, 15]] }, { name = "slit_b", from = [15, 0] },
]
)";
  EXPECT_THAT(refusal([&] { checked_toml(slit); }), HasSubstr("slit_a and slit_b cross or touch"));
}

TEST(PatternChecks, APieceInsideOutIsRefusedByItsName) {
  const std::string clockwise = R"(unit = "1 mm"
[[piece]]
name = "cuff"
edges = [{ name = "a", from = [0, 0] }, { name = "b", from = [0, 50] }, { name = "c", from = [80, 50] }, { name = "d", from = [80, 0] }]
)";
  EXPECT_THAT(refusal([&] { checked_toml(clockwise); }),
              AllOf(HasSubstr("test.toml:2:"), HasSubstr("cuff is inside out")));
  EXPECT_THAT(
      refusal([&] { checked_toml(with(clockwise, "name = \"cuff\"", "name = \"cuff\"\nseen_from = \"inside\"")); }),
      IsEmpty());
}

TEST(PatternChecks, AHoleOutsideThePieceIsRefused) {
  const auto hole = [](const char* x) {
    return with(two_halves, "name = \"back\"\n",
                std::string("name = \"back\"\nholes = [{ name = \"eye\", edges = [{ from = [") + x +
                    ", 10] }, { from = [" + x + ", 20] }, { from = [190, 15] }] }]\n");
  };
  EXPECT_THAT(refusal([&] { checked_toml(hole("180")); }), IsEmpty());
  EXPECT_THAT(refusal([&] { checked_toml(hole("250")); }), AllOf(HasSubstr("cross or touch"), HasSubstr("eye edge")));
  const std::string beside = with(with(hole("250"), "[190, 15]", "[260, 15]"), "name = \"eye\"", "name = \"button\"");
  EXPECT_THAT(refusal([&] { checked_toml(beside); }),
              AllOf(HasSubstr("the hole button of back lies outside"), HasSubstr("test.toml:")));
}

TEST(PatternChecks, ANotchOffItsEdgeIsRefused) {
  const auto notch = [](const char* place) {
    return with(two_halves, "name = \"back\"\n",
                std::string("name = \"back\"\nnotches = [{ name = \"knee\", edge = \"right\", ") + place + " }]\n");
  };
  EXPECT_THAT(refusal([&] { checked_toml(notch("at = 0.4")); }), IsEmpty());
  EXPECT_THAT(refusal([&] { checked_toml(notch("at = 1.2")); }),
              AllOf(HasSubstr("test.toml:13:"), HasSubstr("knee of back stands off the edge right")));
  EXPECT_THAT(refusal([&] { checked_toml(notch("point = [200.5, 40]")); }), IsEmpty());
  EXPECT_THAT(refusal([&] { checked_toml(notch("point = [212, 40]")); }),
              AllOf(HasSubstr("knee"), HasSubstr("12.0 mm off the edge right")));
}

/// 40 % are refused, 14 % are not; what is meant may be any, and is held to.
TEST(PatternChecks, EaseOverFifteenPercentIsRefusedWhereItIsNotMeant) {
  const auto longer = [](const std::string& bow, const std::string& meant) {
    return with(left_edge("{ name = \"left\", kind = \"quadratic\", from = [200, 0], control = [[" + bow + ", 150]] }"),
                "b = \"back.left\"\n", "b = \"back.left\"\n" + meant);
  };
  const auto of = [&](const std::string& text) {
    return ease(length(parse_toml_pattern(text, "t"), EdgePart{0, 1}), 0.3);
  };
  const std::string some = longer("344", ""), much = longer("465", "");
  EXPECT_NEAR(of(some), 0.14, 0.01);
  EXPECT_NEAR(of(much), 0.40, 0.02);
  EXPECT_THAT(refusal([&] { checked_toml(some); }), IsEmpty());
  const std::string said = refusal([&] { checked_toml(much); });
  EXPECT_THAT(said, AllOf(HasSubstr("test.toml:19:"), HasSubstr("the seam left has an ease of"),
                          HasSubstr("front.left ("), HasSubstr("back.left (300.0 mm)")));
  EXPECT_THAT(refusal([&] { checked_toml(longer("465", "ease = " + std::to_string(of(much)) + "\n")); }), IsEmpty());
  EXPECT_THAT(refusal([&] { checked_toml(longer("465", "ease = 0.2\n")); }),
              HasSubstr("means an ease of 20.0 % and has"));
}

TEST(PatternChecks, AStretchThatIsSewnTwiceIsRefused) {
  const std::string more = two_halves + "[[seam]]\nname = \"again\"\na = \"front.top\"\nb = \"back.left[0..0.5]\"\n";
  EXPECT_THAT(refusal([&] { checked_toml(more); }),
              AllOf(HasSubstr("is sewn twice, by the seams"), HasSubstr("again"), HasSubstr("test.toml:27:")));
}

TEST(PatternChecks, AHemOnASewnEdgeIsRefused) {
  EXPECT_THAT(
      refusal([&] { checked_toml(two_halves + "[[hem]]\nname = \"waist\"\nedges = \"front.top + front.left\"\n"); }),
      AllOf(HasSubstr("the hem waist names front.left, which the seam left sews"), HasSubstr("test.toml:27:")));
}

TEST(PatternChecks, AFabricIsMissingWhereOnlySomePiecesHaveOne) {
  const std::string one = with(two_halves, "name = \"back\"\n", "name = \"back\"\nfabric = \"P98L2\"\n");
  EXPECT_THAT(refusal([&] { checked_toml(one); }),
              AllOf(HasSubstr("the piece front has no fabric"), HasSubstr("test.toml:3:")));
  EXPECT_THAT(refusal([&] { checked_toml(with(one, "unit = \"1 mm\"\n", "unit = \"1 mm\"\nfabric = \"N85L15\"\n")); }),
              IsEmpty());
}

TEST(PatternChecks, NamesThatStandTwiceAndSizesOfNoGarmentAreRefused) {
  EXPECT_THAT(refusal([&] { checked_toml(with(two_halves, "name = \"back\"", "name = \"front\"")); }),
              HasSubstr("a second piece has the name front"));
  EXPECT_THAT(refusal([&] { checked_toml(left_edge("{ name = \"top\", from = [200, 0] }")); }),
              HasSubstr("a second edge of front has the name top"));
  EXPECT_THAT(refusal([&] { checked_toml(with(two_halves, "unit = \"1 mm\"", "unit = \"1 m\"")); }),
              HasSubstr("the piece front measures 2e+05 mm"));
  EXPECT_THAT(
      refusal([&] {
        checked_toml(left_edge("{ name = \"left\", from = [200, 0] }, { name = \"nothing\", from = [200, 300] }"));
      }),
      HasSubstr("the edge nothing of front has no length"));
}

/// Both sides open: four corners of 90 degrees. One seam sewn: its hems run straight over it, and the two edges of the
/// other are found.
TEST(PatternChecks, AnUnsewnEdgeThatLooksLikeASeamIsWarnedOf) {
  const auto cut = two_halves.find("[[seam]]\nname = \"right\"");
  const std::string said = warnings(two_halves.substr(0, cut));
  EXPECT_THAT(said, AllOf(HasSubstr("back.right (300.0 mm) and front.right (300.0 mm)"), HasSubstr("look like a seam"),
                          HasSubstr("test.toml:")));
  EXPECT_THAT(said, Not(HasSubstr("top")));
}

TEST(PatternChecks, HandlesAndSidesThatDoNotHangTogetherAreWarnedOf) {
  // The halves of one side in the wrong order: the middle of the back meets both ends of the front.
  const std::string twisted = with(two_halves, "b = \"back.left\"", "b = \"back.left[0.5..1] + back.left[0..0.5]\"");
  EXPECT_THAT(warnings(twisted),
              AllOf(HasSubstr("the edge back.left[0.5..1] does not end where back.left[0..0.5] begins"),
                    HasSubstr("front and what hangs on it has 1 handle")));
}

TEST(PatternChecks, AStretchThatDoesNotFitIsWarnedOf) {
  const std::string notched =
      with(with(two_halves, "name = \"front\"\n",
                "name = \"front\"\nnotches = [{ name = \"n\", edge = \"left\", at = 0.2 }]\n"),
           "name = \"back\"\n", "name = \"back\"\nnotches = [{ name = \"n\", edge = \"left\", at = 0.2 }]\n");
  EXPECT_THAT(warnings(notched), AllOf(HasSubstr("in the seam left the stretch"), HasSubstr("see its notches")));
}

}  // namespace
}  // namespace snug::mesh
