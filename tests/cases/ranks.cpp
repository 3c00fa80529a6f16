// The program on several ranks.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <vector>

#include "tests/cases/program.hpp"

namespace snug {
namespace {

/// Columns ux, uy, uz and pressure of skin.csv.
std::vector<std::array<double, 4>> skin_of(const std::filesystem::path& out) {
  std::ifstream file(out / "skin.csv");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line.rfind("node,x [m],y [m],z [m],ux [m],uy [m],uz [m],pressure [Pa]", 0), 0u) << line;
  std::vector<std::array<double, 4>> rows;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string cell;
    std::array<double, 4> row{};
    for (int i = 0; i < 8 && std::getline(cells, cell, ','); ++i)
      if (i >= 4) row[i - 4] = std::stod(cell);
    rows.push_back(row);
  }
  return rows;
}

TEST_F(Program, TwoAndFourRanksGiveTheAnswerOfOne) {
  // A sleeve all round a soft tube, cells shared out by METIS, so that the contact lies across every border between ranks.
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  const std::string coarse = "run mine --quiet --set body.cells_around=16 --set body.cells_along=2 ";
  std::vector<std::vector<std::array<double, 4>>> answers;
  for (const int ranks : {1, 2, 4}) {
    const Outcome outcome = snug(coarse + "--ranks " + std::to_string(ranks) + " --out of" + std::to_string(ranks));
    ASSERT_EQ(outcome.status, 0) << outcome.text;
    answers.push_back(skin_of(folder_ / ("of" + std::to_string(ranks))));
    ASSERT_FALSE(answers.back().empty());
    ASSERT_EQ(answers.back().size(), answers.front().size());
  }
  double displacement = 0.0, pressure = 0.0;
  for (const auto& row : answers[0]) {
    displacement = std::max(displacement, std::hypot(row[0], row[1], row[2]));
    pressure = std::max(pressure, row[3]);
  }
  EXPECT_GT(pressure, 1000.0);
  for (const auto& other : {answers[1], answers[2]})
    for (std::size_t i = 0; i < other.size(); ++i) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(other[i][c], answers[0][i][c], 1e-8 * displacement) << i;
      EXPECT_NEAR(other[i][3], answers[0][i][3], 1e-8 * pressure) << i;
    }
}

// A launcher that tells of its processes by PMIx alone, as srun does, gives one run on two ranks; and where a launcher has started several
// that MPI does not know of, none of them computes the whole for itself.
TEST_F(Program, LaunchersBesideMpirunAreKnown) {
  ASSERT_EQ(snug("new mine --like tube-sleeve").status, 0);
  const std::string coarse = "run mine --quiet --set body.cells_around=16 --set body.cells_along=2 ";
  const Outcome pmix = snug(coarse + "--out two", "mpirun -n 2 --oversubscribe $([ $(id -u) = 0 ] && echo --allow-run-as-root) env -u OMPI_COMM_WORLD_SIZE");
  ASSERT_EQ(pmix.status, 0) << pmix.text;
  std::ifstream summary(folder_ / "two/summary.json");
  const std::string text((std::istreambuf_iterator<char>(summary)), {});
  EXPECT_NE(text.find("\"ranks\": 2,"), std::string::npos);
  const Outcome unknown = snug(coarse + "--out three", "env PMI_SIZE=3 PMI_RANK=0");
  EXPECT_EQ(unknown.status, 2) << unknown.text;
  EXPECT_NE(unknown.text.find("started 3 processes"), std::string::npos) << unknown.text;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "three"));
}

}  // namespace
}  // namespace snug
