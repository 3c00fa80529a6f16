#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "mesh/garment/garment_zones.hpp"
#include "mesh/garment/pattern.hpp"
#include "mesh/garment/tube_girth.hpp"
#include "tests/unit/mesh/bodies.hpp"
#include "tests/unit/mesh/patterns.hpp"

namespace snug::mesh {
namespace {

/// Two halves whose pieces and pattern have these lines, worn with this fabric.
GarmentCut cut_of(const std::string& pattern, const std::string& front, const std::string& back, const std::string& own) {
  std::string text = pattern + two_halves;
  text = with(text, "name = \"front\"\n", "name = \"front\"\n" + front);
  text = with(text, "name = \"back\"\n", "name = \"back\"\n" + back);
  GarmentCut cut{{}, checked_toml(text)};
  cut.spec.fabric.name = own;
  return cut;
}

std::string fabric_line(const std::string& name) { return "fabric = \"" + name + "\"\n"; }

input::ZoneSpec zone_of(const std::vector<std::string>& pieces, const std::string& fabric) {
  input::ZoneSpec zone;
  zone.pieces = pieces, zone.fabric.name = fabric;
  return zone;
}

/// Fabric by piece.
std::map<std::string, std::string> worn(const GarmentCut& cut) {
  std::map<std::string, std::string> fabrics;
  for (const Piece& piece : cut.pattern->pattern.pieces) {
    const int zone = zone_of_piece(cut.spec, piece.name);
    fabrics[piece.name] = zone < 0 ? cut.spec.fabric.name : cut.spec.zone[zone].fabric.name;
  }
  return fabrics;
}

TEST(GarmentZones, APieceIsOfTheCasesZoneElseItsOwnElseTheCasesElseThePatterns) {
  struct Row {
    std::string pattern, front, back, own;
    std::vector<input::ZoneSpec> zone;
    std::string front_is, back_is;
  };
  const std::vector<Row> rows = {
      {fabric_line("P"), "", "", "", {}, "P", "P"},
      {fabric_line("P"), "", "", "C", {}, "C", "C"},
      {fabric_line("P"), fabric_line("F"), "", "", {}, "F", "P"},
      {fabric_line("P"), fabric_line("F"), "", "C", {}, "F", "C"},
      {"", fabric_line("F"), fabric_line("B"), "C", {}, "F", "B"},
      {"", fabric_line("F"), fabric_line("F"), "C", {}, "C", "C"},  // what all pieces name is the pattern's
      {"", fabric_line("F"), fabric_line("F"), "", {}, "F", "F"},
      {fabric_line("P"), fabric_line("F"), "", "C", {zone_of({"front"}, "Z")}, "Z", "C"},
      {fabric_line("P"), "", "", "", {zone_of({"back"}, "Z")}, "P", "Z"},
      {"", "", "", "C", {zone_of({"front", "back"}, "Z")}, "Z", "Z"},
  };
  for (const Row& row : rows) {
    GarmentCut cut = cut_of(row.pattern, row.front, row.back, row.own);
    cut.spec.zone = row.zone;
    settle_fabrics(cut);
    EXPECT_EQ(worn(cut).at("front"), row.front_is) << row.pattern << row.front << row.back << row.own;
    EXPECT_EQ(worn(cut).at("back"), row.back_is) << row.pattern << row.front << row.back << row.own;
    EXPECT_EQ(cut.spec.zone.empty(), row.front_is == row.back_is);
    // What is settled once is settled: the echo of a case reads back to the same.
    const auto before = worn(cut);
    settle_fabrics(cut);
    EXPECT_EQ(worn(cut), before);
  }
}

TEST(GarmentZones, AFabricThatNoPieceIsOfIsSaid) {
  GarmentCut cut = cut_of("", fabric_line("F"), fabric_line("B"), "C");
  const auto warnings = settle_fabrics(cut);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings.front().found, testing::HasSubstr("no piece is of the garment's fabric \"C\""));
}

TEST(GarmentZones, AZoneThatNamesNoPieceOrOneTwiceIsRefused) {
  GarmentCut cut = cut_of("", "", "", "C");
  cut.spec.zone = {zone_of({"frnt"}, "Z")};
  EXPECT_THAT(refusal([&] { settle_fabrics(cut); }), testing::AllOf(testing::HasSubstr("\"frnt\" is no piece"), testing::HasSubstr("front")));
  cut.spec.zone = {zone_of({"front"}, "Z"), zone_of({"front", "back"}, "Y")};
  EXPECT_THAT(refusal([&] { settle_fabrics(cut); }), testing::HasSubstr("the piece front is in two zones"));
  cut.spec.zone.clear();
  cut.spec.fabric.name.clear();
  EXPECT_THAT(refusal([&] { settle_fabrics(cut); }), testing::HasSubstr("the key fabric is missing"));
}

TEST(GarmentZones, TrianglesKnowTheirPieceAndItsZone) {
  // Of a sewn garment by piece; the fit tells how much of the girth is in the zone.
  GarmentCut cut = cut_of("", "", "", "C");
  cut.spec.zone = {zone_of({"back"}, "Z")};
  cut.spec.position = 0.02, cut.spec.cell_size = 0.03;
  settle_fabrics(cut);
  const Limb limb = straight_limb({0, 0.08, 0.08, 0, 0}, {0, 0.015, 0.015, 0, 0}, 0.0, 0.4);
  const GarmentMesh mesh = make_garment_mesh(cut, limb, 0.03);
  ASSERT_EQ(mesh.triangle_zone.size(), mesh.triangles.size());
  double area[2] = {0.0, 0.0};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    EXPECT_EQ(worn(cut).at(mesh.pieces[mesh.piece_of(t)]), mesh.zone_of(t) < 0 ? cut.spec.fabric.name : cut.spec.zone[mesh.zone_of(t)].fabric.name);
    area[mesh.piece_of(t)] += mesh.cut_area(t);
  }
  EXPECT_NEAR(area[0], 0.06, 1e-12);
  EXPECT_NEAR(area[1], 0.06, 1e-12);
  ASSERT_EQ(mesh.seams.size(), 2u);
  const FitRow row = mesh.fit.at(0.15);
  ASSERT_EQ(row.zones.size(), 2u);
  EXPECT_NEAR(row.zones[0], 0.5, 2e-3);  // lines of height on triangles of 30 mm
  EXPECT_NEAR(row.zones[1], 0.5, 2e-3);
}

TEST(GarmentZones, OfATubeTheyAreHeightsWithSidesOfTrianglesBetween) {
  input::GarmentSpec spec = tube_spec(0.28, 0.06, 0.04);
  input::ZoneSpec zone;
  zone.from_height = 0.011, zone.to_height = 0.037;
  spec.zone = {zone};
  const GarmentMesh mesh = make_tube_mesh(spec, cylinder(), 0.01);
  EXPECT_THAT(mesh.pieces, testing::ElementsAre("0 to 11 mm", "11 to 37 mm", "37 to 60 mm"));
  double inside = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    double low = 1.0, high = 0.0;
    for (int k = 0; k < 3; ++k) low = std::min(low, mesh.pattern[mesh.triangles[t][k]].y()), high = std::max(high, mesh.pattern[mesh.triangles[t][k]].y());
    EXPECT_EQ(mesh.zone_of(t), mesh.piece_of(t) == 1 ? 0 : -1);
    for (const double border : {0.011, 0.037}) EXPECT_FALSE(low < border - 1e-9 && high > border + 1e-9);
    if (mesh.zone_of(t) == 0) inside += mesh.cut_area(t);
  }
  EXPECT_NEAR(inside, 0.28 * 0.026, 1e-9);
  EXPECT_NEAR(mesh.fit.at(0.04 + 0.02).zones[0], 1.0, 1e-9);
  EXPECT_NEAR(mesh.fit.at(0.04 + 0.05).zones[0], 0.0, 1e-9);
  const auto& lower = mesh.edges.at("lower");
  EXPECT_GT(lower.size(), 20u);
}

TEST(TubeGirth, GoesThroughItsRowsWithoutExtremesBetweenThem) {
  // A step between two plateaus stays between their values; beyond the rows the ends go on.
  input::PatternSpec tube;
  tube.kind = input::PatternKind::graduated, tube.length = 0.3;
  tube.circumferences = {{0.05, 0.20, {}}, {0.10, 0.20, {}}, {0.12, 0.30, {}}, {0.25, 0.30, {}}};
  const TubeGirth girth(tube);
  for (const input::GirthRow& row : tube.circumferences) EXPECT_NEAR(girth(row.height), row.girth, 1e-12);
  for (int i = 0; i <= 300; ++i) {
    EXPECT_GE(girth(1e-3 * i), 0.20 - 1e-12);
    EXPECT_LE(girth(1e-3 * i), 0.30 + 1e-12);
  }
  EXPECT_EQ(girth(0.0), girth(0.05));
  EXPECT_EQ(girth(0.3), girth(0.25));
  EXPECT_NEAR(girth.mean(), (0.11 * 0.20 + 0.19 * 0.30) / 0.3, 1e-3);
}

TEST(TubeGirth, AGraduatedTubeIsPlacedAtItsOwnWidthWhereItIsWider) {
  // Wide at the top of a cylinder it stands off as its circumference says; courses are as long as their height wants.
  input::GarmentSpec spec = tube_spec(0.0, 0.1, 0.05);
  spec.pattern.kind = input::PatternKind::graduated;
  const double girth = 2.0 * 3.14159265358979 * 0.05;
  spec.pattern.circumferences = {{0.0, 0.8 * girth, {}}, {0.1, 1.2 * girth, {}}};
  const GarmentMesh mesh = make_tube_mesh(spec, cylinder(), 0.012);
  ASSERT_EQ(mesh.course.size(), mesh.pattern.size());
  EXPECT_NEAR(mesh.stand_off, 0.2 * 0.05, 1e-4);
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) EXPECT_NEAR(mesh.course[n], 0.8 + 4.0 * mesh.pattern[n].y(), 1e-9);
  EXPECT_TRUE(mesh.seams.empty());
}

}  // namespace
}  // namespace snug::mesh
