// Cloth that is wider than the limb in places: it comes to rest where no step of the load leads on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

/// A tube on a finger of 70 mm with a waist, as wide as the finger's thick end.
std::string finger(const std::string& tissue, const std::string& garment) {
  return R"(title = "A loose tube on a finger"
[body]
kind = "stations"
stations = "limb.csv"
layers = [{ name = "bone", material = "rigid" }, )" + tissue + R"(]
cells_around = 16
cells_along = 6
ends = "sliding"
[garment]
)" + garment + R"(
[contact]
)";
}

const char* const girths = "height [mm], girth [mm], width_to_depth, bone_girth [mm], bone_width_to_depth, bone_x [mm], bone_y [mm]\n"
                           "0, 58, 1.15, 25, 1.08, 0, -0.6\n23, 60, 1.15, 26, 1.08, 0, -0.6\n46, 48.5, 1.15, 20.5, 1.08, 0, -0.5\n70, 56, 1.15, 25, 1.08, 0, -0.6\n";

TEST_F(Program, ALooseTubeComesToRestWhereStepsDoNotLead) {
  // A knit 5 % narrower than a finger of fat at its thickest and a fifth wider than it at its waist: cloth there is gathered, buckles when it is let go, and
  // comes to rest by creeping, in an equilibrium. (Without creep and packing: partial after 120 iterations.)
  write("limb.csv", girths);
  write("case.toml", finger(R"({ name = "tissue", material = { law = "neo-Hooke", shear_modulus = "1.5 kPa", poisson_ratio = 0.49 }, cells = 2 })",
                            "pattern = { kind = \"tube\", flat_circumference = \"57 mm\", length = \"31 mm\" }\nfabric = \"C98L2\"\nposition = \"24 mm\"\n"
                            "held = [{ edge = \"upper\", held = \"axis\" }]"));
  const Outcome outcome = snug("run .");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  const auto summary = nlohmann::json::parse(std::ifstream(folder_ / "out/summary.json"));
  EXPECT_EQ(summary["status"], "converged");
  double error = 0.0;
  for (const auto& component : summary["balance"]["force_error_N"]) error = std::max(error, std::abs(component.get<double>()));
  EXPECT_LT(error, 1e-9 * summary["balance"]["contact_force_N"].get<double>()) << summary["balance"];
}

}  // namespace
}  // namespace snug
