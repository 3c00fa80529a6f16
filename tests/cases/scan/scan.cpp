// A thigh of a real scan, cut, layered, worn and scored by the same commands as any other case. Registered only where
// the folder SNUG_SCAN_DIR holds the scan.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

// The scan's axes: y up, z to the front, so that the body's side (+x) is the file's -x. The thigh at x > 0 in the file
// has its outer side at 180 deg. The sleeve covers heights of 570 to 690 mm, 15 % smaller than the mean girth there.
constexpr const char* worn_thigh = R"(
title = "Sleeve on a scanned thigh"
[body]
kind = "scan"
layers = [
  { name = "bone",   material = "rigid" },
  { name = "tissue", material = "relaxed thigh", cells = 3 },
  { name = "skin",   material = "skin", thickness = "1.5 mm" },
]
cells_around = 32
cells_along = 12
[body.scan]
surface = "mean_female.obj"
up = "y"
front = "z"
lower = { point = ["90 mm", "550 mm", "0 mm"], normal = [0, -1, 0] }
upper = { point = ["90 mm", "720 mm", "0 mm"], normal = [0, 1, 0] }
smoothing_radius = "20 mm"
bone = { girth = "82 mm" }
[[body.locations]]
name = "Front thigh"
from_angle = "45 deg"
to_angle = "135 deg"
from_height = "580 mm"
to_height = "675 mm"
[[body.locations]]
name = "Side thigh"
from_angle = "135 deg"
to_angle = "225 deg"
from_height = "580 mm"
to_height = "675 mm"
[[body.locations]]
name = "Back thigh"
from_angle = "225 deg"
to_angle = "315 deg"
from_height = "580 mm"
to_height = "675 mm"
[garment]
pattern = { kind = "tube", flat_circumference = "FLAT", length = "120 mm" }
fabric = "N85L15"
position = "570 mm"
held = [{ edge = "upper", held = "axis" }]
[contact]
[comfort]
curves = "wear trial 2002"
)";

class ScannedThigh : public Program {
 protected:
  void SetUp() override {
    Program::SetUp();
    fs::create_directories(folder_ / "worn");
    fs::copy_file(fs::path(SNUG_SCAN_DIR) / "mean_female.obj", folder_ / "worn/mean_female.obj");
    std::string text = worn_thigh;
    text.replace(text.find("FLAT"), 4, "432 mm");
    write("worn/case.toml", text);
  }
  nlohmann::json summary() const {
    std::ifstream file(folder_ / "worn/out/summary.json");
    return nlohmann::json::parse(file);
  }
};

TEST_F(ScannedThigh, IsCheckedAndMeshedWithItsGirths) {
  // check and mesh print the girths of the cut thigh and the ease of the sleeve on it.
  for (const std::string command : {"check worn", "mesh worn"}) {
    const Outcome outcome = snug(command);
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    for (const std::string part : {"girth [mm]", "smooth skin against the scan", "% smaller", "min jacobian"})
      EXPECT_NE(outcome.text.find(part), std::string::npos) << outcome.text;
    std::cout << outcome.text;
  }
}

TEST_F(ScannedThigh, WearsASleeveWhosePressureIsThatOfLaplaceOnAverage) {
  // On a soft but thick thigh the mean pressure stays near tension times curvature of the undeformed skin.
  const Outcome outcome = snug("run worn");
  std::cout << outcome.text;
  ASSERT_EQ(outcome.status, 0);
  const nlohmann::json result = summary();
  EXPECT_EQ(result.at("status"), "converged");
  const double mean = result.at("numbers").at("mean_contact_pressure_Pa");
  EXPECT_LT(std::abs(mean / result.at("mean_laplace_pressure_Pa").get<double>() - 1.0), 0.15);
  ASSERT_EQ(result.at("locations").size(), 3u);
  for (const auto& row : result.at("locations")) {
    EXPECT_GT(row.at("mean_pressure_Pa").get<double>(), 0.3 * mean) << row;
    EXPECT_LT(row.at("mean_pressure_Pa").get<double>(), 3.0 * mean) << row;
  }
  EXPECT_GE(result.at("comfort").at("score").get<double>(), 0.0);
  EXPECT_LE(result.at("comfort").at("score").get<double>(), 4.0);
}

}  // namespace
}  // namespace snug
