// Garments of sewing patterns through the program: a case names a file, the pieces are sewn, placed and worn.
#include "tests/cases/program.hpp"

#include <nlohmann/json.hpp>

#include "tests/pattern_texts.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class SewnCase : public Program {
 protected:
  // The starter case on its rigid skin, coarse, and the same with a pattern of two halves as wide and as long as its tube.
  void SetUp() override {
    Program::SetUp();
    ASSERT_EQ(snug("new mine").status, 0);
    fs::create_directories(folder_ / "mine" / "patterns");
    write("mine/patterns/halves.toml", tests::tube_text(2, 420.0, 160.0));
  }

  double mean_pressure(const std::string& out) const {
    std::ifstream file(folder_ / out / "summary.json");
    return nlohmann::json::parse(file).at("numbers").at("mean_contact_pressure_Pa").get<double>();
  }

  nlohmann::json fit(const std::string& out) const {
    std::ifstream file(folder_ / out / "summary.json");
    return nlohmann::json::parse(file).at("fit");
  }

  const std::string coarse_ = " --no-report --set solver.tier=L1 --set body.cells_around=20 --set body.cells_along=8";
  const std::string tube_ = " --set 'garment.pattern={ kind = \"tube\", flat_circumference = \"420 mm\", length = \"160 mm\" }'";
  const std::string halves_ = " --set 'garment.pattern=\"patterns/halves.toml\"'";
};

TEST_F(SewnCase, TwoHalvesPressAsTheTubeDoes) {
  // The mean pressure of the sewn halves is that of the tube of the same size to five in a thousand, and the plan shows the fit by height.
  const Outcome tube = snug("run mine --out tube" + coarse_ + tube_), sewn = snug("run mine --out sewn" + coarse_ + halves_);
  ASSERT_EQ(tube.status, 0) << tube.text;
  ASSERT_EQ(sewn.status, 0) << sewn.text;
  EXPECT_NEAR(mean_pressure("sewn") / mean_pressure("tube"), 1.0, 5e-3);
  const nlohmann::json of_sewn = fit("sewn"), of_tube = fit("tube");
  ASSERT_EQ(of_sewn.size(), of_tube.size());
  for (std::size_t row = 0; row < of_sewn.size(); ++row) {
    EXPECT_NEAR(of_sewn[row].at("ease").get<double>(), of_tube[row].at("ease").get<double>(), 3e-3);
    EXPECT_NEAR(of_sewn[row].at("height_m").get<double>(), of_tube[row].at("height_m").get<double>(), 2e-3);
    EXPECT_NEAR(of_tube[row].at("garment_girth_m").get<double>(), 0.42, 1e-12);
  }
  const Outcome check = snug("check mine --set solver.tier=L1" + halves_);
  EXPECT_EQ(check.status, 0) << check.text;
  EXPECT_NE(check.text.find("420 mm round as cut"), std::string::npos) << check.text;
  EXPECT_NE(check.text.find("ease %"), std::string::npos) << check.text;
}

TEST_F(SewnCase, WrongPatternsAreRefusedWithThePlaceInTheCase) {
  // A file that is not there, a piece and an edge that are none: each error names what it found and what there is, and only that.
  const auto refused = [&](const std::string& set, const std::string& what) {
    const Outcome outcome = snug("check mine" + set);
    EXPECT_EQ(outcome.status, 2) << outcome.text;
    EXPECT_NE(outcome.text.find(what), std::string::npos) << outcome.text;
    return outcome.text;
  };
  const std::string missing = refused(" --set 'garment.pattern=\"patterns/none.toml\"'", "there is no file \"patterns/none.toml\"");
  EXPECT_EQ(missing.find("flat_circumference"), std::string::npos) << missing;
  refused(" --set 'garment.pattern={ file = \"patterns/halves.toml\", pieces = [\"part 7\"] }'", "\"part 7\" is no piece of");
  refused(halves_ + " --set 'garment.held=[{ edge = \"waist\", held = \"all\" }]'", "\"waist\" is no edge of the pattern");
  refused(" --set 'garment.pattern={ file = \"patterns/halves.toml\", length = \"160 mm\" }'", "length is of a tube");
  refused(halves_ + " --set garment.warp=around", "the pieces of a pattern have their grain");
  refused(" --set 'garment.pattern={ kind = \"tube\", length = \"160 mm\" }'", "the key flat_circumference is missing");
}

TEST_F(SewnCase, TheEchoNamesThePatternAndGivesTheSameAnswer) {
  // case.echo.toml in the case's place runs to the same digits.
  ASSERT_EQ(snug("run mine --out first" + coarse_ + halves_).status, 0);
  fs::copy_file(folder_ / "first" / "case.echo.toml", folder_ / "mine" / "case.toml", fs::copy_options::overwrite_existing);
  const Outcome again = snug("run mine --no-report --out again");
  ASSERT_EQ(again.status, 0) << again.text;
  EXPECT_EQ(mean_pressure("again"), mean_pressure("first"));
}

}  // namespace
}  // namespace snug
