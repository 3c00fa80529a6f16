#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <set>
#include <string>

#include "cases/input/case.hpp"
#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"
#include "cases/input/key_list.hpp"

namespace snug::input {
namespace {

namespace fs = std::filesystem;

const std::string body_section =
    "[body]\n"                                                               // 2
    "stations = \"limb.csv\"\n"                                              // 3
    "layers = [\n"                                                           // 4
    "  { name = \"bone\", material = \"rigid\" },\n"                         // 5
    "  { name = \"tissue\", material = \"relaxed thigh\", cells = 3 },\n"    // 6
    "  { name = \"skin\", material = \"skin\", thickness = \"1.5 mm\" },\n"  // 7
    "]\n";                                                                   // 8
const std::string garment_section =
    "[garment]\n"                                                                           // 9
    "pattern = { kind = \"tube\", flat_circumference = \"42 cm\", length = \"160 mm\" }\n"  // 10
    "fabric = { law = \"linear\", warp = \"1000 N/m\" }\n"                                  // 11
    "position = \"0 mm\"\n"                                                                 // 12
    "[contact]\n";                                                                          // 13

/// A case directory of its own that goes away with the test.
class CaseDirectory : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("snug-input-" + std::to_string(::getpid()) + "-" +
                                              testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(directory_ / "case");
    write("limb.csv", "height [mm], girth [mm], bone_girth [mm]\n0, 500, 90\n");
  }
  void TearDown() override { fs::remove_all(directory_); }
  void write(const std::string& name, const std::string& text) { std::ofstream(directory_ / "case" / name) << text; }

  Case read_text(const std::string& text, const ReadOptions& options = {}) {
    write("case.toml", text);
    return read_case(directory_ / "case", options);
  }
  /// The errors, each from "LINE:COLUMN: error" on.
  std::vector<std::string> errors_of(const std::string& text, const ReadOptions& options = {}) {
    const std::string file = (directory_ / "case" / "case.toml").string() + ":";
    std::vector<std::string> errors;
    try {
      read_text(text, options);
    } catch (const InputError& error) {
      for (const Diagnostic& one : error.errors()) {
        const std::string line = to_string(one);
        errors.push_back(line.rfind(file, 0) == 0 ? line.substr(file.size()) : line);
      }
    }
    return errors;
  }
  static bool has(const std::vector<std::string>& errors, const std::string& start, const std::string& part) {
    for (const std::string& error : errors)
      if (error.rfind(start, 0) == 0 && error.find(part) != std::string::npos) return true;
    return false;
  }

  const std::string good_ = "title = \"t\"\n" + body_section + garment_section;
  fs::path directory_;
};

std::string all(const std::vector<std::string>& errors) {
  std::string text;
  for (const std::string& error : errors) text += error + "\n";
  return text;
}

TEST_F(CaseDirectory, WholeCaseArrivesInSi) {
  // A case is read into plain structs in SI, with paths resolved and the form of each layer decided.
  const Case c = read_text(good_);
  EXPECT_EQ(c.title, "t");
  EXPECT_DOUBLE_EQ(c.garments.front().pattern.flat_circumference, 0.42);
  EXPECT_TRUE(fs::exists(c.body->stations));
  EXPECT_EQ(c.body->layers[0].form, LayerForm::rigid);
  EXPECT_EQ(c.body->layers[1].form, LayerForm::solid);
  EXPECT_EQ(c.body->layers[1].cells, 3);
  EXPECT_EQ(c.body->layers[2].form, LayerForm::membrane);
  EXPECT_EQ(c.garments.front().fabric.where.line, 11);
  EXPECT_EQ(c.garments.front().fabric.where.column, 10);
  EXPECT_EQ(c.contacts.size(), 1u);
  EXPECT_FALSE(c.comfort);
  EXPECT_FALSE(c.load);
}

TEST_F(CaseDirectory, ErrorsOfAllSectionsComeTogether) {
  // Every error of a case is reported at once, each at its place.
  const auto errors =
      errors_of("title = \"t\"\n" + body_section +
                "[garment]\npatern = 1\npattern = { kind = \"tube\", flat_circumference = 420, length = \"3 kPa\" }\n"
                "fabric = \"N85L15\"\nwarp = \"allong\"\nposition = \"0 mm\"\n[contact]\nfriction = "
                "-0.3\n[solver]\ntier = \"L5\"\n");
  EXPECT_EQ(errors.size(), 6u) << all(errors);
  EXPECT_TRUE(has(errors, "10:1: error: unknown key patern", "did you mean pattern?")) << all(errors);
  EXPECT_TRUE(has(errors, "11:49: error: flat_circumference is the bare number 420", "\"420 m\"")) << all(errors);
  EXPECT_TRUE(has(errors, "11:63: error: length", "give a length")) << all(errors);
  EXPECT_TRUE(has(errors, "13:8: error: \"allong\" is no warp", "did you mean along?")) << all(errors);
  EXPECT_TRUE(has(errors, "16:12: error: ", "friction")) << all(errors);
  EXPECT_TRUE(has(errors, "18:8: error: \"L5\" is no tier", "known: L0, L1, L4")) << all(errors);
}

TEST_F(CaseDirectory, MissingKeysAreNamedWithTheirMeaning) {
  // A required key that is missing is an error at its section with meaning and example.
  const auto errors = errors_of("title = \"t\"\n" + body_section + "[load]\npressure = [{ on = \"skin\" }]\n");
  ASSERT_EQ(errors.size(), 1u) << all(errors);
  EXPECT_TRUE(has(errors, "10:", "the key value is missing; add value: pressure, against the outward normal")) << all(errors);
}

TEST_F(CaseDirectory, LoadsAndSupportsThatDoNothingAreRefused) {
  const auto errors = errors_of("title = \"t\"\n" + body_section +
                                "[load]\n"                                               // 9
                                "force = [{ value = [\"0 N\", \"1 N\", \"0 N\"] }]\n"    // 10
                                "[[support]]\non = \"lower\"\n"                          // 11
                                "[[support]]\non = \"upper\"\nturn = \"3 deg\"\nz = \"0 mm\"\n");
  EXPECT_TRUE(has(errors, "10:", "a force has neither at nor on; write at = [x, y, z]")) << all(errors);
  EXPECT_TRUE(has(errors, "11:", "the support of \"lower\" holds nothing; give a displacement")) << all(errors);
  EXPECT_TRUE(has(errors, "13:", "\"upper\" is turned but x or y is free")) << all(errors);
  const auto empty = errors_of("title = \"t\"\n" + body_section + "[load]\n");
  EXPECT_TRUE(has(empty, "9:", "the section [load] has no load; add one")) << all(empty);
}

TEST_F(CaseDirectory, PartsThatDoNotFitAreRefused) {
  // A scene whose parts do not fit together is refused before anything is meshed.
  const std::string title = "title = \"t\"\n";
  EXPECT_TRUE(has(errors_of(title + garment_section), "2:", "there is a [garment] but no [body]"));
  EXPECT_TRUE(has(errors_of(title + body_section), "2:", "nothing acts on the body"));
  EXPECT_TRUE(
      has(errors_of(title + body_section + "[contact]\n[load]\nskin_pressure = \"1 kPa\""), "9:", "no [garment]"));
  EXPECT_TRUE(has(errors_of(title), "", "neither a body nor a garment"));
  EXPECT_TRUE(has(errors_of(good_ + "[comfort]\ncurves = \"wear trial 2002\"\n"), "14:", "no locations"));
}

// Of a mesh without load steps none is chosen, and steps count from 1.
TEST_F(CaseDirectory, LoadStepsAreThoseOfModelFiles) {
  for (const char* name : {"m.msh", "m.inp", "m.feb"}) write(name, "x");
  const auto with = [&](const std::string& rest) { return errors_of("title = \"t\"\n[body]\nkind = \"imported\"\n" + rest + "\n[load]\ngravity = [\"0 m/s2\", \"0 m/s2\", \"-9.81 m/s2\"]\n"); };
  EXPECT_TRUE(has(with("mesh = \"m.msh\"\nload_step = 2"), "5:", "load_step does not apply to a gmsh file"));
  EXPECT_TRUE(with("mesh = \"m.inp\"\nload_step = 2").empty());
  EXPECT_TRUE(with("mesh = \"m.feb\"\nload_step = 12").empty());
  EXPECT_TRUE(has(with("mesh = \"m.inp\"\nload_step = 0"), "5:", "load_step"));
  EXPECT_TRUE(has(with("mesh = \"m.inp\"\nload_step = 1.5"), "5:", "load_step"));
}

TEST_F(CaseDirectory, LayersMustBeInOrder) {
  // Bone first, skin last, exactly one solid layer that takes the rest.
  const auto layers = [&](const std::string& list) {
    return errors_of("title = \"t\"\n[body]\nstations = \"limb.csv\"\nlayers = [" + list +
                     "]\n[load]\nskin_pressure = \"1 kPa\"\n");
  };
  const std::string bone = "{ name = \"bone\", material = \"rigid\" }", fat = "{ name = \"fat\", material = \"fat\" }";
  const std::string skin = "{ name = \"skin\", material = \"skin\", thickness = \"1 mm\" }";
  EXPECT_TRUE(layers(bone + "," + fat + "," + skin).empty());
  EXPECT_TRUE(layers(bone + "," + fat).empty());
  EXPECT_TRUE(has(layers(fat + "," + bone), "4:", "not the innermost"));
  EXPECT_TRUE(has(layers(bone + "," + skin), "2:", "no solid layer"));
  EXPECT_TRUE(has(layers(bone + "," + fat + "," + fat), "4:", "a second layer is called"));
  EXPECT_TRUE(has(layers(""), "4:", "no layers"));
}

TEST_F(CaseDirectory, PathsStayInTheDirectory) {
  // Absolute paths and ../ are refused unless allowed; a missing file is located with the nearest name.
  std::string text = good_;
  const auto with = [&](const std::string& path) { return std::string(text).replace(text.find("limb.csv"), 8, path); };
  std::ofstream(directory_ / "other.csv") << "x\n";
  EXPECT_TRUE(has(errors_of(with("../other.csv")), "3:12: error: ", "outside the case directory"));
  EXPECT_TRUE(has(errors_of(with((directory_ / "other.csv").string())), "3:12: error: ", "outside the case directory"));
  EXPECT_TRUE(errors_of(with("../other.csv"), {.overrides = {}, .allow_outside = true}).empty());
  EXPECT_TRUE(has(errors_of(with("lmib.csv")), "3:12: error: there is no file", "did you mean \"limb.csv\"?"));
  // A path of Windows: what to write where the file is there, else where to put it.
  std::filesystem::create_directories(directory_ / "case" / "körper teil");
  std::filesystem::copy_file(directory_ / "case" / "limb.csv", directory_ / "case" / "körper teil" / "limb.csv");
  EXPECT_TRUE(has(errors_of(with("körper teil\\\\limb.csv")), "3:12: error: ", "is a path of Windows; write \"körper teil/limb.csv\""));
  EXPECT_TRUE(has(errors_of(with("C:\\\\Users\\\\Jörg\\\\limb.csv")), "3:12: error: ", "is a path of Windows; copy the file into the case directory"));
}

TEST_F(CaseDirectory, OverridesPassTheSameReader) {
  // --set replaces a value before reading and is checked like one of the file.
  const Case c = read_text(
      good_, {.overrides = {"garment.fabric=N85L15", "garment.pattern.length=20 cm", "body.layers.tissue.cells=5",
                            "body.layers.2.thickness=2 mm", "solver.tier=\"L1\""}});
  EXPECT_EQ(c.garments.front().fabric.name, "N85L15");
  EXPECT_DOUBLE_EQ(c.garments.front().pattern.length, 0.2);
  EXPECT_EQ(c.body->layers[1].cells, 5);
  EXPECT_DOUBLE_EQ(*c.body->layers[2].thickness, 2e-3);
  EXPECT_EQ(c.solver.tier, Tier::L1);
  const auto errors = errors_of(
      good_, {.overrides = {"garment.position=3", "garment.fabrik=x", "body.layers.fat.cells=1", "nonsense"}});
  EXPECT_EQ(errors.size(), 4u) << all(errors);
  EXPECT_TRUE(has(errors, "--set garment.position=3: error: position is the bare number 3", "3 m")) << all(errors);
  EXPECT_TRUE(has(errors, "--set garment.fabrik=x: error: unknown key fabrik", "fabric")) << all(errors);
  EXPECT_TRUE(has(errors, "--set body.layers.fat.cells=1: error: the list has no entry fat", "bone, tissue, skin"))
      << all(errors);
  EXPECT_TRUE(has(errors, "--set nonsense: error: ", "--set")) << all(errors);
}

TEST_F(CaseDirectory, EchoReadsBackToTheSameCase) {
  // The echo holds every value in SI with its defaults, and reading it gives the same case again.
  const Case first = read_text(good_);
  const std::string echo = echo_text(first);
  EXPECT_NE(echo.find("flat_circumference = \"0.42 m\""), std::string::npos) << echo;
  EXPECT_NE(echo.find("ends = \"sliding\""), std::string::npos) << echo;
  EXPECT_NE(echo.find("stations = \"limb.csv\""), std::string::npos) << echo;
  const Case second = read_text(echo);
  EXPECT_EQ(echo_text(second), echo);
}

const std::string two_garments =
    "[[garment]]\nname = \"band\"\npattern = { kind = \"tube\", flat_circumference = \"42 cm\", length = \"50 mm\" }\n"
    "fabric = \"N85L15\"\nposition = \"0 mm\"\n"
    "[[garment]]\nname = \"cuff\"\npattern = { kind = \"tube\", flat_circumference = \"40 cm\", length = \"30 mm\" }\n"
    "fabric = \"C98L2\"\nposition = \"80 mm\"\n";

TEST_F(CaseDirectory, SeveralGarmentsAreAListAndOneMayStandAlone) {
  // [[garment]] and [[contact]] are lists; a single table is a list of one, and the echo reads back to the same either way.
  const std::string head = "title = \"t\"\n" + body_section;
  const Case c = read_text(head + two_garments + "[[contact]]\nslave = \"cuff\"\nfriction = 0.4\n[[contact]]\n");
  ASSERT_EQ(c.garments.size(), 2u);
  EXPECT_EQ(c.garments[1].name, "cuff");
  ASSERT_EQ(c.contacts.size(), 2u);
  EXPECT_EQ(c.contacts[0].friction, 0.4);
  EXPECT_EQ(c.contacts[1].slave, "");
  EXPECT_EQ(echo_text(read_text(echo_text(c))), echo_text(c));
  EXPECT_EQ(read_text(good_).garments.front().name, "garment");
  EXPECT_NE(echo_text(read_text(good_)).find("[garment]"), std::string::npos);
  std::string listed = good_;
  listed.replace(listed.find("[garment]"), 9, "[[garment]]").replace(listed.find("[contact]"), 9, "[[contact]]");
  EXPECT_EQ(echo_text(read_text(listed)), echo_text(read_text(good_)));
  EXPECT_EQ(read_text(listed, {.overrides = {"contact.friction=0.1", "garment.position=\"3 mm\""}}).contacts.front().friction, 0.1);
  EXPECT_EQ(read_text(head + two_garments + "[contact]\n", {.overrides = {"garment.cuff.position=\"90 mm\""}}).garments[1].position, 0.09);
}

TEST_F(CaseDirectory, ContactsAndGarmentsThatDoNotFitTogetherAreNamed) {
  // A name twice, a contact of nobody, a garment without contact, two slaves of one surface: each has its place and remedy.
  const std::string head = "title = \"t\"\n" + body_section;
  std::string twice = two_garments;
  twice.replace(twice.find("cuff"), 4, "band");
  EXPECT_THAT(all(errors_of(head + twice + "[contact]\n")), testing::HasSubstr("a second garment is called \"band\""));
  EXPECT_THAT(all(errors_of(head + two_garments + "[[contact]]\nslave = \"cuff\"\n")),
              testing::HasSubstr("no [[contact]] is of the garment \"band\""));
  EXPECT_THAT(all(errors_of(head + two_garments + "[[contact]]\n[[contact]]\n")), testing::HasSubstr("two contacts name no slave"));
  EXPECT_THAT(all(errors_of(head + two_garments + "[[contact]]\n[[contact]]\nslave = \"cuff\"\n[[contact]]\nslave = \"cuff\"\n")),
              testing::HasSubstr("\"cuff\" is the slave of two contacts"));
  const auto lies = [&](const char* slave, const char* master) {
    return all(errors_of(head + two_garments + "[[contact]]\n[[contact]]\nslave = \"" + slave + "\"\nmaster = \"" + master + "\"\n"));
  };
  EXPECT_EQ(lies("cuff", "band"), "");  // the second on the first
  EXPECT_EQ(lies("cuff", "skin"), "");
  EXPECT_THAT(lies("band", "cuff"), testing::HasSubstr("\"band\" is to lie on \"cuff\", which is listed after it; list garments from the skin outwards"));
  EXPECT_THAT(lies("band", "band"), testing::HasSubstr("which is listed as itself"));
  EXPECT_THAT(lies("cuff", "shirt"), testing::HasSubstr("\"shirt\", which is no garment of the case"));
  EXPECT_THAT(all(errors_of(head + two_garments + "[contact]\nmaster = \"band\"\n")), testing::HasSubstr("every garment is to lie on \"band\""));
  EXPECT_THAT(all(errors_of(head + "[load]\nskin_pressure = \"1 kPa\"\n[contact]\nslave = \"top\"\nmaster = \"top\"\n")),
              testing::HasSubstr("touch itself"));
}

// A tool says where it goes; sizes that no tool has, a body that it cannot go into and a name that is taken are said.
TEST_F(CaseDirectory, ToolsHaveAWayAndASize) {
  const std::string head = "title = \"t\"\n" + body_section;
  const auto tool = [](const std::string& rest) {
    return "[[tool]]\nradius = \"15 mm\"\ntip = [\"90 mm\", \"0 mm\", \"20 mm\"]\ntravel = \"5 mm\"\n" + rest;
  };
  const Case c = read_text(head + tool("direction = [-2, 0, 0]\n"));
  ASSERT_EQ(c.tools.size(), 1u);
  EXPECT_DOUBLE_EQ(c.tools.front().radius, 0.015);
  EXPECT_DOUBLE_EQ(c.tools.front().tip[0], 0.09);
  EXPECT_DOUBLE_EQ(c.tools.front().direction[0], -2.0);
  EXPECT_TRUE(c.tools.front().from_touch);
  const auto said = [&](const std::string& text) { return all(errors_of(head + text)); };
  EXPECT_THAT(said("[[tool]]\nradius = \"-15 mm\"\ntip = [\"90 mm\", \"0 mm\", \"20 mm\"]\ntravel = \"5 mm\"\ndirection = [1, 0, 0]\n"), testing::HasSubstr("radius"));
  EXPECT_THAT(said(tool("direction = [0, 0, 0]\n")), testing::HasSubstr("the direction of \"tool\" is zero"));
  EXPECT_THAT(said(tool("direction = [1, 0, 0]\nedge_radius = \"16 mm\"\n")), testing::HasSubstr("let edge_radius be at most the radius"));
  EXPECT_THAT(said(tool("direction = [1, 0, 0]\n") + tool("direction = [1, 0, 0]\n")), testing::HasSubstr("give each tool a name of its own"));
  EXPECT_THAT(said(tool("direction = [1, 0, 0]\nname = \"body\"\n")), testing::HasSubstr("a tool is called \"body\""));
  EXPECT_THAT(said(tool("direction = [1, 0, 0]\n[solver]\ntier = \"L1\"\n")), testing::HasSubstr("into which \"tool\" cannot go"));
  EXPECT_THAT(all(errors_of(good_ + tool("direction = [1, 0, 0]\n"))), testing::HasSubstr("a tool on a garment is not available"));
  EXPECT_THAT(all(errors_of("title = \"t\"\n" + tool("direction = [1, 0, 0]\n"))), testing::HasSubstr("there is a [[tool]] but no [body]"));
  EXPECT_EQ(to_toml(to_table(c)).find("[[tool]]") == std::string::npos, true);  // one stands as a plain table
  EXPECT_NE(to_toml(to_table(c)).find("tool"), std::string::npos);
}

// A band's rest length is a share of the edge as cut or a length; what is neither, or leaves nothing, is said.
TEST_F(CaseDirectory, BandsHaveARestLength) {
  BandSpec band{.edge = "upper", .rest_length = "-8 %"};
  EXPECT_DOUBLE_EQ(*rest_length(band, 0.5), 0.46);
  band.rest_length = "310 mm";
  EXPECT_DOUBLE_EQ(*rest_length(band, 0.5), 0.31);
  band.rest_length = "tight";
  EXPECT_FALSE(rest_length(band, 0.5));
  const auto errors = [&](const std::string& length) {
    return all(errors_of(good_ + "[[garment.band]]\nedge = \"upper\"\nrest_length = \"" + length + "\"\nstiffness = \"150 N/m\"\nwidth = \"25 mm\"\n"));
  };
  EXPECT_EQ(errors("-8 %"), "");
  EXPECT_THAT(errors("tight"), testing::HasSubstr("rest_length \"tight\" is neither a percentage nor a length"));
  EXPECT_THAT(errors("-100 %"), testing::HasSubstr("leaves nothing of the band"));
}

TEST_F(CaseDirectory, ATierWithoutABodyMovesNone) {
  // On a rigid body a support that moves is an error; one that holds is left out and said so by the plan.
  EXPECT_THAT(all(errors_of(good_ + "[[support]]\non = \"upper\"\nz = \"2 mm\"\n[solver]\ntier = \"L1\"\n")),
              testing::HasSubstr("no [[support]] moves"));
  EXPECT_TRUE(errors_of(good_ + "[[support]]\non = \"upper\"\nz = \"0 mm\"\n[solver]\ntier = \"L1\"\n").empty());
}

TEST_F(CaseDirectory, MissingDirectoryAndFileAreNamed) {
  // No directory, or one without case.toml, is an error with a remedy.
  EXPECT_THROW(read_case(directory_ / "nowhere"), InputError);
  EXPECT_THROW(read_case(directory_), InputError);
  EXPECT_THROW(read_case(directory_ / "case" / "limb.csv"), InputError);
}

TEST(ShippedCases, AreReadWithoutError) {
  // Every case directory that is shipped is a correct input.
  int count = 0;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SNUG_SOURCE_DIR) / "cases")) {
    if (entry.path().filename() != "case.toml") continue;
    EXPECT_NO_THROW(read_case(entry.path().parent_path(), {.overrides = {}, .bodies = fs::path(SNUG_SOURCE_DIR) / "mesh/data/bodies"})) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 3);
}

TEST(ShippedCases, AnglesArriveInRadian) {
  // The front of the thigh is the sector from 45 to 135 degrees.
  const Case c = read_case(fs::path(SNUG_SOURCE_DIR) / "cases/thigh-sleeve");
  ASSERT_FALSE(c.body->locations.empty());
  EXPECT_EQ(c.body->locations[0].name, "Front thigh");
  EXPECT_NEAR(c.body->locations[0].from_angle, std::numbers::pi / 4, 1e-12);
}

TEST(KeyList, KnowsEveryKeyOnce) {
  // The generated reference lists every key with a meaning, nested ones with their sections.
  std::set<std::string> keys;
  for (const KeyRow& row : case_keys()) {
    EXPECT_TRUE(keys.insert(row.key).second) << row.key;
    EXPECT_FALSE(row.field.meaning.empty()) << row.key;
  }
  for (const std::string key :
       {"title", "body.layers[].thickness", "garment.pattern.length", "body.scan.lower.point", "solver.tier"})
    EXPECT_TRUE(keys.count(key)) << key;
}

}  // namespace
}  // namespace snug::input
