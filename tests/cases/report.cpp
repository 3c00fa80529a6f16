// Pages that the program writes about its results.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

class ReportProgram : public Program {
 protected:
  /// Seconds: the garment on the rigid skin, coarse.
  const std::string coarse_ =
      " --quiet --tier L1 --set body.cells_around=12 --set body.cells_along=4 "
      "--set 'garment.cell_size=\"25 mm\"' ";
};

TEST_F(ReportProgram, EveryRunLeavesAPage) {
  // report.html comes with the results and names the command; --no-report leaves it out; report writes it later.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug("run mine" + coarse_).status, 0);
  const std::string page = text_of(folder_ / "mine/out/report.html");
  for (const std::string part : {"<svg class=\"plot map\"", "Front thigh", "Rules that fired",
                                 "snug run mine --quiet --tier L1", "body.cells_around", "No pictures here"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  ASSERT_EQ(snug("run mine --no-report" + coarse_).status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "mine/out/report.html"));
  EXPECT_EQ(snug("report mine/out --no-pictures").status, 0);
  EXPECT_TRUE(fs::exists(folder_ / "mine/out/report.html"));
}

TEST_F(ReportProgram, RunsAreComparedOnOnePage) {
  // Two fabrics side by side; what is no result of a run, and one result alone, are wrong input.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug("run mine --no-report --out soft" + coarse_).status, 0);
  ASSERT_EQ(
      snug("run mine --no-report --out tight --set 'garment.pattern.flat_circumference=\"400 mm\"'" + coarse_).status,
      0);
  const Outcome outcome = snug("report --compare soft tight --out fabrics.html");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const std::string page = text_of(folder_ / "fabrics.html");
  for (const std::string part : {"soft · tight", "garment.pattern.flat_circumference", "0.42 m", "0.4 m", "map-1"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(snug("report --compare soft").status, 2);
  EXPECT_EQ(snug("report mine").status, 2);
  EXPECT_EQ(snug("report soft --out here.html").status, 2);
}

TEST_F(ReportProgram, AFilmIsMadeOfTheStatesOfTheLoadPath) {
  // --states walks the path and comes to the same answer as the jump; the film has the states and frames between them.
  // Without --states nothing is kept, and there is no film.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  ASSERT_EQ(snug("run mine --no-report --out jump" + coarse_).status, 0);
  ASSERT_EQ(snug("run mine --no-report --out walk --states 3" + coarse_).status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "jump/states"));
  EXPECT_EQ(snug("animate jump").status, 2);
  const auto mean = [&](const char* out) {
    return nlohmann::json::parse(text_of(folder_ / out / "summary.json"))["numbers"]["mean_contact_pressure_Pa"]
        .get<double>();
  };
  EXPECT_NEAR(mean("walk"), mean("jump"), 1e-6 * mean("jump"));
  const Outcome outcome = snug("animate walk --frames 9");
  EXPECT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("9 frames from 7 states"), std::string::npos) << outcome.text;
  EXPECT_TRUE(fs::exists(folder_ / "walk/animation/skin_0008.vtu"));
  EXPECT_EQ(snug("animate walk --step 3").status, 2);
}

}  // namespace
}  // namespace snug
