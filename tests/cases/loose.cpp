// Cloth that is wider than the limb in places: it comes to rest where no step of the load leads on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

/// A tube on a finger of 70 mm that has a waist.
std::string finger(const std::string& layers, int along, const std::string& garment) {
  return R"(title = "A loose tube on a finger"
[body]
kind = "stations"
stations = "limb.csv"
layers = [{ name = "bone", material = "rigid" }, )" + layers + R"(]
cells_around = 16
cells_along = )" + std::to_string(along) + R"(
ends = "sliding"
[garment]
)" + garment + R"(
[contact]
)";
}

/// The run converged, and what is left of the forces on the garment is nothing beside those of the contact.
void expect_at_rest(const std::filesystem::path& out) {
  const auto summary = nlohmann::json::parse(std::ifstream(out / "summary.json"));
  EXPECT_EQ(summary["status"], "converged");
  double error = 0.0;
  for (const auto& component : summary["balance"]["force_error_N"]) error = std::max(error, std::abs(component.get<double>()));
  EXPECT_LT(error, 1e-9 * summary["balance"]["contact_force_N"].get<double>()) << summary["balance"];
}

int rows_of_creep(const std::filesystem::path& out) {
  std::ifstream file(out / "history.csv");
  int rows = 0;
  for (std::string line; std::getline(file, line);) rows += line.ends_with(",creeps");
  return rows;
}

const char* const columns = "height [mm], girth [mm], width_to_depth, bone_girth [mm], bone_width_to_depth, bone_x [mm], bone_y [mm]\n";

TEST_F(Program, ALooseTubeComesToRestWhereStepsDoNotLead) {
  // A stiff tube a tenth narrower than a finger at its thickest and a tenth wider than it at its waist: let go, it has no path of equilibria. It creeps to its
  // rest, which is an equilibrium, and the run says that it did. (Without creep: partial after 108 iterations.)
  write("limb.csv", std::string(columns) + "0, 58, 1.152, 25.057, 1.076, 0, -0.58\n17.5, 62.404, 1.152, 27.636, 1.076, 0, -0.624\n"
                    "35, 52.895, 1.152, 22.299, 1.076, 0, -0.529\n52.5, 48.346, 1.152, 20.321, 1.076, 0, -0.483\n70, 55.942, 1.152, 23.39, 1.076, 0, -0.559\n");
  write("case.toml", finger(R"({ name = "tissue", material = "muscle", cells = 2 }, { name = "skin", material = "skin", thickness = "1.3 mm" })", 4,
                            "pattern = { kind = \"tube\", flat_circumference = \"53.7842 mm\", length = \"32.318 mm\" }\nposition = \"22.365 mm\"\n"
                            "fabric = { law = \"linear\", warp = \"1200 N/m\", weft = \"60 N/m\", shear = \"150 N/m\" }"));
  const Outcome outcome = snug("run .");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  expect_at_rest(folder_ / "out");
  EXPECT_GT(rows_of_creep(folder_ / "out"), 0);
  EXPECT_NE(outcome.text.find("cloth crept to where it rests, "), std::string::npos) << outcome.text;
}

TEST_F(Program, ALooseTubeDoesNotFallTogether) {
  // A knit 5 % narrower than a finger of fat at its thickest and a fifth wider than it at its waist, where it is gathered: it comes to rest
  // without creep. (Where gathered cloth does not resist: partial after 120 iterations, triangles of a thousandth of their area.)
  write("limb.csv", std::string(columns) + "0, 58, 1.15, 25, 1.08, 0, -0.6\n23, 60, 1.15, 26, 1.08, 0, -0.6\n46, 48.5, 1.15, 20.5, 1.08, 0, -0.5\n"
                    "70, 56, 1.15, 25, 1.08, 0, -0.6\n");
  write("case.toml", finger(R"({ name = "tissue", material = { law = "neo-Hooke", shear_modulus = "1.5 kPa", poisson_ratio = 0.49 }, cells = 2 })", 6,
                            "pattern = { kind = \"tube\", flat_circumference = \"57 mm\", length = \"31 mm\" }\nfabric = \"C98L2\"\nposition = \"24 mm\"\n"
                            "held = [{ edge = \"upper\", held = \"axis\" }]"));
  const Outcome outcome = snug("run .");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  expect_at_rest(folder_ / "out");
  EXPECT_EQ(rows_of_creep(folder_ / "out"), 0);
}

}  // namespace
}  // namespace snug
