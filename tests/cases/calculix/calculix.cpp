// The same body in snug and in CalculiX. Registered where ccx is installed.
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <map>
#include <sstream>

#include "tests/cases/program.hpp"
#include "tests/verification/book.hpp"

namespace snug {
namespace {

namespace fs = std::filesystem;

using CalculiX = Program;

/// Positions by node number, of the *NODE lines of an input.
std::map<int, std::array<double, 3>> read_nodes(const fs::path& file) {
  std::map<int, std::array<double, 3>> nodes;
  std::ifstream in(file);
  bool inside = false;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("*")) {
      inside = line == "*NODE";
    } else if (inside) {
      int n = 0;
      std::array<double, 3> x{};
      if (std::sscanf(line.c_str(), "%d, %lf, %lf, %lf", &n, &x[0], &x[1], &x[2]) == 4) nodes[n] = x;
    }
  }
  return nodes;
}

/// Mean radial displacement over the nodes printed last.
double mean_radial(const fs::path& dat, const std::map<int, std::array<double, 3>>& nodes) {
  std::ifstream in(dat);
  double sum = 0.0, count = 0.0;
  for (std::string line; std::getline(in, line);) {
    if (line.find("displacements") != std::string::npos) sum = count = 0.0;  // of a later time
    int n = 0;
    std::array<double, 3> u{};
    if (std::sscanf(line.c_str(), "%d %lf %lf %lf", &n, &u[0], &u[1], &u[2]) != 4) continue;
    const auto& x = nodes.at(n);
    sum += (x[0] * u[0] + x[1] * u[1]) / std::hypot(x[0], x[1]);
    count += 1.0;
  }
  return sum / count;
}

// The limb alone under pressure, written by snug convert and solved by CalculiX with 20-node bricks, moves as in snug.
TEST_F(CalculiX, MovesTheLimbUnderPressureAsSnugDoesWithinATenThousandth) {
  const std::string limb = std::string(SNUG_SOURCE_DIR) + "/cases/verification/peer-limb-alone";
  const Outcome converted = snug("convert '" + limb + "' limb.inp");
  ASSERT_EQ(converted.status, 0) << converted.text;
  ASSERT_EQ(std::system(("cd '" + folder_.string() + "' && OMP_NUM_THREADS=1 ccx limb > log 2>&1").c_str()), 0);
  const double theirs = mean_radial(folder_ / "limb.dat", read_nodes(folder_ / "limb.inp"));
  const Outcome run = snug("run '" + limb + "' --quiet --out out");
  ASSERT_EQ(run.status, 0) << run.text;
  std::ifstream file(folder_ / "out/summary.json");
  const double ours = nlohmann::json::parse(file)["numbers"]["mean_skin_radial_displacement_m"];
  tests::book("peers P0", "displacement of the skin, m", ours, theirs, 1e-4, "CalculiX, the same cells as C3D20R");
}

// What CalculiX's law cannot say is refused with the remedy.
TEST_F(CalculiX, RefusesWhatCannotBeWritten) {
  const std::string cases = std::string(SNUG_SOURCE_DIR) + "/cases/verification/";
  EXPECT_EQ(snug("convert '" + cases + "limb-alone' limb.inp").status, 2);
  const Outcome garment = snug("convert '" + cases + "peer-limb' limb.inp");
  EXPECT_EQ(garment.status, 2);
  EXPECT_NE(garment.text.find("without [garment]"), std::string::npos) << garment.text;
  EXPECT_FALSE(fs::exists(folder_ / "limb.inp"));
}

}  // namespace
}  // namespace snug
