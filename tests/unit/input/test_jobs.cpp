// What a case asks beside its answer, and values put into the text of a case.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "cases/input/job_spec.hpp"
#include "cases/input/key_list.hpp"
#include "cases/input/overrides.hpp"
#include "cases/input/toml_edit.hpp"

namespace snug::input {
namespace {

using testing::HasSubstr;

TEST(TomlEdit, ReplacesAValueWhereItStandsAndLeavesTheRest) {
  // In an inline table, in a section, in a list by name, over several lines, beside umlauts and comments that hold quotes and braces: only the value changes.
  const std::string text =
      "title = \"Ärmel \\\"x\\\" }\"   # it's a { comment\n"
      "[garment]\npattern = { kind = \"tube\", flat_circumference = \"205 mm\", length = \"260 mm\" }  # as cut\n"
      "[[body.locations]]\nname = \"Wade\"\nto_height = \"225 mm\"\n"
      "[[body.locations]]\nname = \"Ankle\"\nto_height = \"55 mm\"\n"
      "[list]\nrows = [  # from below\n  { a = \"1 mm\" },  # ]\n  { a = \"2 mm\" },\n]\nnext = 3\n";
  const auto with = [&](const std::string& path, const std::string& literal, const std::string& from, const std::string& to) {
    const auto result = with_value(text, path, literal);
    ASSERT_TRUE(result) << path;
    std::string expected = text;
    ASSERT_NE(expected.find(from), std::string::npos);
    EXPECT_EQ(*result, expected.replace(expected.find(from), from.size(), to)) << path;
  };
  with("garment.pattern.flat_circumference", "\"190.5 mm\"", "\"205 mm\"", "\"190.5 mm\"");
  with("body.locations.Ankle.to_height", "\"60 mm\"", "\"55 mm\"", "\"60 mm\"");
  with("body.locations.0.to_height", "\"60 mm\"", "\"225 mm\"", "\"60 mm\"");
  with("list.rows", "[1]", "[  # from below\n  { a = \"1 mm\" },  # ]\n  { a = \"2 mm\" },\n]", "[1]");
  with("list.next", "4.5", "next = 3", "next = 4.5");
}

TEST(TomlEdit, AddsAKeyThatIsNotThere) {
  // To an inline table, to a section, in the place of a text that stands for a table, and as a section of its own.
  EXPECT_EQ(with_value("[garment]\npattern = \"leg.toml\"\n", "garment.pattern.girth_scale", "0.9"), "[garment]\npattern = { file = \"leg.toml\", girth_scale = 0.9 }\n");
  EXPECT_EQ(with_value("[garment]\npattern = { file = \"leg.toml\" }\n", "garment.pattern.girth_scale", "0.9"), "[garment]\npattern = { girth_scale = 0.9, file = \"leg.toml\" }\n");
  const auto section = with_value("[garment]\nname = \"a\"\n[garment.pattern]\nkind = \"tube\"\n[contact]\n", "garment.pattern.girth_scale", "0.9");
  ASSERT_TRUE(section);
  EXPECT_THAT(*section, HasSubstr("[garment.pattern]\ngirth_scale = 0.9\nkind"));
  const auto alone = with_value("title = \"a\"\n[contact]\n", "target.pressures", "[{ location = \"Ankle\", pressure = \"20 mmHg\" }]");
  ASSERT_TRUE(alone);
  EXPECT_THAT(*alone, HasSubstr("[contact]\n\n[target]\npressures = [{ location = \"Ankle\""));
}

TEST(TomlEdit, WhatCannotBeWrittenIsNoText) {
  // A literal that is none, an entry that is not there, a text that is no TOML.
  EXPECT_FALSE(with_value("a = 1\n", "a", "2 mm"));
  EXPECT_FALSE(with_value("[[garment]]\nname = \"x\"\n[[garment]]\nname = \"y\"\n", "garment.z.order", "1"));
  EXPECT_FALSE(with_value("a = [", "a", "2"));
}

TEST(Overrides, NameEntriesOfAListAsMessagesDo) {
  // body.layers[1].cells, body.layers.1.cells and, by its name, body.layers.fat.cells are one key; the other layer keeps its own.
  for (const std::string key : {"body.layers[1].cells", "body.layers.1.cells", "body.layers.fat.cells"}) {
    Diagnostics wrong;
    Table root = parse_text("[body]\nlayers = [{ name = \"muscle\", cells = 2 }, { name = \"fat\", cells = 2 }]\n", {"text", 1, 1}, wrong);
    apply_overrides(root, {key + "=5"}, wrong);
    EXPECT_FALSE(wrong.any()) << key;
    const auto& layers = std::get<std::vector<Value>>(root.table("body")->find("layers")->data);
    double muscle = 0.0, fat = 0.0;
    EXPECT_EQ(*layers[0].table()->find("cells")->number(muscle), 2.0) << key;
    EXPECT_EQ(*layers[1].table()->find("cells")->number(fat), 5.0) << key;
  }
}

TEST(KeyList, WhatIsNotGivenHasNoDefault) {
  // The sector of a location may be left out: its angles have no default, and none is called "nan rad"; a width that has one keeps it.
  for (const KeyRow& row : case_keys()) EXPECT_EQ(row.default_value.find("nan"), std::string::npos) << row.key;
}

TEST(Overrides, SetKeysOfAPatternThatIsAFile) {
  // pattern = "leg.toml" keeps its file beside a scale that is set.
  Diagnostics wrong;
  Table root = parse_text("[garment]\npattern = \"leg.toml\"\n", {"text", 1, 1}, wrong);
  apply_overrides(root, {"garment.pattern.girth_scale=0.9"}, wrong);
  EXPECT_FALSE(wrong.any());
  const Table* pattern = root.table("garment")->table("pattern");
  ASSERT_NE(pattern, nullptr);
  EXPECT_EQ(*pattern->find("file")->text(), "leg.toml");
  double storage = 0.0;
  EXPECT_EQ(*pattern->find("girth_scale")->number(storage), 0.9);
}

class JobsOfACase : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  /// The errors of a case with these sections; empty where it is right.
  std::string errors(const std::string& sections, const std::string& comfort = "") {
    std::ofstream(folder_ / "tube.csv") << "height [mm],girth [mm],bone_girth [mm]\n0,300,60\n100,300,60\n";
    std::ofstream(folder_ / "case.toml") << "title = \"t\"\n[body]\nkind = \"stations\"\nstations = \"tube.csv\"\nlayers = [{ name = \"bone\", material = \"rigid\" }, { name = \"tissue\", material = "
                                            "\"relaxed calf\" }]\n[[body.locations]]\nname = \"Ankle\"\nfrom_angle = \"0 deg\"\nto_angle = \"360 deg\"\n[[body.locations]]\nname = \"Front\"\n"
                                            "from_angle = \"-10 deg\"\nto_angle = \"30 deg\"\n[garment]\npattern = { kind = \"tube\", flat_circumference = \"260 mm\", length = \"50 mm\" }\n"
                                            "fabric = \"N85L15\"\nposition = \"20 mm\"\n[contact]\n"
                                         << comfort << sections;
    try {
      read_case(folder_);
      jobs_ = read_jobs(folder_);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  const std::filesystem::path folder_ = std::filesystem::temp_directory_path() / (std::string("snug-jobs-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
  Jobs jobs_;
};

TEST_F(JobsOfACase, AreReadInAnyUnitAndEchoed) {
  // A profile with a location and a height, a sensor in the middle of a sector over 0 deg, two variants; the echo reads back without the variants.
  ASSERT_EQ(errors("[target]\npressures = [{ location = \"Ankle\", pressure = \"20 mmHg\" }, { height = \"5 cm\", pressure = \"1.2 kPa\" }]\n"
                   "[[sensor]]\nname = \"s\"\nlocation = \"Front\"\ndiameter = \"2.8 cm\"\n"
                   "[[variant]]\nname = \"small\"\nset = [\"garment.position=10 mm\"]\n[[variant]]\nname = \"as it is\"\n"),
            "");
  EXPECT_NEAR(jobs_.target->pressures.at(0).pressure, 20 * 133.322387415, 1e-9);
  EXPECT_DOUBLE_EQ(*jobs_.target->pressures.at(1).height, 0.05);
  EXPECT_DOUBLE_EQ(jobs_.sensors.at(0).diameter, 0.028);
  EXPECT_EQ(jobs_.variants.size(), 2u);
  const std::string echo = echo_text(jobs_);
  EXPECT_EQ(errors(echo), "") << echo;
  EXPECT_NEAR(jobs_.target->pressures.at(0).pressure, 20 * 133.322387415, 1e-9);
  EXPECT_TRUE(jobs_.variants.empty());
}

TEST_F(JobsOfACase, ThresholdsAloneAreComfortAndNothingIsNone) {
  // Compression classes need no wear trial; a [comfort] with neither is an error.
  EXPECT_EQ(errors("", "[comfort]\nthresholds = [\"RAL-GZ 387\"]\n"), "");
  EXPECT_THAT(errors("", "[comfort]\nsamples = 10\n"), HasSubstr("curves"));
  EXPECT_THAT(errors("", "[comfort]\ncurves = \"none\"\n"), HasSubstr("neither curves nor thresholds"));
}

TEST_F(JobsOfACase, WhatFitsNothingIsSaidWithItsRemedy) {
  // Unknown locations, both or neither of two places, sensors without a side or a thickness, names twice.
  EXPECT_THAT(errors("[target]\npressures = [{ location = \"Ankel\", pressure = \"20 mmHg\" }]\n"), HasSubstr("did you mean Ankle?"));
  EXPECT_THAT(errors("[target]\npressures = [{ pressure = \"20 mmHg\" }]\n"), HasSubstr("wanted nowhere"));
  EXPECT_THAT(errors("[target]\npressures = [{ location = \"Ankle\", height = \"5 cm\", pressure = \"20 mmHg\" }]\n"), HasSubstr("at a location and at a height"));
  EXPECT_THAT(errors("[target]\npressures = [{ location = \"Ankle\", pressure = 20 }]\n"), HasSubstr("20"));
  EXPECT_THAT(errors("[[sensor]]\nname = \"s\"\nlocation = \"Ankle\"\ndiameter = \"28 mm\"\n"), HasSubstr("add angle"));
  EXPECT_THAT(errors("[[sensor]]\nname = \"s\"\nlocation = \"Front\"\ndiameter = \"28 mm\"\nbulge = true\n"), HasSubstr("no thickness"));
  EXPECT_THAT(errors("[[variant]]\nname = \"a\"\n[[variant]]\nname = \"a\"\n"), HasSubstr("two variants are called \"a\""));
  EXPECT_THAT(errors("[[varient]]\nname = \"a\"\n"), HasSubstr("did you mean variant"));
}

}  // namespace
}  // namespace snug::input
