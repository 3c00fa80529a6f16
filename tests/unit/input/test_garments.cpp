// What a garment must have and must not: graduated tubes, zones of fabric.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cases/input/case_checks.hpp"
#include "cases/input/echo.hpp"
#include "cases/input/garment_checks.hpp"
#include "cases/input/named_files.hpp"
#include "cases/input/reader.hpp"

namespace snug::input {
namespace {

const std::string head = "[garment]\nfabric = \"N85L15\"\nposition = \"0 mm\"\n";

/// The errors of a garment, each with its line; the pattern of a sewn one is not looked for.
std::string errors_of(const std::string& garment, Case* read_as = nullptr) {
  Diagnostics diagnostics;
  const Table root = parse_text(head + garment, {"case.toml", 1, 1}, diagnostics);
  Case description;
  description.garments.push_back(read<GarmentSpec>(*root.table("garment"), diagnostics));
  complete(description, root);
  check_garments(description, root, diagnostics);
  if (read_as) *read_as = description;
  std::string text;
  for (const Diagnostic& one : diagnostics.errors()) text += to_string(one) + "\n";
  return text;
}

std::string graduated(const std::string& rest) { return "pattern = { kind = \"graduated\", length = \"200 mm\", " + rest + " }\n"; }

const std::string two = "circumferences = [{ height = \"0 mm\", girth = \"20 cm\" }, { height = \"200 mm\", girth = \"300 mm\" }]";

TEST(Garments, AGraduatedTubeArrivesInSiAndComesBackFromItsEcho) {
  Case read_as;
  EXPECT_EQ(errors_of(graduated(two + ", pressures = [{ height = \"1 cm\", pressure = \"20 mmHg\" }, { height = \"0.1 m\", pressure = \"2 kPa\" }]") +
                          "[[garment.zone]]\nfrom_height = \"5 cm\"\nto_height = \"80 mm\"\nfabric = \"C98L2\"\n",
                      &read_as),
            "");
  const GarmentSpec& garment = read_as.garments.front();
  ASSERT_EQ(garment.pattern.circumferences.size(), 2u);
  EXPECT_DOUBLE_EQ(garment.pattern.circumferences[1].girth, 0.3);
  EXPECT_NEAR(garment.pattern.pressures[0].pressure, 20 * 133.322387415, 1e-6);
  ASSERT_EQ(garment.zone.size(), 1u);
  EXPECT_DOUBLE_EQ(garment.zone[0].from_height, 0.05);
  EXPECT_EQ(garment.zone[0].fabric.name, "C98L2");
  Diagnostics diagnostics;
  const GarmentSpec again = read<GarmentSpec>(to_table(garment), diagnostics);
  EXPECT_FALSE(diagnostics.any());
  EXPECT_EQ(again.pattern.kind, PatternKind::graduated);
  EXPECT_EQ(again.pattern.circumferences[0].girth, garment.pattern.circumferences[0].girth);
  EXPECT_EQ(again.zone[0].to_height, garment.zone[0].to_height);
}

TEST(Garments, AllFilesThatACaseNamesAreAmongItsFiles) {
  // Of every kind of key that names one; provenance hashes these.
  Case description;
  description.body.emplace();
  description.body->scan.emplace();
  description.body->scan->surface = "scan.obj";
  description.body->scan->core.emplace();
  description.body->scan->core->surface = "bone.stl";
  description.garments.resize(2);
  description.garments[0].pattern.file = "vest.toml";
  description.garments[1].shape.emplace();
  description.garments[1].shape->net = "net.json";
  description.reference.emplace();
  description.reference->nodes = "nodes.lis";
  EXPECT_THAT(named_files(description), testing::UnorderedElementsAre("scan.obj", "bone.stl", "vest.toml", "net.json", "nodes.lis"));
}

TEST(Garments, WhatATubeIsIsSaidOnceAndInOrder) {
  // Each row is one mistake; the error names it and its line.
  using testing::HasSubstr;
  EXPECT_THAT(errors_of(graduated("flat_circumference = \"1 m\", " + two)), HasSubstr("case.toml:4:11: error: flat_circumference is of a tube that is as wide everywhere"));
  EXPECT_THAT(errors_of("pattern = { flat_circumference = \"30 cm\", length = \"20 cm\", girth_scale = 0.9 }\n"), HasSubstr("girth_scale is of the drawings of a pattern, and this is a tube"));
  EXPECT_THAT(errors_of("pattern = { flat_circumference = \"30 cm\", length = \"20 cm\", length_scale = 1.1 }\n"), HasSubstr("length_scale is of the drawings"));
  EXPECT_THAT(errors_of("pattern = { kind = \"graduated\", length = \"200 mm\" }\n"), HasSubstr("neither circumferences nor pressures"));
  EXPECT_THAT(errors_of("pattern = { kind = \"graduated\", " + two + " }\n"), HasSubstr("the key length is missing"));
  EXPECT_THAT(errors_of(graduated("circumferences = [{ height = \"0 mm\", girth = \"20 cm\" }]")), HasSubstr("circumferences has one row"));
  EXPECT_THAT(errors_of(graduated("circumferences = [{ height = \"9 mm\", girth = \"20 cm\" }, { height = \"9 mm\", girth = \"21 cm\" }]")), HasSubstr("9 mm is not above the 9 mm before it"));
  EXPECT_THAT(errors_of(graduated("circumferences = [{ height = \"9 mm\", girth = \"20 cm\" }, { height = \"9 cm\", girth = \"0 cm\" }]")), HasSubstr("girth"));
  EXPECT_THAT(errors_of(graduated("pressures = [{ height = \"0 mm\", pressure = \"20 mmHg\" }, { height = \"3 m\", pressure = \"1 kPa\" }]")), HasSubstr("3000 mm is above the upper edge at 200 mm"));
  EXPECT_THAT(errors_of(graduated(two) + "warp = \"around\"\n"), HasSubstr("what is knitted round has its wales along"));
  EXPECT_THAT(errors_of("pattern = { kind = \"tube\", flat_circumference = \"30 cm\", length = \"200 mm\", " + two + " }\n"), HasSubstr("circumferences are of a graduated tube"));
  EXPECT_THAT(errors_of("pattern = { file = \"a.toml\", " + two + " }\n"), HasSubstr("circumferences are of a graduated tube"));
}

TEST(Garments, ZonesAreHeightsOfATubeAndPiecesOfAPattern) {
  using testing::HasSubstr;
  const std::string tube = "pattern = { kind = \"tube\", flat_circumference = \"30 cm\", length = \"200 mm\" }\n", sewn = "pattern = \"a.toml\"\n";
  const auto zone = [](const std::string& keys) { return "[[garment.zone]]\n" + keys + "fabric = \"C98L2\"\n"; };
  EXPECT_EQ(errors_of(tube + zone("to_height = \"50 mm\"\n") + zone("from_height = \"50 mm\"\n")), "");
  EXPECT_EQ(errors_of(sewn + zone("pieces = [\"front\"]\n")), "");
  EXPECT_THAT(errors_of(tube + zone("pieces = [\"front\"]\n")), HasSubstr("a zone names pieces, and a tube has none"));
  EXPECT_THAT(errors_of(tube + zone("from_height = \"80 mm\"\nto_height = \"50 mm\"\n")), HasSubstr("a zone goes from 80 to 50 mm"));
  EXPECT_THAT(errors_of(tube + zone("to_height = \"1 m\"\n")), HasSubstr("of a tube of 200 mm"));
  EXPECT_THAT(errors_of(tube + zone("to_height = \"60 mm\"\n") + zone("from_height = \"50 mm\"\n")), HasSubstr("two zones overlap"));
  EXPECT_THAT(errors_of(sewn + zone("")), HasSubstr("names no pieces"));
  EXPECT_THAT(errors_of(sewn + zone("pieces = [\"front\"]\nto_height = \"5 cm\"\n")), HasSubstr("which are of a tube"));
  EXPECT_THAT(errors_of(tube + "[[garment.zone]]\nto_height = \"5 cm\"\n"), HasSubstr("fabric"));
}

}  // namespace
}  // namespace snug::input
