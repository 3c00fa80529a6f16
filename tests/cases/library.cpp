// The engineering database as a user meets it: snug materials, and cases that name its entries.
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class LibraryProgram : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    ::setenv("SNUG_LIBRARY", file_.c_str(), 1);
  }
  void TearDown() override {
    ::unsetenv("SNUG_LIBRARY");
    Program::TearDown();
  }
  std::string content(const fs::path& file) const {
    std::ifstream in(folder_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void expect(const std::string& arguments, int status, const std::string& said) const {
    const Outcome outcome = snug(arguments);
    EXPECT_EQ(outcome.status, status) << arguments << "\n" << outcome.text;
    EXPECT_NE(outcome.text.find(said), std::string::npos) << arguments << "\n" << outcome.text;
  }
  const fs::path file_ = folder_ / "library.db";
  static constexpr const char* coarse = " --quiet --no-report --set body.cells_around=12 --set body.cells_along=4 ";
  static constexpr const char* numbers =
      R"toml(law="kes", LT=0.9, WT="10.02 gf cm/cm2", EMT=43.26, G="0.66 gf/(cm degree)", B="0.02 gf cm2/cm", weight="215.0 g/m2", thickness="0.57 mm", poisson=0.2)toml";
};

TEST_F(LibraryProgram, ACaseThatNamesAnEntryGivesTheDigitsOfItsNumbers) {
  // The same case with the name of an own fabric and with a table of its numbers: every table and grid is the same to
  // the last bit.
  ASSERT_EQ(snug("new mine").status, 0);
  const std::string words =
      "law=kes LT=0.9 'WT=10.02 +- 8.26 gf cm/cm2' 'EMT=43.26 %' 'G=0.66 gf/(cm degree)' 'B=0.02 gf cm2/cm' "
      "'weight=215.0 g/m2' 'thickness=0.57 mm' poisson=0.2 'hand=soft'";
  ASSERT_EQ(snug("materials add fabric 'my knit' " + words).status, 0);
  ASSERT_EQ(snug(std::string("run mine --out named") + coarse + "--set 'garment.fabric=\"my knit\"'").status, 0);
  ASSERT_EQ(snug(std::string("run mine --out written") + coarse + "--set 'garment.fabric={ name=\"my knit\", " +
                 numbers + " }'")
                .status,
            0);
  int compared = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "named")) {
    const std::string name = entry.path().filename();
    if (name == "summary.json" || name == "case.echo.toml" || name.starts_with(".")) continue;
    EXPECT_EQ(content("named/" + name), content("written/" + name)) << name;
    ++compared;
  }
  EXPECT_GE(compared, 7);
  EXPECT_NE(content("named/case.echo.toml").find("name = \"my knit\""), std::string::npos)
      << "the echo needs no library";
  fs::remove(file_);
  fs::copy_file(folder_ / "named/case.echo.toml", folder_ / "mine/case.toml", fs::copy_options::overwrite_existing);
  EXPECT_EQ(snug("check mine").status, 0);
}

TEST_F(LibraryProgram, ARunThatNamesWhatShipsDoesNotOpenTheLibrary) {
  // With a damaged file in its place the shipped names work as before, and an own name is refused with what is the
  // matter.
  ASSERT_EQ(snug("new mine").status, 0);
  write("library.db", std::string(5000, 'x'));
  expect("check mine --set garment.fabric=N85L15", 0, "unknowns");
  expect("check mine --set garment.fabric=001-01", 0, "unknowns");
  expect("check mine --set 'garment.fabric=\"my knit\"'", 2,
         "library.db: error: this is no library of snug, or a damaged one");
  EXPECT_EQ(content("library.db"), std::string(5000, 'x'));
  fs::remove(file_);
  expect("check mine --set 'garment.fabric=\"my knit\"'", 2, "no fabric is called \"my knit\"");
  EXPECT_FALSE(fs::exists(file_)) << "a run makes no library";
}

TEST_F(LibraryProgram, NamesThatAreMissingAreRefusedWithTheNearest) {
  ASSERT_EQ(snug("new mine").status, 0);
  ASSERT_EQ(snug("materials add fabric 'my knit' law=kes LT=0.9 'WT=10 gf cm/cm2' 'Fm=50 gf/cm' 'G=0.7 gf/(cm degree)'")
                .status,
            0);
  expect("check mine --set 'garment.fabric=\"my knid\"'", 2, "did you mean my knit?");
  expect("check mine --set garment.fabric=001", 2, "\"001\" of the library is a garment, not a fabric");
  ASSERT_EQ(snug("materials edit 'my knit' --remove law").status, 0);
  expect("check mine --set 'garment.fabric=\"my knit\"'", 2, "has no law; say which one reads its numbers");
  ASSERT_EQ(snug("materials edit 'my knit' law=kes --remove G").status, 0);
  expect("check mine --set 'garment.fabric=\"my knit\"'", 2, "the key G is missing");
  expect("materials edit 'my knit' G=0.7", 2,
         "G: \"0.7\" has no unit; write it with a unit that converts to N/(m rad)");
}

TEST_F(LibraryProgram, QuestionsChangesAndHistory) {
  EXPECT_EQ(snug("materials find 'weight < 250 g/m2'").text, "C98L2\nN85L15\nP98L2\nE95C\n");
  EXPECT_EQ(snug("materials find 'LT > 1'").text, "N88P\nE95C\nA92Np\nN95C\n");
  EXPECT_EQ(
      snug("materials find 'weight < 250 g/m2 and not (EMT > 30 % or composition ~ polyester)' --items weight").text,
      "id,weight\nC98L2,179.0 g/m2\nE95C,240.0 g/m2\n");
  EXPECT_EQ(snug("materials find 'parent = 003'").text, "003-01\n");
  expect("materials find 'wieght < 3 g/m2'", 2, "did you mean weight?");
  expect("materials find 'weight < 3'", 2, "question:1:10: error: \"3\" has no unit, weight comes in kg/m2");
  expect("materials edit N88P 'weight=1 g/m2'", 2, "what ships is not changed: copy it");
  expect("materials edit N88P MIU=0.3", 2, "a run would read your MIU");
  EXPECT_EQ(snug("materials edit N88P hand=soft").status, 0);
  EXPECT_EQ(snug("materials find 'hand = soft'").text, "N88P\n");
  EXPECT_EQ(snug("materials copy N88P mine").status, 0);
  EXPECT_EQ(
      snug("materials edit mine 'weight=240 g/m2' --also 'weight={ value=\"238 g/m2\", source=\"weighed\" }'").status,
      0);
  EXPECT_EQ(snug("materials find 'weight < 250 g/m2 and LT > 1'").text, "E95C\nmine\n");
  expect("materials show mine", 0, "238 g/m2");
  expect("materials history mine", 0, "copied from N88P");
  expect("materials undo", 0, "undone");
  EXPECT_EQ(snug("materials find 'weight < 250 g/m2 and LT > 1'").text, "E95C\n");
  expect("materials list", 0, "own fabrics: mine");
  expect("materials remove mine", 0, "");
  expect("materials check", 0, "sound, as the texts have it");
}

TEST_F(LibraryProgram, WithoutANameItIsInTheDataFolder) {
  ::unsetenv("SNUG_LIBRARY");
  ::setenv("XDG_DATA_HOME", (folder_ / "data").c_str(), 1);
  EXPECT_EQ(snug("materials find 'LT > 1'").status, 0);
  ::unsetenv("XDG_DATA_HOME");
  EXPECT_TRUE(fs::exists(folder_ / "data/snug/library.db"));
}

TEST_F(LibraryProgram, EquationsAndTablesAnswerWhenAsked) {
  expect("materials evaluate 001-01 warp", 0, "431.4926 N/m");
  expect("materials evaluate 'woven fabric of table 2.9' E_2 --with 'elongation=1 %'", 0, "78.4532 N/m");  // 80 gf/cm
  expect("materials evaluate 'woven fabric of table 2.8' \"S'_v\" --with eps_a=0.4", 2, "which has no number");
  expect("materials edit 001-01 'stiff={ equation=\"EA*weight\", unit=\"N/m\" }'", 2,
         "comes to Pa (kg/m2), its unit is \"N/m\"");
}

TEST_F(LibraryProgram, ExportedTextsAreImportedIntoAnotherLibrary) {
  ASSERT_EQ(snug("materials add garment shirt").status, 0);
  ASSERT_EQ(snug("materials add fabric knit --parent shirt 'weight=200 g/m2'").status, 0);
  for (const std::string ending : {"toml", "json", "csv"}) {
    ASSERT_EQ(snug("materials export own." + ending + " --own").status, 0);
    ::setenv("SNUG_LIBRARY", (folder_ / (ending + ".db")).c_str(), 1);
    expect("materials import own." + ending, 0, "2 entities");
    expect("materials show knit", 0, "parent \"shirt\"");
    ASSERT_EQ(snug("materials edit knit 'weight=210 g/m2'").status, 0);
    expect("materials import own." + ending, 2, "with other values; take another ID, or say --replace");
    expect("materials import own." + ending + " --replace", 0, "2 entities");
    ::setenv("SNUG_LIBRARY", file_.c_str(), 1);
  }
}

/// F = 400 e up to 20 %, F' = 2000 e^2 back (N/m): LT 1, WT 8 J/m2, RT 66.7 %; the strip is 25 mm wide and 80 mm long.
std::string strip(double factor) {
  std::string text = "Extension [mm],Load [N]\n";
  for (int k = 0; k <= 100; ++k) text += fmt::format("{},{}\n", 0.16 * k, factor * 0.02 * k);
  for (int k = 99; k >= 0; --k) text += fmt::format("{},{}\n", 0.16 * k, factor * 0.0002 * k * k);
  return text;
}
constexpr const char* shear_test = "angle [deg],force [gf/cm]\n0,0.8\n0.5,1.13\n5,4.15\n8,6.13\n5,2.45\n0.5,-0.44\n0,-0.8\n";

TEST_F(LibraryProgram, RawTestsBecomeAFabricThatACaseWears) {
  // fit prints the sheet with the formula of each number; what it prints is imported and worn, and as a section of a case it is the same
  // fabric; three specimens give means with deviations.
  write("strip.csv", strip(1.0)), write("weft.csv", strip(1.5)), write("shear.csv", shear_test);
  const std::string tests = "strip.csv shear.csv --weft weft.csv --width '25 mm' --gauge-length '80 mm' --with 'weight=215 g/m2' ";
  const std::string sheet = snug("materials fit " + tests + "--name 'my knit'").text;
  for (const char* line : {"[fabric.\"my knit\"]", "source = \"tests strip.csv, shear.csv, weft.csv\"", "law = \"kes\"", "# WT/(Fm EMT/2)", "WT = \"8.1577 gf cm/cm2\"", "EMT = \"20 %\"",
                           "# 100 WT'/WT", "G = \"0.65667 gf/(cm degree)\"", "2HG = \"1.57 gf/cm\"", "2HG5 = \"1.7 gf/cm\"", "WT = \"12.237 gf cm/cm2\"", "weight = \"215 g/m2\""})
    EXPECT_NE(sheet.find(line), std::string::npos) << line << "\n" << sheet;
  write("sheet.toml", sheet);
  expect("materials import sheet.toml", 0, "1 entities");
  expect("materials find 'RT > 66 % and RT < 67 %'", 0, "my knit");
  ASSERT_EQ(snug("new mine").status, 0);
  expect("check mine --set 'garment.fabric=\"my knit\"'", 0, "unknowns");
  expect("check mine --set 'garment.fabric=\"my knit\"' --set garment.branch=unloading", 0, "unknowns");
  const std::string section = snug("materials fit " + tests + "--case --name 'my knit'").text;
  EXPECT_NE(section.find("[garment.fabric]\nname = \"my knit\"\n"), std::string::npos) << section;
  EXPECT_NE(section.find("\n# EMT = "), std::string::npos) << "either force or elongation\n" << section;
  std::string text = content("mine/case.toml");
  const auto line = text.find("\nfabric = ") + 1;
  text.erase(line, text.find('\n', line) + 1 - line);
  write("mine/case.toml", text + "\n" + section);
  EXPECT_EQ(snug("materials curve mine").text, snug("materials curve 'my knit'").text);
  write("two.csv", strip(1.2)), write("three.csv", strip(1.4));
  expect("materials fit strip.csv two.csv three.csv shear.csv --width '25 mm' --gauge-length '80 mm'", 0, "WT = \"9.7893 +- 1.6 gf cm/cm2\"");
}

TEST_F(LibraryProgram, AFitThroughThePointsIsTheSameCurveInTheLibrary) {
  // law = "curve": the table drawn of the imported entry and of a case's own file agree to the digits that the entry prints.
  write("strip.csv", strip(1.0));
  ASSERT_EQ(snug("materials fit strip.csv --width '25 mm' --gauge-length '80 mm' --law curve --with 'shear=40 N/m' --name drawn --out drawn.toml").status, 0);
  expect("materials import drawn.toml", 0, "1 entities");
  const std::string of_library = snug("materials curve drawn --steps 4").text, of_file = snug("materials curve drawn.toml --steps 4").text;
  EXPECT_EQ(of_library, of_file);
  EXPECT_NE(of_library.find("drawn,tensile warp and weft loading,10,,40,"), std::string::npos) << of_library;
  EXPECT_NE(of_library.find("drawn,tensile warp and weft unloading,20,,80,"), std::string::npos) << of_library;
  expect("materials fit strip.csv strip.csv --width '25 mm' --gauge-length '80 mm' --law curve", 2, "a second tensile test of one direction");
}

TEST_F(LibraryProgram, WhatIsMissingInATestIsSaid) {
  write("strip.csv", strip(1.0)), write("odd.csv", "a,b\n1,2\n");
  expect("materials fit strip.csv", 2, "strip.csv:1:1: error: Extension is a length here; give the free length of the strip, --gauge-length");
  expect("materials fit odd.csv", 2, "odd.csv:1:1: error: the columns a, b are those of no test");
  expect("materials fit none.csv", 2, "none.csv");
  expect("materials fit strip.csv --width 25 --gauge-length '80 mm'", 2, "--width: error: \"25\" has no unit");
  expect("materials fit strip.csv --width '25 mm' --gauge-length '80 mm'", 0, "note: no test of shear: the law needs G, e.g. --with");
}

TEST_F(LibraryProgram, FabricsAreDrawnWithTheRangeOfTheirData) {
  // Any law, by name, of a case, and of a file: a table that says what lies beyond the data, and a picture.
  const std::string table = snug("materials curve N85L15 --steps 4").text;
  EXPECT_TRUE(table.starts_with("fabric,curve,strain [%],angle [deg],force [N/m],force [gf/cm],range\n"));
  EXPECT_NE(table.find("N85L15,tensile warp and weft loading,43.26,,45.428864,46.324549,data\n"), std::string::npos) << table;
  EXPECT_NE(table.find("N85L15,tensile warp and weft loading,54.075,,"), std::string::npos);
  EXPECT_NE(table.find("beyond the data"), std::string::npos);
  EXPECT_NE(table.find("N85L15,shear unloading,,8,"), std::string::npos) << table;
  expect("materials curve 009-01 --steps 2", 0, "law without range");
  expect("materials curve N85L15 --out n.svg", 0, "picture: n.svg");
  const std::string picture = content("n.svg");
  for (const char* part : {"<svg", "class=\"beyond\"", "stroke-dasharray", "tensile warp and weft unloading", "shear loading", "</svg>"})
    EXPECT_NE(picture.find(part), std::string::npos) << part;
  expect("materials curve N85L15 --out n.svg --csv", 0, "fabric,curve,strain");
  ASSERT_EQ(snug("new mine").status, 0);
  EXPECT_EQ(snug("materials curve mine --steps 3").text, snug("materials curve mine/case.toml --steps 3").text);
  expect("materials curve mine --steps 3", 0, ",tensile");
  expect("materials curve N85L16", 2, "there is no fabric, tissue or case \"N85L16\"; did you mean N85L15?");
  expect("materials curve 'relaxed claf'", 2, "did you mean relaxed calf?");
  expect("materials curve 'relaxed calf'", 0, "nominal stress");
  expect("materials curve N85L15 --out n.png", 2, "end its name in .svg");
}

TEST_F(LibraryProgram, EveryPrintedFabricCanBeWorn) {
  // The eight of table 5.2, which know their way back, and the nine denims of tables 2.5 and 2.6.
  ASSERT_EQ(snug("new mine").status, 0);
  for (const std::string name : {"N88P", "C98L2", "N85L15", "R95C", "P98L2", "E95C", "A92Np", "N95C"})
    expect("check mine --set garment.branch=unloading --set garment.fabric=" + name, 0, "unknowns");
  for (int n = 1; n <= 9; ++n) expect(fmt::format("check mine --set garment.fabric=00{}-01", n), 0, "unknowns");
  expect("check mine --set garment.branch=unloading --set garment.fabric=001-01", 2, "has no unloading curve; give its RT");
  expect("check mine --set garment.branch=back", 2, "is no branch");
  expect("materials show N85L15", 0, "thickness 0.57 mm, 0.531 mm at 5, 0.499 mm at 20, 0.476 mm at 50 gf/cm2");
  expect("materials show R95C", 0, "0.738 mm at 50 gf/cm2");
}

TEST_F(LibraryProgram, ASleeveOnARigidCylinderPressesByTheBranchItRunsOn) {
  // tube-sleeve on its rigid skin, 44 mm of sleeve on 55 mm, e = 0.25, held along the axis: p = F(e)/r going on, p = F'(e)/r coming back.
  // Fm = 1000 N/m at 50 %, LT = 1: F = 2000 e N/m; RT = 200 (1/ln 2 - 1) % makes LT' that of F' = Fm (2^(e/em) - 1).
  const std::string fabric = R"toml({ law="kes", LT=1, WT="250 J/m2", EMT=50, RT=88.53900817779268, G="300 N/(m rad)", poisson=0 })toml";
  const auto pressure = [&](const std::string& branch) {
    const std::string out = branch.empty() ? "plain" : branch;
    const Outcome outcome = snug(std::string("run '") + SNUG_SOURCE_DIR + "/cases/verification/tube-sleeve' --tier L1 --quiet --no-report --out " + out + " --set 'garment.fabric=" + fabric + "'" +
                                 (branch.empty() ? "" : " --set garment.branch=" + branch));
    EXPECT_EQ(outcome.status, 0) << outcome.text;
    return nlohmann::json::parse(content(out + "/summary.json"))["numbers"]["mean_contact_pressure_Pa"].get<double>();
  };
  const double loading = pressure("loading"), unloading = pressure("unloading");
  EXPECT_NEAR(loading, 500.0 / 0.055, 1e-4 * loading);
  EXPECT_NEAR(unloading, 1000.0 * (std::sqrt(2.0) - 1.0) / 0.055, 1e-4 * unloading);
  EXPECT_EQ(pressure(""), loading) << "the branch that is not named";
}

}  // namespace
}  // namespace snug
