// snug study: tables, orders and plot.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>
#include <sstream>

#include "cases/input/csv.hpp"
#include "tests/cases/program.hpp"

namespace snug {
namespace {

using testing::HasSubstr;

using Study = Program;

const std::string tube = std::string(SNUG_SOURCE_DIR) + "/cases/verification/tube-sleeve";

std::vector<double> column(const input::Csv& csv, const std::string& name) {
  input::Diagnostics diagnostics;
  const std::vector<double> values = input::numbers(csv, name, "", diagnostics);
  diagnostics.throw_if_any();
  return values;
}

// The mean pressure of the tube sleeve converges with more than the third power of the cell size against its exact
// answer; time, memory and unknowns of every run stand beside it, and gnuplot draws them where it is installed.
TEST_F(Study, OfTheTubeSleeveShowsItsOrderOfConvergence) {
  const Outcome outcome =
      snug("study '" + tube + "' --factors 0.5,0.71,1 --vary solver.tier=L4 --against reference --out study");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(folder_ / "study/study.csv", diagnostics);
  diagnostics.throw_if_any();
  const auto unknowns = column(csv, "unknowns"), nodes = column(csv, "skin_nodes");
  const auto wall = column(csv, "wall_s"), memory = column(csv, "memory_MB");
  const auto error = column(csv, "mean_pressure_error");
  ASSERT_EQ(error.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_GT(wall[n], 0.0);
    EXPECT_GT(memory[n], 10.0);
    if (n == 0) continue;
    EXPECT_GT(unknowns[n], unknowns[n - 1]);
    EXPECT_GT(2.0 * std::log(error[n - 1] / error[n]) / std::log(nodes[n] / nodes[n - 1]), 3.0) << "level " << n;
  }
  EXPECT_TRUE(std::filesystem::exists(folder_ / "study/study.md"));
  if (std::system("gnuplot --version > /dev/null 2>&1") == 0)
    EXPECT_TRUE(std::filesystem::exists(folder_ / "study/study.svg")) << outcome.text;  // removed when gnuplot fails
  else
    EXPECT_THAT(outcome.text, HasSubstr("gnuplot is not there"));
}

// Without an exact answer the finest run is the measure and has no error itself; a run that would take too long is
// left out and named.
TEST_F(Study, TakesTheFinestRunForMeasureAndKeepsToTheLimit) {
  const Outcome outcome =
      snug("study '" + tube + "' --factors 0.4,0.5,4 --vary solver.tier=L1 --against finest --limit 10 --out study");
  ASSERT_EQ(outcome.status, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("not run: solver.tier=L1, 4"));
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(folder_ / "study/study.csv", diagnostics);
  ASSERT_EQ(csv.rows.size(), 2u);
  const auto error = static_cast<std::size_t>(csv.find("pressure_rms_error"));
  EXPECT_LT(std::stod(csv.rows[0].cells[error]), 0.05);
  EXPECT_EQ(csv.rows[1].cells[error], "");
}

// What is wrong is said with its place and remedy before anything is solved.
TEST_F(Study, RefusesWhatItCannotMeasure) {
  Outcome outcome = snug("study '" + tube + "' --against exact");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("states no exact answer"));
  outcome = snug("study '" + tube + "' --factors 0.5,-1");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("--factors: error: -1 is no factor"));
  outcome = snug("study '" + tube + "' --vary solver.tier=L7 --out study");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_THAT(outcome.text, HasSubstr("L7"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "study"));
}

}  // namespace
}  // namespace snug
