#include "tests/unit/mesh/patterns.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "mesh/pattern/drawing.hpp"
#include "mesh/pattern/dxf_pattern.hpp"
#include "mesh/pattern/read_pattern.hpp"
#include "mesh/pattern/svg_path.hpp"
#include "mesh/pattern/svg_pattern.hpp"
#include "mesh/pattern/svg_text.hpp"

namespace snug::mesh {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using std::numbers::pi;

const fs::path data = fs::path(SNUG_SOURCE_DIR) / "tests/data/patterns";

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(PatternDrawing, ShowsPiecesSeamsAndLengths) {
  const std::string svg = drawing_svg(checked_toml(two_halves));
  for (const char* what :
       {"<title>Tube of two halves</title>", ">front<", ">600 cm²<", ">left  300 mm<", ">hem  200 mm<",
        "300.0 and 300.0 mm, ease 0.0 %", "front.left  to  back.left", ">400.0 mm, open<", "100 mm"})
    EXPECT_THAT(svg, HasSubstr(what));
}

/// Each seam has one colour, on both of its sides and in the list.
TEST(PatternDrawing, BothSidesOfASeamHaveOneColour) {
  const std::string svg = drawing_svg(checked_toml(two_halves));
  std::map<std::string, int> strokes;
  for (auto at = svg.find("class=\"seam\""); at != std::string::npos; at = svg.find("class=\"seam\"", at + 1)) {
    const auto from = svg.find("stroke=\"", at) + 8;
    ++strokes[svg.substr(from, svg.find('"', from) - from)];
  }
  EXPECT_EQ(strokes.size(), 2u);
  for (const auto& [colour, count] : strokes) EXPECT_EQ(count, 2);
}

TEST(PatternDrawing, TextsAreHarmlessInXml) {
  EXPECT_EQ(xml_text("<a \"b\"> & \x01 \xff \xc3\xa4 \xed\xa0\x80"), "&lt;a &quot;b&quot;&gt; &amp; ? ? \xc3\xa4 ???");
}

TEST(PatternDrawing, WhatIsDrawnIsReadBackTheSame) {
  for (const CheckedPattern& one : {checked_toml(cone), checked(read_pattern(data / "skirt.toml"))}) {
    const Pattern again = parse_svg(drawing_svg(one), "drawing.svg");
    ASSERT_EQ(again.pieces.size(), one.pattern.pieces.size());
    for (std::size_t p = 0; p < again.pieces.size(); ++p) {
      EXPECT_EQ(again.pieces[p].name, one.pattern.pieces[p].name);
      EXPECT_NEAR(area(again.pieces[p]), area(one.pattern.pieces[p]), 1e-7 * area(one.pattern.pieces[p]));
    }
  }
}

std::string svg(const std::string& head, const std::string& body) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" " + head + ">\n" + body + "\n</svg>";
}

/// Commands of every kind; the second subpath is made of the relative forms of the first.
TEST(SvgPath, EveryCommandIsRead) {
  std::string fault;
  const auto paths = parse_svg_path(
      "M10 10L20,10 H30 V20 C30 30 20 30 20 20S10 10 10 20 Q5 20 5 15T10 10Z m0 100 l10 0 h10 v10 c0 10-10 10-10 "
      "0s-10-10-10 0 q-5 0-5-5t5-5z",
      fault);
  EXPECT_EQ(fault, "");
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_NEAR(ArcLength(paths[0]).length(), ArcLength(paths[1]).length(), 1e-12);
  EXPECT_EQ(paths[0].spans.size(), 7u);
  EXPECT_LT((std::get<Cubic>(paths[0].spans[4]).first - Vector2d(20, 10)).norm(), 1e-15);       // reflected
  EXPECT_LT((std::get<Quadratic>(paths[0].spans[6]).control - Vector2d(5, 10)).norm(), 1e-15);  // reflected
}

/// A quarter of a circle of radius 10 and three quarters, each to both sides; flags may stand without spaces.
TEST(SvgPath, ArcsAreThoseOfTheStandard) {
  std::string fault;
  const auto length = [&](const std::string& arc) {
    return ArcLength(parse_svg_path("M10 0" + arc, fault)[0]).length();
  };
  EXPECT_NEAR(length("A10 10 0 0 1 0 10"), 5.0 * pi, 1e-12);
  EXPECT_NEAR(length("A10 10 0 11 0 10"), 15.0 * pi, 1e-12);
  EXPECT_NEAR(length("A1 1 0 0 1 -10 0"), 10.0 * pi, 1e-12);  // radii too small grow
  const Curve quarter = parse_svg_path("M10 0A10 10 0 0 1 0 10", fault)[0],
              ellipse = parse_svg_path("M20 0A20 10 0 0 1 0 10", fault)[0];
  EXPECT_LT((at(quarter.spans[0], 0.5) - Vector2d(std::sqrt(50.0), std::sqrt(50.0))).norm(), 1e-13);
  EXPECT_LT((at(ellipse.spans[0], 0.5) - Vector2d(20.0, 10.0) * std::sqrt(0.5)).norm(), 1e-13);
  EXPECT_EQ(fault, "");
  parse_svg_path("M 0 0 L 1", fault);
  EXPECT_NE(fault, "");
}

TEST(SvgPattern, SizeAndTransformsAreApplied) {
  // 100 by 50 units of 2 mm, turned by a quarter, and a hole; the path runs clockwise on paper.
  const Pattern pattern = parse_svg(svg("width=\"400mm\" height=\"400mm\" viewBox=\"0 0 200 200\"",
                                        "<g transform=\"translate(10 20) rotate(90)\"><path id=\"a.b\" d=\"M0 0 H100 "
                                        "V50 H0Z M20 20 h10 v10 h-10z\"/></g><path d=\"M0 0 L5 5\"/>"),
                                    "f.svg");
  ASSERT_EQ(pattern.pieces.size(), 1u);
  const Piece& piece = pattern.pieces[0];
  EXPECT_EQ(piece.name, "a_b");
  EXPECT_NEAR(area(piece), 0.2 * 0.1 - 0.02 * 0.02, 1e-15);
  EXPECT_EQ(piece.edges.size(), 8u);
  EXPECT_LT((box(piece).sizes() - Vector2d(0.1, 0.2)).norm(), 1e-15);
  EXPECT_EQ(refusal([&] { checked(pattern); }), "");
}

TEST(SvgPattern, WhatIsWrongIsToldWithItsPlace) {
  const auto said = [](const std::string& text) { return refusal([&] { checked(parse_svg(text, "f.svg")); }); };
  const std::string size = "width=\"400mm\" height=\"400mm\" viewBox=\"0 0 200 200\"";
  EXPECT_THAT(said(svg("width=\"400\" height=\"400\"", "<path d=\"M0 0 H10 V10Z\"/>")),
              AllOf(HasSubstr("f.svg:1:1"), HasSubstr("does not say how large it is")));
  EXPECT_THAT(said(svg("width=\"400mm\" height=\"300mm\" viewBox=\"0 0 200 200\"", "")), HasSubstr("two scales"));
  EXPECT_THAT(said(svg(size, "<path d=\"M0 0 L10 10\"/>")), HasSubstr("no closed path"));
  EXPECT_THAT(said(svg(size, "\n<path d=\"M0 0 H50 V50 L&amp;\"/>")),
              AllOf(HasSubstr("f.svg:3:1"), HasSubstr("cannot be read")));
  EXPECT_THAT(said(svg(size, "<g transform=\"turn(3)\"><path d=\"M0 0 H50 V50Z\"/></g>")),
              AllOf(HasSubstr("f.svg:2:1"), HasSubstr("turn(3)")));
  EXPECT_THAT(said(svg(size, "<path d=\"M0 0 H50 V50 L20 -10Z\"/>")), HasSubstr("cross or touch"));
  EXPECT_THAT(said("<svg"), HasSubstr("no SVG"));
}

TEST(DxfPattern, OutlineTurnPointsNotchesGrainAndCutOutsAreRead) {
  const Pattern tube = parse_dxf(text_of(data / "tube.dxf"), "tube.dxf");
  ASSERT_EQ(tube.pieces.size(), 2u);
  const Piece &front = tube.pieces[0], &back = tube.pieces[1];
  EXPECT_EQ(front.name, "Front");
  ASSERT_EQ(front.edges.size(), 5u);
  EXPECT_NEAR(ArcLength(front.edges[0].curve).length(), 0.2, 1e-15);
  EXPECT_TRUE(std::holds_alternative<Cubic>(front.edges[2].curve.spans[0]));  // through its curve points
  EXPECT_EQ(front.loops.size(), 2u);
  EXPECT_NEAR(front.notches[0].share, 0.4, 1e-6);
  EXPECT_EQ(front.notches[0].edge, 1);
  EXPECT_EQ(front.lines.size(), 1u);
  EXPECT_NEAR(area(back), 0.06, 1e-15);  // drawn clockwise, without turn points, its end where it begins
  EXPECT_EQ(back.edges.size(), 4u);
  EXPECT_EQ(refusal([&] { checked(tube); }), "");
}

TEST(DxfPattern, PiecesOfOneNameAreNumbered) {
  const Pattern tube = parse_dxf(with(text_of(data / "tube.dxf"), "Piece Name: Back", "Piece Name: Front"), "tube.dxf");
  EXPECT_EQ(tube.pieces[1].name, "Front 2");
}

TEST(DxfPattern, WithoutAUnitItIsRefused) {
  const std::string text = text_of(data / "tube.dxf"), none = with(text, "UNITS: METRIC", "UNITS");
  const auto said = [](const std::string& of) { return refusal([&] { parse_dxf(of, "tube.dxf"); }); };
  EXPECT_THAT(said(none), AllOf(HasSubstr("tube.dxf: error: the file does not say its unit"), HasSubstr("$INSUNITS")));
  EXPECT_NEAR(area(parse_dxf(with(text, "UNITS: METRIC", "UNITS: ENGLISH"), "f").pieces[1]), 0.06 * 25.4 * 25.4, 1e-10);
  const auto header = [](const char* units) {
    return std::string("  0\nSECTION\n  2\nHEADER\n  9\n$INSUNITS\n 70\n") + units + "\n  0\nENDSEC\n";
  };
  EXPECT_NEAR(area(parse_dxf(header("5") + none, "f").pieces[1]), 0.06 * 100.0, 1e-12);
  EXPECT_THAT(said(header("1") + text), HasSubstr("say two units"));
}

TEST(DxfPattern, WhatIsWrongIsToldWithItsPlace) {
  const std::string text = text_of(data / "tube.dxf");
  const auto said = [](const std::string& of) { return refusal([&] { checked(parse_dxf(of, "tube.dxf")); }); };
  EXPECT_THAT(said("nonsense"), HasSubstr("no section of a DXF file"));
  EXPECT_THAT(said(with(text, " 10\n0\n 20\n180\n", " 10\n12\n 20\n180\n")),
              AllOf(HasSubstr("tube.dxf:"), HasSubstr("Back notch 1 stands 12.0 mm off the outline")));
  const auto line = text.find("  0\nLINE\n  8\n7\n");
  ASSERT_NE(line, std::string::npos);
  EXPECT_THAT(said(std::string(text).replace(line, 15, "  0\nLINE\n  8\n6\n")), HasSubstr("Front is drawn as a half"));
  // The back's outline ends where it begins; without its last vertex it is open.
  const std::string last = "  0\nVERTEX\n  8\n1\n 10\n0\n 20\n0\n  0\nSEQEND\n";
  EXPECT_THAT(said(with(text, last, "  0\nSEQEND\n")),
              AllOf(HasSubstr("the outline of Back is open"), HasSubstr("200.0 mm apart")));
}

/// A pattern of ours sews what a drawing holds, edges by shares and by notches.
TEST(DxfPattern, APatternOfOursNamesItsSeams) {
  const auto drawing = [](const std::string& name) { return read_pattern(data / name); };
  const std::string text =
      "unit = \"1 mm\"\ndrawing = \"tube.dxf\"\n[[seam]]\nname = \"lower\"\na = \"Front.edge2[0..Front notch 1]\"\nb = "
      "\"Back.edge1[0.6..1]\"\n";
  const CheckedPattern sewn = checked(parse_toml_pattern(text, "tube.toml", drawing));
  EXPECT_NEAR(length(sewn.pattern, sewn.pattern.seams[0].a), 0.12, 1e-7);
  EXPECT_THAT(refusal([&] { parse_toml_pattern(text, "tube.toml"); }), HasSubstr("tube.toml:2:"));
}

TEST(ReadPattern, FilesAreTakenByTheirEnding) {
  EXPECT_EQ(read_pattern(data / "skirt.toml").pieces.size(), 2u);
  EXPECT_EQ(read_pattern(data / "tube.dxf").title, "tube");
  EXPECT_THAT(refusal([&] { read_pattern(data / "none.toml"); }), HasSubstr("none.toml"));
  EXPECT_THAT(refusal([&] { read_pattern("some.pdf"); }), HasSubstr("the ending \".pdf\""));
}

/// What the page shows is read without a warning.
TEST(ReadPattern, TheExampleOfThePageIsSound) {
  const std::string page = text_of(fs::path(SNUG_SOURCE_DIR) / "docs/patterns.md");
  const auto begin = page.find("```toml\n") + 8;
  const CheckedPattern skirt = checked_toml(page.substr(begin, page.find("```", begin) - begin));
  EXPECT_TRUE(skirt.warnings.empty());
  EXPECT_EQ(skirt.pattern.seams.size(), 4u);  // the dart of the front, that of its image, and the sides
}

}  // namespace
}  // namespace snug::mesh
