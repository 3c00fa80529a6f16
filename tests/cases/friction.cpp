// Friction through the program: what is written and said, and the answer on two ranks.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

std::vector<std::map<std::string, double>> table(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::vector<std::string> names;
  std::getline(file, line);
  for (std::istringstream cells(line); std::getline(cells, cell, ',');) names.push_back(cell);
  std::vector<std::map<std::string, double>> rows;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (const std::string& name : names)
      if (std::getline(cells, cell, ',')) rows.back()[name] = std::stod(cell);
  }
  return rows;
}

TEST_F(Program, FrictionIsWrittenSaidAndTheSameOnTwoRanks) {
  // The thigh with friction on a coarse mesh: every file has shear and slip, the bound holds at every node of the skin, the
  // spread over the assumed donning paths is told, and two ranks give the answer of one to 1e-8.
  ASSERT_EQ(snug("new mine --like thigh-sleeve").status, 0);
  const std::string coarse =
      "run mine --set body.cells_around=16 --set body.cells_along=6 --set contact.friction=0.25 --set contact.spread=true ";
  const Outcome one = snug(coarse + "--out of1"), two = snug(coarse + "--ranks 2 --out of2");
  ASSERT_EQ(one.status, 0) << one.text;
  ASSERT_EQ(two.status, 0) << two.text;
  for (const char* said : {"friction: coefficient 0.25", "sum of the points' tangential forces", "of the contact slips",
                           "spread over the assumed way of putting on", "friction over the last 50 % of the tightening"})
    EXPECT_NE(one.text.find(said), std::string::npos) << said;

  const auto summary = nlohmann::json::parse(std::ifstream(folder_ / "of1/summary.json"));
  EXPECT_GT(summary["balance"]["friction_force_N"].get<double>(), 0.1);
  EXPECT_GT(summary["numbers"]["max_shear_traction_Pa"].get<double>(), 1.0);
  EXPECT_EQ(summary["numbers"].count("slipping_share_of_contact"), 1u);
  EXPECT_EQ(summary["spread_over_donning_paths"].size(), 3u);
  for (const auto& row : summary["spread_over_donning_paths"]) EXPECT_TRUE(row["converged"].get<bool>()) << row;
  for (const char* file : {"of1/body_0000.vtu", "of1/garment_0000.vtu"})
    for (const char* field : {"\"shear_traction\"", "\"slip\""})
      EXPECT_NE(text_of(folder_ / file).find(field), std::string::npos) << file << " " << field;

  const auto first = table(folder_ / "of1/skin.csv"), second = table(folder_ / "of2/skin.csv");
  ASSERT_EQ(first.size(), second.size());
  double pressure = 0.0, moved = 0.0;
  for (const auto& row : first) {
    pressure = std::max(pressure, row.at("pressure [Pa]"));
    moved = std::max(moved, std::hypot(row.at("ux [m]"), row.at("uy [m]"), row.at("uz [m]")));
    const double shear = std::hypot(row.at("shear x [Pa]"), row.at("shear y [Pa]"), row.at("shear z [Pa]"));
    EXPECT_LE(shear, (1.0 + 1e-7) * 0.25 * row.at("pressure [Pa]"));
    EXPECT_EQ(row.at("slip") > 0.0, row.at("pressure [Pa]") > 0.0);
  }
  for (std::size_t i = 0; i < first.size(); ++i)
    for (const auto& [name, value] : first[i]) {
      const double size = name.front() == 'u' ? moved : name.ends_with("[Pa]") ? pressure : 0.0;
      if (size == 0.0) continue;
      EXPECT_NEAR(second[i].at(name), value, 1e-8 * size) << "node " << i << " " << name;
    }
}

TEST_F(Program, AFrictionlessRunHasNoColumnsOfFriction) {
  // What a case does not name is not there.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  const Outcome run = snug("run mine --set body.cells_around=8 --set body.cells_along=1 --tier L1");
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(run.text.find("donning"), std::string::npos) << run.text;
  EXPECT_EQ(table(folder_ / "mine/out/skin.csv").front().count("slip"), 0u);
  EXPECT_EQ(text_of(folder_ / "mine/out/summary.json").find("donning"), std::string::npos);
}

}  // namespace
}  // namespace snug
