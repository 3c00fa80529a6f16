#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh/pattern/trimming.hpp"
#include "tests/pattern_texts.hpp"
#include "tests/unit/mesh/patterns.hpp"

namespace snug::mesh {
namespace {

using tests::tube_text;

TEST(Trimming, TheMiddleOfASlantingTubeKeepsItsSeams) {
  // Three pieces whose seams lean by 30 mm over 90 mm, cut to 20 to 65 mm: areas fall with the height, every seam has half its length, and two cut edges
  // close each piece.
  const Pattern part = trimmed(parse_toml_pattern(tube_text(3, 300.0, 90.0, 30.0), "test.toml"), 0.020, 0.065, {});
  ASSERT_EQ(part.pieces.size(), 3u);
  for (const Piece& piece : part.pieces) {
    EXPECT_NEAR(area(piece), 0.1 * 0.045, 1e-12);
    EXPECT_GE(piece.find("lower cut"), 0);
    EXPECT_GE(piece.find("upper cut"), 0);
    EXPECT_LT(piece.find("hem"), 0);
  }
  const CheckedPattern whole = checked(part);
  ASSERT_EQ(whole.pattern.seams.size(), 3u);
  for (const Seam& seam : whole.pattern.seams) EXPECT_NEAR(length(part, seam.a), 0.045 * std::hypot(1.0, 1.0 / 3.0), 1e-12);
  EXPECT_EQ(whole.sewing.open.size(), 2u);
}

TEST(Trimming, CurvesAreCutWhereTheyPassAndKeepTheirShape) {
  // The cone's sector cut at its middle height: what is below is bounded by parts of the same two circles.
  Pattern all = parse_toml_pattern(cone, "test.toml");
  EXPECT_THAT(refusal([&] { trimmed(all, 0.0, 0.21650635094610966, {}); }), testing::HasSubstr("the seam \"seam\" of test.toml loses one of its sides"));
  all.seams.clear();
  const Pattern low = trimmed(all, 0.0, 0.21650635094610966, {});
  for (const PieceEdge& edge : low.pieces.front().edges)
    if (edge.name == "outer")
      for (const double share : {0.0, 0.3, 1.0}) EXPECT_NEAR(ArcLength(edge.curve).at(share).norm(), 0.25, 1e-12);
  EXPECT_NEAR(area(low.pieces.front()), 0.5 * area(all.pieces.front()), 1e-9);
}

TEST(Trimming, NotchesGoWithWhatIsLeftOfTheirEdge) {
  // A notch at 0.5 of a side of 90 mm cut at 60 mm is at 0.75 of the rest; one at 0.9 is gone.
  std::string text = tube_text(2, 200.0, 90.0);
  text = with(text, "[[piece]]\nname = \"part 1\"", "notches = [{ name = \"low\", edge = \"right\", at = 0.5 }, { name = \"high\", edge = \"right\", at = 0.9 }]\n[[piece]]\nname = \"part 1\"");
  const Pattern part = trimmed(parse_toml_pattern(text, "test.toml"), 0.0, 0.060, {});
  ASSERT_EQ(part.pieces[0].notches.size(), 1u);
  EXPECT_EQ(part.pieces[0].notches[0].name, "low");
  EXPECT_NEAR(part.pieces[0].notches[0].share, 0.75, 1e-12);
}

TEST(Trimming, WhatCannotBeCutIsRefusedByName) {
  // Trousers drawn in one piece fall into two legs; heights that no piece has leave nothing; both say so.
  const std::string legs = R"(unit = "1 mm"
[[piece]]
name = "legs"
edges = [ { from = [0, 0] }, { from = [100, 0] }, { from = [100, 200] }, { from = [150, 200] }, { from = [150, 0] }, { from = [250, 0] }, { from = [250, 400] }, { from = [0, 400] } ]
)";
  const Pattern pattern = parse_toml_pattern(legs, "test.toml");
  EXPECT_THAT(refusal([&] { trimmed(pattern, 0.0, 0.1, {}); }), testing::HasSubstr("the piece legs falls into several parts"));
  EXPECT_NO_THROW(trimmed(pattern, 0.250, 0.350, {}));
  EXPECT_THAT(refusal([&] { trimmed(pattern, 0.5, 0.6, {}); }), testing::HasSubstr("nothing of test.toml lies from 500 to 600 mm"));
}

}  // namespace
}  // namespace snug::mesh
