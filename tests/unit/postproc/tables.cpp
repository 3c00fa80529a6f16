#include "postproc/tables.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "cases/input/csv.hpp"
#include "postproc/recorders.hpp"
#include "postproc/stress.hpp"
#include "tests/unit/postproc/scene.hpp"

namespace snug::postproc {
namespace {

using test::fresh_folder;
using test::run_scene;
using test::text_of;

input::ComfortSpec comfort_trial() {
  input::ComfortSpec spec;
  spec.curves.name = "wear trial 2002";
  return spec;
}

constexpr double five_digits = 5.1e-5;  // relative rounding of a listing

/// Rows of a listing read without relying on blanks: node number, then numbers in the forms that Ansys prints.
std::vector<std::vector<double>> rows_of(const std::string& text, std::size_t columns) {
  static const std::regex number(R"([+-]?(\d+\.\d*|\.\d+)([Ee][+-]?\d+)?)"), start(R"(^\s*(\d+)\s(.*)$)");
  std::vector<std::vector<double>> rows;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, start)) continue;
    const std::string values = found[2];
    std::vector<double> row = {std::stod(found[1])};
    for (std::sregex_iterator at(values.begin(), values.end(), number), end; at != end; ++at)
      row.push_back(std::stod(at->str()));
    if (row.size() == columns + 1) rows.push_back(row);
  }
  return rows;
}

TEST(Listing, NumbersLookLikeFortransG13) {
  // Fixed between 0.1 and 1e5, exponents outside, five digits, thirteen characters, also at the rounding edges.
  EXPECT_EQ(ansys_number(0.0), "   0.0000    ");
  EXPECT_EQ(ansys_number(12.345), "   12.345    ");
  EXPECT_EQ(ansys_number(-1.5), "  -1.5000    ");
  EXPECT_EQ(ansys_number(-99999.0), "  -99999.    ");
  EXPECT_EQ(ansys_number(0.1), "  0.10000    ");
  EXPECT_EQ(ansys_number(0.0999999), "  0.10000    ");
  EXPECT_EQ(ansys_number(0.099999), "  0.99999E-01");
  EXPECT_EQ(ansys_number(99999.96), "  0.10000E+06");
  EXPECT_EQ(ansys_number(-1.5152e-12), " -0.15152E-11");
  EXPECT_EQ(ansys_number(7.414e6), "  0.74140E+07");
  EXPECT_EQ(ansys_number(1e-120), "   0.0000    ");
  EXPECT_EQ(ansys_number(1e120), "*************");
  EXPECT_EQ(ansys_number(std::numeric_limits<double>::quiet_NaN()), "          NaN");
}

TEST(Listing, DisplacementsParseBackWithTheirExtrema) {
  // Every node's UX UY UZ USUM comes back to five digits; the extrema name node 45, 1 and 8.
  const BodyResult body = test::body_scene();
  std::ostringstream out;
  write_listing(out, displacement_listing(body));
  const auto rows = rows_of(out.str(), 4);
  ASSERT_EQ(rows.size(), body.nodes.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    EXPECT_EQ(rows[n][0], n + 1.0);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(rows[n][1 + c], body.fields[field::displacement][n][c], five_digits * std::abs(body.fields[field::displacement][n][c]));
    EXPECT_NEAR(rows[n][4], body.fields[field::displacement][n].norm(), five_digits * body.fields[field::displacement][n].norm());
  }
  EXPECT_NE(out.str().find("DEGREE OF FREEDOM LISTING"), std::string::npos);
  const std::regex tail(
      R"( MAXIMUM ABSOLUTE VALUES\n NODE +45 +45 +8 +8\n VALUE +0\.44000E-01 +-0\.88000E-03 +0\.25000 +0\.25010 *\n)");
  EXPECT_TRUE(std::regex_search(out.str(), tail)) << out.str();
  EXPECT_NE(out.str().find(" MINIMUM VALUES\n"), std::string::npos);
}

TEST(Listing, StressesParseBack) {
  // S1 S2 S3 SINT SEQV of every node come back to five digits.
  const BodyResult body = test::body_scene();
  std::ostringstream out;
  write_listing(out, stress_listing(body));
  const auto rows = rows_of(out.str(), 5);
  ASSERT_EQ(rows.size(), body.nodes.size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const Eigen::Vector3d s = principal_stresses(body.fields[field::cauchy_stress][n]);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rows[n][1 + c], s[c], five_digits * std::abs(s[c]));
    EXPECT_NEAR(rows[n][4], s[0] - s[2], five_digits * (s[0] - s[2]));
    EXPECT_NEAR(rows[n][5], von_mises(body.fields[field::cauchy_stress][n]), five_digits * von_mises(body.fields[field::cauchy_stress][n]));
  }
}

TEST(Listing, CoordinatesParseBack) {
  // nodes.lis gives each node's reference position to five digits.
  const BodyResult body = test::body_scene();
  std::ostringstream out;
  write_listing(out, node_listing(body));
  const auto rows = rows_of(out.str(), 3);
  ASSERT_EQ(rows.size(), body.nodes.size());
  for (std::size_t n = 0; n < rows.size(); ++n)
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rows[n][1 + c], body.nodes[n][c], 1e-6);
}

TEST(SkinTable, PressuresStandInPascalsAndInMillimetresOfMercury) {
  // The last column of every row is its column pressure [Pa] over 133.322 Pa.
  std::ostringstream out;
  write_skin(out, test::body_scene(), {});
  std::istringstream lines(out.str());
  std::string line;
  std::getline(lines, line);
  const auto cells = [](const std::string& text) {
    std::vector<std::string> result;
    std::istringstream row(text);
    for (std::string cell; std::getline(row, cell, ',');) result.push_back(cell);
    return result;
  };
  const std::vector<std::string> head = cells(line);
  ASSERT_EQ(head.back(), "pressure_mmHg") << line;
  const auto pascals = std::find(head.begin(), head.end(), "pressure [Pa]") - head.begin();
  int rows = 0;
  for (; std::getline(lines, line); ++rows) {
    const std::vector<std::string> row = cells(line);
    ASSERT_EQ(row.size(), head.size()) << line;
    EXPECT_NEAR(std::stod(row.back()), std::stod(row.at(static_cast<std::size_t>(pascals))) / 133.322387415, 1e-4) << line;
  }
  EXPECT_GT(rows, 3);
}

TEST(Stress, InvariantsOfKnownStates) {
  // Uniaxial 5: von Mises 5. Pure shear 2: principal 2, 0, -2 and von Mises 2 sqrt 3. Pressure alone: von Mises 0.
  EXPECT_NEAR(von_mises((Stress() << 5, 0, 0, 0, 0, 0).finished()), 5, 1e-14);
  for (int shear = 3; shear < 6; ++shear) {
    const Stress stress = 2 * Stress::Unit(shear);
    EXPECT_NEAR(von_mises(stress), 2 * std::sqrt(3.0), 1e-14);
    EXPECT_NEAR((principal_stresses(stress) - Eigen::Vector3d(2, 0, -2)).norm(), 0, 1e-14);
  }
  EXPECT_NEAR(von_mises((Stress() << -7, -7, -7, 0, 0, 0).finished()), 0, 1e-14);
}

TEST(Evaluate, MeanIsWeightedByCoveredArea) {
  // A location half covered at 100 Pa and half at 300 Pa has the mean of its areas; without cover it has no rating.
  RunResult run = run_scene();
  for (std::size_t n = 30; n < 45; ++n) run.body.fields[field::contact_pressure][n] = n < 35 ? 100 : 300;  // rows j = 0, 1, 2
  run.body.fields[field::displacement].assign(45, Eigen::Vector3d::Zero());
  const Evaluation evaluation = evaluate(run, comfort_trial());
  const LocationRow& front = evaluation.locations[0];
  // Rows j = 0 and 2 have a quarter of the height each, row 1 half of it.
  EXPECT_NEAR(front.mean_pressure, 0.25 * 100 + 0.75 * 300, 1e-6);
  EXPECT_DOUBLE_EQ(front.max_pressure, 300);
  EXPECT_DOUBLE_EQ(front.coverage, 1.0);
  EXPECT_TRUE(front.rating.has_value());
  const LocationRow& side = evaluation.locations[1];
  EXPECT_EQ(side.coverage, 0.0);
  EXPECT_EQ(side.mean_pressure, 0.0);
  EXPECT_FALSE(side.rating.has_value());
  // Both patches together are the outer surface: 0.8 rad at radius 0.06 m, 0.04 m high.
  EXPECT_NEAR(front.area + side.area, 0.8 * 0.06 * 0.04, 1e-7);
  ASSERT_TRUE(evaluation.comfort.has_value());
  EXPECT_EQ(evaluation.comfort->memberships.size(), 1u);
}

TEST(Evaluate, MeanIsWeightedByTheCoveredPartOfEachArea) {
  // Nodes that are covered in part weigh by that part: row j = 0 at 100 Pa by 0.4 of a quarter, row 1 at 300 Pa by 0.9 of a half, row
  // 2 at 200 Pa whole.
  RunResult run = run_scene();
  run.body.fields[field::displacement].assign(45, Eigen::Vector3d::Zero());
  for (std::size_t n = 30; n < 45; ++n) {
    run.body.fields[field::contact_pressure][n] = n < 35 ? 100 : n < 40 ? 300 : 200;
    run.body.fields[field::coverage][n] = n < 35 ? 0.4 : n < 40 ? 0.9 : 1.0;
  }
  const LocationRow front = evaluate(run, std::nullopt).locations[0];
  EXPECT_NEAR(front.coverage, 0.1 + 0.45 + 0.25, 1e-9);
  EXPECT_NEAR(front.mean_pressure, (0.1 * 100 + 0.45 * 300 + 0.25 * 200) / 0.8, 1e-6);
}

TEST(Evaluate, WithoutAComfortSectionNothingIsRated) {
  // Pressures are still given by location.
  const Evaluation evaluation = evaluate(run_scene(), std::nullopt);
  EXPECT_EQ(evaluation.locations.size(), 2u);
  EXPECT_FALSE(evaluation.locations[0].rating.has_value());
  EXPECT_FALSE(evaluation.comfort.has_value());
}

TEST(Evaluate, AStateShortOfTheAnswerIsNotJudged) {
  // Its pressures are told; rating, class, threshold and comfort are not made of them, with the same data that rate an answer.
  RunResult run = run_scene();
  ASSERT_TRUE(evaluate(run, comfort_trial()).comfort.has_value());
  run.status = postproc::Status::partial;
  const Evaluation evaluation = evaluate(run, comfort_trial());
  EXPECT_NEAR(evaluation.locations[0].mean_pressure, 300.0, 1e-9);
  EXPECT_FALSE(evaluation.comfort.has_value());
  EXPECT_TRUE(evaluation.thresholds.empty());
  for (const LocationRow& row : evaluation.locations) EXPECT_FALSE(row.rating.has_value());
}

TEST(Recorders, SummaryTellsWhatTheStateIsAndWarns) {
  // Stage, fraction, stiffening of a partial state, what to try, assumptions, hems and every warning with its measure.
  const auto out = fresh_folder("truth");
  RunResult run = run_scene();
  run.status = postproc::Status::partial;
  run.truth = {.stage = "body, step by step", .fraction = 0.25, .stiffening = 12.0, .friction_bound = 8.0};
  run.remedies = {"give contact.friction"};
  run.assumptions = {"friction 0.3: textiles on dry skin"};
  run.hems = {{.edge = "upper", .length = 0.5, .strip = 0.02, .force = 3.0, .line_load = 0.4}};
  run.warnings = {{"gathered cloth", "20 % of the cloth lies in folds", "heights 10 to 20 mm", "hold both edges", "gathered_share", 0.2, 0.05}};
  write_results(run, evaluate(run, comfort_trial()), out);
  const auto json = nlohmann::json::parse(text_of(out / "summary.json"));
  EXPECT_EQ(json["state"]["stage"], "body, step by step");
  EXPECT_EQ(json["state"]["fraction"], 0.25);
  EXPECT_EQ(json["state"]["body_stiffening"], 12.0);
  EXPECT_EQ(json["state"]["friction_bound"], 8.0);
  EXPECT_EQ(json["state"]["text"],
            "at 25.0 % of the stage \"body, step by step\", the body 12 times as stiff as it is, friction bound to 8 times its coefficient");
  EXPECT_EQ(json["what_to_try"][0], "give contact.friction");
  EXPECT_EQ(json["assumptions"][0], "friction 0.3: textiles on dry skin");
  EXPECT_EQ(json["hems"][0]["line_load_N_per_m"], 0.4);
  EXPECT_EQ(json["warnings"][0]["quantity"], "gathered_share");
  EXPECT_EQ(json["warnings"][0]["value"], 0.2);
  EXPECT_EQ(json["warnings"][0]["remedy"], "hold both edges");
  EXPECT_TRUE(json["comfort"].is_null());
}

TEST(Recorders, AFullSceneLeavesEveryFileAndNothingHalfWritten) {
  // Each recorder's file is there and no file written aside remains.
  const auto out = fresh_folder("full");
  RunResult run = run_scene();
  run.tools = {{.name = "probe", .surface = "skin", .shape = "ball of radius 5 mm", .history = {{.travel = 2e-3, .depth = 1e-3, .force = 0.5}, {.travel = 4e-3, .depth = 3e-3, .force = 2.5}}}};
  run.movement = {{.posture = "dressed", .bones = {{"shank", 0.0, {}}}, .contact_area = 0.02, .mean_pressure = 900.0, .max_pressure = 1200.0}};
  write_results(run, evaluate(run, comfort_trial()), out,
                {.versions = {{"snug", "0.1.0"}}, .input_hashes = {}, .mesh_quality = {}});
  for (const Recorder& recorder : recorders())
    EXPECT_TRUE(std::filesystem::exists(out / recorder.file)) << recorder.file;
  for (const auto& file : std::filesystem::directory_iterator(out)) EXPECT_NE(file.path().extension(), ".part");
  EXPECT_NE(text_of(out / "body.pvd").find("file=\"body_0000.vtu\""), std::string::npos);
  EXPECT_NE(text_of(out / "tool.csv").find("\nprobe,0.004,0.003,2.5,0,0,0,0\n"), std::string::npos) << text_of(out / "tool.csv");
  const auto tool = nlohmann::json::parse(text_of(out / "summary.json"))["tools"][0];
  EXPECT_NEAR(tool["stiffness_N_per_m"].get<double>(), 2.5 / 3e-3, 1e-9);      // force over depth
  EXPECT_NEAR(tool["slope_N_per_m"].get<double>(), (2.5 - 0.5) / 2e-3, 1e-9);  // of the last step
}

TEST(Recorders, WhatTheSceneDoesNotHaveLeavesNoFileOfAnEarlierRun) {
  // Without garment and comfort section their files are absent, also when an earlier run wrote them there.
  const auto out = fresh_folder("less");
  RunResult run = run_scene();
  write_results(run, evaluate(run, comfort_trial()), out);
  run.garment = {};
  write_results(run, evaluate(run, std::nullopt), out);
  for (const char* file : {"garment.pvd", "garment_0000.vtu", "comfort.json"})
    EXPECT_FALSE(std::filesystem::exists(out / file)) << file;
  EXPECT_TRUE(std::filesystem::exists(out / "summary.json"));
}

TEST(Recorders, SummaryIsJsonWithoutNaN) {
  // A value that was not computed is null; status, unknowns, numbers and versions come back.
  const auto out = fresh_folder("summary");
  RunResult run = run_scene();
  run.max_penetration = std::numeric_limits<double>::quiet_NaN();
  run.numbers["not_computed"] = std::numeric_limits<double>::infinity();
  write_results(run, evaluate(run, comfort_trial()), out,
                {.versions = {{"snug", "0.1.0"}}, .input_hashes = {}, .mesh_quality = {}});
  const auto json = nlohmann::json::parse(text_of(out / "summary.json"));
  EXPECT_EQ(json["status"], "converged");
  EXPECT_TRUE(json["max_penetration_m"].is_null());
  EXPECT_TRUE(json["numbers"]["not_computed"].is_null());
  EXPECT_EQ(json["numbers"]["mean_contact_pressure_Pa"], 300.0);
  EXPECT_EQ(json["unknowns"]["total"], 162);
  EXPECT_EQ(json["versions"]["snug"], "0.1.0");
  EXPECT_EQ(json["residuals"]["residual"], 3e-8);
  EXPECT_EQ(json["plan"]["out"].size(), 1u);
  EXPECT_EQ(json["locations"].size(), 2u);
  EXPECT_TRUE(json["locations"][1]["rating"].is_null());
  EXPECT_TRUE(json["mesh_quality"].is_object());
}

TEST(Recorders, ComfortNamesMembershipsRulesScoreAndTerm) {
  // comfort.json carries what the fuzzy system did, as score --json does.
  const auto out = fresh_folder("comfort");
  const RunResult run = run_scene();
  const Evaluation evaluation = evaluate(run, comfort_trial());
  write_results(run, evaluation, out);
  const auto json = nlohmann::json::parse(text_of(out / "comfort.json"));
  EXPECT_DOUBLE_EQ(json["score"], evaluation.comfort->score);
  EXPECT_EQ(json["term"], evaluation.comfort->term);
  EXPECT_EQ(json["rules"].size(), 3u);
  EXPECT_TRUE(json["memberships"][0]["degrees"].contains("very uncomfortable"));
  const auto printed = nlohmann::json::parse(evaluation_json(evaluation));
  EXPECT_EQ(printed["locations"][0]["location"], "Front thigh");
  EXPECT_EQ(printed["comfort"]["score"], json["score"]);
}

TEST(Recorders, CsvTablesReadBackInEveryUnit) {
  // locations.csv repeats one pressure in Pa, gf/cm2 and mmHg; history.csv has one row an iteration.
  const auto out = fresh_folder("csv");
  const RunResult run = run_scene();
  write_results(run, evaluate(run, comfort_trial()), out);
  input::Diagnostics diagnostics;
  const auto locations = input::read_csv(out / "locations.csv", diagnostics);
  const double pascal = input::numbers(locations, "mean_pressure_Pa", "", diagnostics).at(0);
  EXPECT_NEAR(pascal, 300, 1e-3);
  EXPECT_NEAR(input::numbers(locations, "mean_pressure_gf_per_cm2", "", diagnostics).at(0), 300 / 98.0665, 1e-5);
  EXPECT_NEAR(input::numbers(locations, "mean_pressure_mmHg", "", diagnostics).at(0), 300 / 133.322387415, 1e-5);
  const auto history = input::read_csv(out / "history.csv", diagnostics);
  EXPECT_EQ(history.rows.size(), 2u);
  EXPECT_EQ(input::texts(history, "event", diagnostics).at(0), "refactored, again");
  EXPECT_FALSE(diagnostics.any());
}

}  // namespace
}  // namespace snug::postproc
