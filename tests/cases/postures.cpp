// A movement through the program: what is said before it, written of it, and what is left out of a case that has none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

using testing::HasSubstr;

const std::string coarse = " --set body.cells_around=8 --set body.cells_along=8 --set body.layers.1.cells=1 --set garment.cell_size=\"25 mm\" --set posture.0.move.turn=\"20 deg\"";

// The knee on a coarse mesh, bent by 20 degrees and straightened: plan, terminal, summary, table, page and film have the postures; every state balances.
TEST_F(Program, AMovementIsPlannedSaidWrittenAndFilmed) {
  ASSERT_EQ(snug("new mine --like knee-bend").status, 0);
  const Outcome check = snug("check mine" + coarse);
  ASSERT_EQ(check.status, 0) << check.text;
  EXPECT_THAT(check.text, HasSubstr("posture: bent, shank 20.0 deg, in 2 steps at least"));
  EXPECT_THAT(check.text, HasSubstr("posture: straight again, as put on, in 2 steps at least"));
  const Outcome run = snug("run mine" + coarse);
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("posture            bent (shank 20 deg): "));
  const auto summary = nlohmann::json::parse(std::ifstream(folder_ / "mine/out/summary.json"));
  ASSERT_EQ(summary["postures"].size(), 3u);
  EXPECT_EQ(summary["postures"][0]["name"], "dressed");
  EXPECT_NEAR(summary["postures"][1]["bones"][0]["turn_rad"].get<double>(), 0.349065850398866, 1e-12);
  for (const auto& posture : summary["postures"]) {
    EXPECT_EQ(posture["locations"].size(), 3u);
    EXPECT_LE(posture["force_error_N"].get<double>(), 1e-8 * posture["contact_force_N"].get<double>()) << posture;
  }
  const std::size_t states = summary["movement"]["progress"].size();
  EXPECT_GE(states, 5u);
  std::istringstream rows(text_of(folder_ / "mine/out/comfort.csv"));
  std::string line;
  std::size_t lines = 0;
  while (std::getline(rows, line)) ++lines;
  EXPECT_EQ(lines, 1 + 4 * states);
  EXPECT_THAT(text_of(folder_ / "mine/out/report.html"), HasSubstr("<h2>Movement</h2>"));
  std::size_t films = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "mine/out/states")) films += entry.path().filename().string().starts_with("garment_");
  EXPECT_EQ(films + 1, states);  // the last one is the result itself
  EXPECT_THAT(snug("animate mine/out --frames 12").text, HasSubstr("12 frames from"));
}

// Tier L1 has nothing that bends: it says so and leaves the postures out, and nothing of them is written.
TEST_F(Program, OnTheRigidSkinPosturesAreLeftOutWithAWord) {
  ASSERT_EQ(snug("new mine --like knee-bend").status, 0);
  const Outcome run = snug("run mine --tier L1" + coarse);
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_THAT(run.text, HasSubstr("the postures are left out: tier L1 has a rigid skin"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "mine/out/comfort.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "mine/out/states"));
  EXPECT_EQ(text_of(folder_ / "mine/out/summary.json").find("\"postures\""), std::string::npos);
}

// What the mesh alone can tell is told by check, with the place in the file: a joint outside the limb, and a turn for which the blend is too short.
TEST_F(Program, AJointThatDoesNotFitTheBodyIsRefused) {
  ASSERT_EQ(snug("new mine --like knee-bend").status, 0);
  const Outcome outside = snug("check mine --set bone.joint.point.2=\"1700 mm\"");
  EXPECT_EQ(outside.status, 2);
  EXPECT_THAT(outside.text, HasSubstr("the joint of \"shank\" at (0, 0, 1700) mm lies outside the body"));
  const Outcome folded = snug("check mine --set bone.joint.blend=\"6 mm\"");
  EXPECT_EQ(folded.status, 2);
  EXPECT_THAT(folded.text, HasSubstr("the core would fold at the joint of \"shank\""));
  EXPECT_THAT(folded.text, HasSubstr("joint.blend = \""));
}

}  // namespace
}  // namespace snug
