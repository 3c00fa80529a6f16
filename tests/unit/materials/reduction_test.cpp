// Raw tests reduced to the quantities of a sheet, against tests whose quantities are known.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "cases/input/csv.hpp"
#include "materials/fabric/fabric_data.hpp"
#include "materials/fabric/inputs.hpp"
#include "materials/fabric/measured.hpp"
#include "materials/fabric/reduction.hpp"
#include "tests/unit/materials/measured_fabrics.hpp"

namespace snug::testing {
namespace {

using materials::RawTest, materials::reduced, materials::Sample, materials::TensionCurve, materials::TestKind;

constexpr double degree = M_PI / 180;  // rad

class RawTable : public ::testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }
  std::map<std::string, double> of(const std::string& text, const materials::Specimen& specimen = {}) const {
    return reduced(materials::read_test(write("test.csv", text), specimen));
  }
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("snug-reduction-" + std::to_string(::getpid()));
};

/// Table 2.9 of the source: strain, force in gf/cm.
std::vector<Sample> table_2_9() {
  input::Diagnostics diagnostics;
  const input::Csv csv =
      input::read_csv(std::filesystem::path(SNUG_SOURCE_DIR) / "tests/data/library/table_2_9.csv", diagnostics);
  std::vector<Sample> samples;
  for (const auto& row : csv.rows) samples.push_back({std::stod(row.cells[0]) / 100, std::stod(row.cells[1])});
  return samples;
}

TEST(Table29, TheCurveMeetsEveryPointAndTheExponentialMissesThem) {
  // 32 points: WT 5.4845 gf cm/cm2 and LT 0.77089 by trapezia, EMT 3.1 %; the law of points misses by nothing, the
  // exponential of these three numbers by 7.0 gf/cm at 2.9 % (B4).
  const std::vector<Sample> samples = table_2_9();
  ASSERT_EQ(samples.size(), 32u);
  RawTest test{.kind = TestKind::tensile, .samples = samples, .where = {}};
  const auto sheet = reduced(test);
  EXPECT_NEAR(sheet.at("WT"), 5.4845, 5e-5);
  EXPECT_NEAR(sheet.at("LT"), 0.77089, 5e-6);
  EXPECT_NEAR(sheet.at("EMT"), 0.031, 1e-15);
  EXPECT_EQ(sheet.at("Fm"), 459.0);
  EXPECT_EQ(sheet.count("RT"), 0u) << "there is no way back";
  std::vector<materials::CurvePoint> points;
  for (const Sample& sample : samples) points.push_back({sample.x, sample.y * gf_per_cm});
  const TensionCurve through = materials::curve_through(points, {}),
                     kes = TensionCurve::kes(sheet.at("LT"), sheet.at("WT") * gf_per_cm, sheet.at("Fm") * gf_per_cm);
  double furthest = 0.0, there = 0.0;
  for (const Sample& sample : samples) {
    EXPECT_NEAR(nominal(through, sample.x) / gf_per_cm, sample.y, 1e-10) << sample.x;
    const double miss = std::abs(nominal(kes, sample.x) / gf_per_cm - sample.y);
    if (miss > furthest) furthest = miss, there = sample.x;
  }
  EXPECT_NEAR(furthest, 7.0, 0.05);
  EXPECT_NEAR(there, 0.029, 1e-12);
}

TEST(KesRoundTrip, PrintedNumbersComeBackFromTheirCurve) {
  // LT, WT, EMT of the eight fabrics of table 5.2 and the three of table 7.1 (and RT of all): a test drawn from the
  // curve, reduced again, prints the same digits.
  struct Row {
    const char* name;
    double LT, WT, EMT, Fm, RT;  // EMT 0: not printed, Fm = 50 gf/cm
  };
  for (const Row& row : std::vector<Row>{{"N88P", 1.09, 11.01, 0, 50, 72.47},
                                         {"C98L2", 0.83, 3.76, 24.56, 0, 57.26},
                                         {"N85L15", 1.00, 10.02, 43.26, 0, 72.89},
                                         {"R95C", 0.96, 9.13, 0, 50, 56.01},
                                         {"P98L2", 0.78, 6.28, 56.39, 0, 54.02},
                                         {"E95C", 1.05, 13.36, 0, 50, 65.32},
                                         {"A92Np", 1.14, 8.79, 0, 50, 60.10},
                                         {"N95C", 1.01, 8.18, 0, 50, 51.31},
                                         {"C98L2 of table 7.1", 0.83, 3.76, 24.56, 0, 57.26},
                                         {"N85L15 of table 7.1", 1.00, 10.02, 43.26, 0, 72.89},
                                         {"P98L2 of table 7.1", 0.78, 6.27, 56.39, 0, 54.01}}) {
    const materials::KesTension tension{.LT = row.LT,
                                        .WT = row.WT * gf_per_cm,
                                        .Fm = row.EMT > 0 ? std::nullopt : std::optional(row.Fm * gf_per_cm),
                                        .EMT = row.EMT > 0 ? std::optional(row.EMT) : std::nullopt,
                                        .RT = row.RT};
    const TensionCurve up = tension.curve(), back = tension.unloading_curve();
    const double em = std::sqrt(1 + 2 * up.data_end()) - 1;
    RawTest test{.kind = TestKind::tensile, .samples = {}, .where = {}};
    constexpr int n = 400;
    for (int k = 0; k <= n; ++k) test.samples.push_back({em * k / n, nominal(up, em * k / n)});
    for (int k = n - 1; k >= 0; --k) test.samples.push_back({em * k / n, nominal(back, em * k / n)});
    const auto sheet = reduced(test);
    EXPECT_NEAR(sheet.at("LT"), row.LT, 0.005) << row.name;
    EXPECT_NEAR(sheet.at("WT") / gf_per_cm, row.WT, 0.005) << row.name;
    EXPECT_NEAR(100 * sheet.at("EMT"), row.EMT > 0 ? row.EMT : 200 * row.WT / (row.LT * row.Fm), 0.005) << row.name;
    EXPECT_NEAR(100 * sheet.at("RT"), row.RT, 0.005) << row.name;
  }
}

TEST_F(RawTable, AStripTesterAndAKesMachineGiveTheSameSheet) {
  // One curve as force of 25 mm over extension of 80 mm with the way back in later rows, and as force per width over
  // percent with the way back in a column: F = 400 e N/m up to 20 %, back F' = 2000 e^2. WT = 8 J/m2, RT = 2/3, LT = 1.
  std::string machine = "Time (s),Extension (mm),Load (N)\n", kes = "strain [%];force [gf/cm];unloading [gf/cm]\n";
  for (int k = 0; k <= 200; ++k)
    machine += std::to_string(k) + "," + std::to_string(0.08 * k) + "," + std::to_string(0.01 * k) + "\n";
  for (int k = 199; k >= 0; --k) {
    std::ostringstream line;
    line.precision(12);
    line << 400 - k << "," << 0.08 * k << "," << 0.025 * 2000 * 1e-6 * k * k << "\n";
    machine += line.str();
  }
  for (int k = 0; k <= 200; ++k) {
    std::ostringstream line;
    line.precision(12);
    line << 0.1 * k << ";" << 0.4 * k / gf_per_cm << ";" << 2e-3 * k * k / gf_per_cm << "\n";
    kes += line.str();
  }
  for (const auto& sheet : {of(machine, {.width = 0.025, .gauge_length = 0.08}), of(kes)}) {
    EXPECT_NEAR(sheet.at("WT"), 8.0, 1e-5);
    EXPECT_NEAR(sheet.at("LT"), 1.0, 1e-6);
    EXPECT_NEAR(sheet.at("Fm"), 80.0, 1e-6);
    EXPECT_NEAR(sheet.at("EMT"), 0.2, 1e-9);
    EXPECT_NEAR(sheet.at("RT"), 2.0 / 3.0, 2e-5);
  }
}

TEST_F(RawTable, APretensionCounts0AndAnUnfinishedWayBackHasNoResilience) {
  EXPECT_NEAR(of("strain [%],force [N/m]\n0,2\n10,12\n20,22\n").at("WT"), 2.0, 1e-12);
  EXPECT_NEAR(of("strain [1],force [N/m]\n0,0\n0.1,10\n0.2,20\n").at("WT"), 2.0, 1e-12);
  EXPECT_NEAR(of("strain [%],force [N/m]\n0,0\n20,20\n15,10\n10,0\n5,0\n").at("RT"), 0.5, 1e-12) << "5 % remain";
  EXPECT_EQ(of("strain [%],force [N/m]\n0,0\n20,20\n15,10\n10,5\n").count("RT"), 0u);
}

/// A loop 0, a, -a, 0 of y = slope x +- width(|x|)/2 with its sign that of the direction of x.
std::string loop(const std::string& head, double a, double slope, auto width) {
  std::ostringstream text;
  text.precision(14);
  text << head << "\n";
  const auto row = [&](double x, double sign) {
    text << x << "," << slope * x + 0.5 * sign * width(std::abs(x)) << "\n";
  };
  for (int k = 0; k <= 80; ++k) row(a * k / 80, 1);
  for (int k = 80; k >= -80; --k) row(a * k / 80, -1);
  for (int k = -80; k <= 0; ++k) row(a * k / 80, 1);
  return text.str();
}

TEST_F(RawTable, ShearOfAKesSheetComesBackFromItsLoop) {
  // F = G phi +- HG with table 5.2's N85L15: G 0.66 gf/(cm degree), 2HG 1.57, 2HG5 1.70 gf/cm; friction that grows is
  // no stiffness.
  const auto width = [](double degrees) { return 1.57 + std::clamp((degrees - 0.5) / 4.5, 0.0, 1.0) * (1.70 - 1.57); };
  const auto sheet = of(loop("angle [deg],force [gf/cm]", 8.0, 0.66, width));
  EXPECT_NEAR(sheet.at("G") * degree / gf_per_cm, 0.66, 1e-9);
  EXPECT_NEAR(sheet.at("2HG") / gf_per_cm, 1.57, 1e-9);
  EXPECT_NEAR(sheet.at("2HG5") / gf_per_cm, 1.70, 1e-9);
  // One sign only, and only the way up.
  const auto half = of("shear angle [deg],force [gf/cm]\n0,0.8\n0.5,1.13\n5,4.15\n8,6.13\n5,2.45\n0.5,-0.44\n0,-0.8\n");
  EXPECT_NEAR(half.at("2HG") / gf_per_cm, 1.57, 1e-12);
  EXPECT_NEAR(half.at("2HG5") / gf_per_cm, 1.70, 1e-12);
  const auto up = of("angle [deg],force [gf/cm]\n0,0\n0.5,0.4\n5,3.1\n8,5\n");
  EXPECT_NEAR(up.at("G") * degree / gf_per_cm, 0.6, 1e-12);
  EXPECT_EQ(up.count("2HG"), 0u);
  EXPECT_NE(fault([&] {
              of("angle [deg],force [gf/cm]\n0,0\n2,1\n4,2\n");
            }).find("the test of shear goes to 4 degrees; G is the slope from 0.5 to 5"),
            std::string::npos);
}

TEST_F(RawTable, BendingIsReadWhereItIsAskedFor) {
  // B 0.05 gf cm2/cm and a loop that is 0.04 gf cm/cm wide at 0.5 /cm and 0.06 at 1.0 /cm: the place of 2HB is a
  // choice.
  const auto width = [](double k) { return 0.02 + 0.04 * k; };
  const std::string text = loop("curvature [1/cm],moment [gf cm/cm]", 2.5, 0.05, width);
  const auto file = write("bend.csv", text);
  const auto at = [&](double place) {
    return reduced(materials::read_test(file, {}), {.bending_hysteresis = place}).at("2HB") / 9.80665e-3;
  };
  EXPECT_NEAR(of(text).at("B") / 9.80665e-5, 0.05, 1e-10);
  EXPECT_NEAR(at(50.0), 0.04, 1e-10);
  EXPECT_NEAR(at(100.0), 0.06, 1e-10);
  EXPECT_NE(materials::formula_of("2HB", {.bending_hysteresis = 100.0}).find("at 1 /cm"), std::string::npos);
  // The moment of a specimen 20 cm wide.
  EXPECT_NEAR(
      of(loop("curvature [1/cm],moment [gf cm]", 2.5, 1.0, [](double) { return 0.4; }), {.width = 0.2}).at("B") /
          9.80665e-5,
      0.05, 1e-10);
}

TEST_F(RawTable, CompressionFrictionAndRoughness) {
  // The exponential of N85L15 (LC 0.51, WC 0.12 gf cm/cm2 to 50 gf/cm2): T0 (at 0.5 gf/cm2), Tm and WC
  // come back, LC goes with them; half the pressure on the way back is RC 50 %.
  const materials::Compression sheet{.LC = 0.51, .WC = 0.12 * gf_per_cm};
  std::ostringstream text;
  text.precision(14);
  text << "thickness [mm],pressure [gf/cm2]\n";
  const auto row = [&](double p, double factor) {
    text << 1e3 * *materials::thickness_under(98.0665 * p, sheet, 0.57e-3) << "," << factor * p << "\n";
  };
  for (int k = 0; k <= 2000; ++k) row(0.025 * k, 1.0);
  for (int k = 1999; k >= 0; --k) row(0.025 * k, 0.5);
  const auto pressed = of(text.str());
  EXPECT_NEAR(pressed.at("Tm"), 0.57e-3 - *sheet.decrease(), 1e-12);
  EXPECT_NEAR(pressed.at("T0"), *materials::thickness_under(0.5 * 98.0665, sheet, 0.57e-3), 1e-12) << "at 0.5 gf/cm2";
  EXPECT_NEAR(pressed.at("Pm"), 50 * 98.0665, 1e-9);
  EXPECT_NEAR(pressed.at("WC") / gf_per_cm, 0.12, 0.0005);
  EXPECT_NEAR(pressed.at("LC"), 2 * pressed.at("WC") / (pressed.at("Pm") * (pressed.at("T0") - pressed.at("Tm"))),
              1e-12);
  EXPECT_NEAR(pressed.at("RC"), 0.5, 0.002);
  EXPECT_NE(fault([&] {
              of("thickness [mm],pressure [gf/cm2]\n1,2\n0.9,20\n0.8,50\n");
            }).find("begins at 2 gf/cm2; T0 is the thickness at 0.5"),
            std::string::npos);
  // mu = 0.2 +- 0.05 as a triangle wave: MIU 0.2, MMD 0.025; heights 0, 8, 0 um: mean 4, SMD 2 um.
  const auto rubbed = of("distance [mm],friction\n0,0.2\n1,0.25\n3,0.15\n4,0.2\n");
  EXPECT_NEAR(rubbed.at("MIU"), 0.2, 1e-12);
  EXPECT_NEAR(rubbed.at("MMD"), 0.025, 1e-12);
  EXPECT_NEAR(of("distance [mm],height [um]\n0,0\n10,8\n20,0\n").at("SMD"), 2e-6, 1e-15);
}

TEST_F(RawTable, WhatIsNoTestIsRefusedWithWhatToWrite) {
  const auto error = [&](const std::string& text) { return fault([&] { of(text); }); };
  struct Wrong {
    std::string text, found;
  };
  for (const Wrong& wrong : std::vector<Wrong>{
           {"a,b\n1,2\n", "the columns a, b are those of no test that is known; name two of them strain [%] and force"},
           {"strain,force [N/m]\n0,0\n1,2\n2,4\n", "test.csv:1:1: error: strain has no unit; write strain [%]"},
           {"strain [%],force [N]\n0,0\n1,2\n2,4\n", "test.csv:1:12: error: force is a force here"},
           {"strain [%],force [kg]\n0,0\n1,2\n2,4\n", "[kg] of the column force is not a force"},
           {"strain [%],force [N/m]\n0,0\n1,x\n2,4\n", "test.csv:3:3: error: \"x\" in the column force is no number"},
           {"strain [%],force [N/m]\n0,0\n1,2\n", "the table has 2 rows; give the whole curve"},
           {"strain [%],force [N/m]\n0,0\n1,0\n2,0\n", "the force does not rise"},
           {"strain [%],force [N/m]\n0,0\n10,5\n1,1\n10,6\n0,0\n",
            "test.csv:4:1: error: the elongation turns back before the largest value; give one cycle"},
           {"strain [%],force [N/m],unloading [N/m]\n0,0,0\n5,1,4\n10,6,6\n", "holds 175 % of the work"},
           {"curvature [1/cm],moment [gf cm/cm]\n0,0\n0.5,1\n1,2\n", "the test of bending goes to 1 /cm"},
           {"distance [mm],friction\n0,0.2\n2,0.25\n1,0.15\n",
            "test.csv:4:1: error: the distance does not increase"}}) {
    EXPECT_NE(error(wrong.text).find(wrong.found), std::string::npos) << wrong.text << error(wrong.text);
  }
  EXPECT_NE(fault([&] { materials::read_test(folder_ / "none.csv", {}); }).find("none.csv"), std::string::npos);
}

TEST_F(RawTable, DamagedTablesAreRefusedOrGiveFiniteNumbers) {
  // 1,500 tables with lines left out, doubled or exchanged and cells replaced: an error with its file, or numbers.
  const std::vector<std::string> seeds = {
      "strain [%],force [N/m],unloading [N/m]\n0,0,0\n5,1,0.5\n10,6,4\n15,9,9\n",
      "strain [%],force [N/m]\n0,0\n10,6\n20,19\n12,3\n4,0\n",
      "angle [deg],force [gf/cm]\n0,0.8\n0.5,1.1\n5,4.1\n8,6.1\n5,2.4\n0.5,-0.4\n-8,-6\n0,-0.8\n",
      "curvature [1/cm],moment [gf cm/cm]\n0,0\n0.5,0.03\n1.5,0.08\n2.5,0.1\n0,-0.02\n",
      "thickness [mm],pressure [gf/cm2]\n1.2,0\n1,0.5\n0.9,20\n0.8,50\n0.9,9\n1,0\n",
      "distance [mm],friction\n0,0.2\n1,0.25\n3,0.15\n4,0.2\n"};
  const std::vector<std::string> cells = {"0", "-1", "1e300", "-1e300", "1e-300", "nan", "", "7"};
  unsigned state = 11;
  const auto any = [&](std::size_t below) { return (state = state * 1664525u + 1013904223u, (state >> 8) % below); };
  int read = 0;
  for (int round = 0; round < 1500; ++round) {
    std::istringstream in(seeds[any(seeds.size())]);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    for (std::size_t n = 1 + any(3); n > 0; --n) {
      std::string& line = lines[1 + any(lines.size() - 1)];
      const std::size_t comma = line.find(',');
      switch (any(4)) {
        case 0:
          line = lines[1 + any(lines.size() - 1)];
          break;
        case 1:
          std::swap(line, lines[1 + any(lines.size() - 1)]);
          break;
        case 2:
          line = cells[any(cells.size())] + (comma == line.npos ? "" : line.substr(comma));
          break;
        default:
          line = line.substr(0, comma) + "," + cells[any(cells.size())];
      }
    }
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    const std::string error = fault([&] {
      for (const auto& [symbol, value] : of(text)) EXPECT_TRUE(std::isfinite(value)) << symbol << "\n" << text;
      ++read;
    });
    if (!error.empty()) EXPECT_NE(error.find("test.csv"), std::string::npos) << error << "\n" << text;
  }
  EXPECT_GT(read, 150);
}

TEST(Specimens, MeanAndDeviation) {
  // 1, 2, 6: mean 3, standard deviation of the sample sqrt(7).
  const auto spread = materials::spread_of({1, 2, 6});
  EXPECT_NEAR(spread.mean, 3.0, 1e-15);
  EXPECT_NEAR(spread.deviation, std::sqrt(7.0), 1e-15);
  EXPECT_EQ(materials::spread_of({4.0}).deviation, 0.0);
}

}  // namespace
}  // namespace snug::testing
