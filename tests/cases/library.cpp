// The engineering database as a user meets it: snug materials, and cases that name its entries.
#include <cstdlib>
#include <iterator>
#include <map>

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

}  // namespace
}  // namespace snug
