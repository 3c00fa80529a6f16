#include "postproc/comfort/sensation.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/pressure_table.hpp"
#include "postproc/comfort/shipped_data.hpp"
#include "postproc/evaluate.hpp"
#include "postproc/units.hpp"

namespace snug::postproc {
namespace {

SensationCurves trial_curves() {
  input::ComfortSpec spec;
  spec.curves.name = "wear trial 2002";
  return load_curves(spec.curves);
}

std::filesystem::path trial_file(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("snug-sensation-" + name);
  std::ofstream(path) << text;
  return path;
}

TEST(Units, ConversionsAreThoseOfTheStandards) {
  // 1 gf/cm2 = 98.0665 Pa and 1 mmHg = 133.322387415 Pa, both ways.
  EXPECT_DOUBLE_EQ(from_gf_cm2(1.0), 98.0665);
  EXPECT_DOUBLE_EQ(from_mmHg(1.0), 133.322387415);
  EXPECT_DOUBLE_EQ(to_gf_cm2(from_gf_cm2(17.3)), 17.3);
  EXPECT_DOUBLE_EQ(to_mmHg(from_mmHg(17.3)), 17.3);
}

TEST(Sensation, ReproducesAll64RatingsOfTheEightSignificantLocations) {
  // Table 5.5: each rating of the eight locations with a significant slope comes back within 0.005, its rounding.
  const SensationCurves curves = trial_curves();
  const input::Csv table = shipped_csv(shipped_text("wear_trial_2002.csv"), "table");
  ASSERT_EQ(table.rows.size(), 72u);
  int checked = 0;
  for (const auto& row : table.rows) {
    const SensationCurve* curve = curves.find(row.cells[1]);
    ASSERT_NE(curve, nullptr) << row.cells[1];
    const Rating rating = rate(*curve, from_gf_cm2(std::stod(row.cells[2])));
    EXPECT_FALSE(rating.extrapolated);
    if (!rating.significant) continue;
    EXPECT_NEAR(rating.value, std::stod(row.cells[3]), 0.005) << row.cells[1] << ", garment " << row.cells[0];
    ++checked;
  }
  EXPECT_EQ(checked, 64);
}

TEST(Sensation, OnlyTheBackThighHasNoSignificantSlope) {
  // The t-test rejects the line of the back thigh and of no other location.
  for (const SensationCurve& curve : trial_curves().curves) {
    EXPECT_EQ(curve.significant, curve.location != "Back thigh") << curve.location << " p = " << curve.p_value;
    EXPECT_EQ(curve.points, 8);
  }
  EXPECT_GT(trial_curves().find("Back thigh")->p_value, 0.2);
  EXPECT_LT(trial_curves().find("Chest")->p_value, 1e-6);
}

TEST(Sensation, LinesAndResidualsAreTheOnesOfTheLeastSquaresFit) {
  // Slope, intercept and largest residual agree with an independent fit of the same table (data/README.md).
  const SensationCurves curves = trial_curves();
  const SensationCurve& chest = *curves.find("chest");
  EXPECT_NEAR(std::get<Line>(chest.shape).slope * pascal_per_gf_cm2, 0.31971, 5e-6);
  EXPECT_NEAR(std::get<Line>(chest.shape).intercept, 0.0233, 5e-5);
  EXPECT_NEAR(chest.largest_residual, 0.0038, 5e-5);
  const SensationCurve& thigh = *curves.find("Back thigh");
  EXPECT_NEAR(std::get<Line>(thigh.shape).slope * pascal_per_gf_cm2, -0.01994, 5e-6);
  EXPECT_NEAR(std::get<Line>(thigh.shape).intercept, 1.1171, 5e-5);
  EXPECT_NEAR(thigh.largest_residual, 0.1734, 5e-5);
  EXPECT_NEAR(to_gf_cm2(thigh.low), 1.11, 1e-12);
  EXPECT_NEAR(to_gf_cm2(thigh.high), 6.04, 1e-12);
}

TEST(Sensation, PressuresOutsideTheTrialAreFlaggedAndRatingsStayOnTheScale) {
  // Far beyond the data the rating is clamped to 4 and marked; without a significant slope it is the trial's mean.
  const SensationCurves curves = trial_curves();
  const Rating far = rate(*curves.find("Chest"), from_gf_cm2(40));
  EXPECT_DOUBLE_EQ(far.value, 4.0);
  EXPECT_EQ(far.term, "extremely uncomfortable");
  EXPECT_TRUE(far.extrapolated);
  const Rating flat = rate(*curves.find("Back thigh"), from_gf_cm2(40));
  EXPECT_NEAR(flat.value, 1.05, 1e-12);
  EXPECT_FALSE(flat.significant);
  EXPECT_TRUE(flat.extrapolated);
}

TEST(Sensation, CurvesOfAFileMayComeInAnyUnit) {
  // The same line given in Pa, gf/cm2 and mmHg gives the same rating.
  const auto in_pascal =
      trial_file("pa.csv", "location,pressure_Pa,sensation_rating\ncalf,0,0\ncalf,1000,1\ncalf,2000,2\n");
  const auto in_head = trial_file("head.csv", "location,pressure [kPa],sensation_rating\ncalf,0,0\ncalf,1,1\ncalf,2,2\n");
  for (const auto& file : {in_pascal, in_head}) {
    input::ComfortSpec spec;
    spec.curves.name = file.filename().string();
    const SensationCurves curves = load_curves(spec.curves, file.parent_path());
    EXPECT_NEAR(rate(*curves.find("Calf"), 1500).value, 1.5, 1e-12);
  }
}

TEST(Sensation, WrongTablesAreErrorsWithFileAndRemedy) {
  // A rating off the scale, too few points, a missing column and an unknown name are all input errors.
  const auto load = [](const std::string& name) {
    input::ComfortSpec spec;
    spec.curves.name = name;
    return load_curves(spec.curves);
  };
  EXPECT_THROW(load(trial_file("a.csv", "location,pressure_Pa,sensation_rating\ncalf,0,0\ncalf,1,7\ncalf,2,1\n").string()),
               input::InputError);
  EXPECT_THROW(load(trial_file("b.csv", "location,pressure_Pa,sensation_rating\ncalf,0,0\ncalf,1,1\n").string()),
               input::InputError);
  EXPECT_THROW(load(trial_file("c.csv", "location,sensation_rating\ncalf,0\n").string()), input::InputError);
  EXPECT_THROW(load(trial_file("d.csv", "location,pressure_Pa,sensation_rating\ncalf,nan,0\n").string()),
               input::InputError);
  EXPECT_THROW(load("wear trial 1999"), input::InputError);
}

TEST(Sensation, TheErrorOfARatingIsThatOfOneMorePerson) {
  // Scatter times sqrt(1 + 1/n + (p - mean)^2 / sum of squares): that person's own scatter is in it beside that of the line.
  SensationCurve curve;
  curve.shape = Line{0.5, 1e-3};
  curve.scatter = 0.4, curve.points = 10, curve.mean_pressure = 1000.0, curve.pressure_squares = 4e6;
  curve.low = 0.0, curve.high = 3000.0;
  EXPECT_NEAR(rate(curve, 2000.0).error, 0.4 * std::sqrt(1.0 + 0.1 + 0.25), 1e-12);
  EXPECT_EQ(rate(curve, 2000.0).degrees, 8);
}

TEST(Bands, HoldTheirEnds) {
  // A pressure at either end of a band is in it; beside it, it is between the bands.
  SensationCurves data;
  data.bands = {{"", "one", 10.0, 20.0}, {"", "two", 30.0, 40.0}};
  for (const double inside : {10.0, 20.0}) EXPECT_EQ(verdict(data, "Calf", inside), "one");
  for (const double inside : {30.0, 40.0}) EXPECT_EQ(verdict(data, "Calf", inside), "two");
  EXPECT_EQ(verdict(data, "Calf", 9.9), "below one");
  EXPECT_EQ(verdict(data, "Calf", 20.1), "between one and two");
  EXPECT_EQ(verdict(data, "Calf", 40.1), "above two");
}

TEST(Score, ReadsPressuresInThreeUnitsAndRefusesALocationTwice) {
  // 1 gf/cm2 read in any of the three columns is 98.0665 Pa; a doubled location is an error.
  EXPECT_DOUBLE_EQ(read_pressures(trial_file("e.csv", "location,pressure_gf_per_cm2\nChest,1\n"))[0].pressure, 98.0665);
  EXPECT_DOUBLE_EQ(read_pressures(trial_file("f.csv", "location,pressure_mmHg\nChest,1\n"))[0].pressure, 133.322387415);
  EXPECT_DOUBLE_EQ(read_pressures(trial_file("g.csv", "\"location\",pressure_Pa\n\"Chest\",1\n"))[0].pressure, 1.0);
  EXPECT_THROW(read_pressures(trial_file("h.csv", "location,pressure_Pa\nChest,1\nchest,2\n")), input::InputError);
  EXPECT_THROW(read_pressures(trial_file("i.csv", "location,pressure_Pa\nChest,-1\n")), input::InputError);
}

TEST(Score, RatesMeasuredPressuresWithoutMechanics) {
  // Garment 1 of table 5.5: nine ratings and one comfort over all; a table without a known location is an error.
  const auto file = std::filesystem::path(SNUG_SOURCE_DIR) / "postproc/data/wear_trial_2002.csv";
  input::Diagnostics diagnostics;
  const input::Csv table = input::read_csv(file, diagnostics);
  input::ComfortSpec spec;
  spec.curves.name = "wear trial 2002";
  std::vector<LocationPressure> garment;
  for (int row = 0; row < 9; ++row)
    garment.push_back({table.rows[row].cells[1], from_gf_cm2(std::stod(table.rows[row].cells[2]))});
  const Evaluation evaluation = score(garment, spec);
  ASSERT_EQ(evaluation.locations.size(), 9u);
  EXPECT_NEAR(*evaluation.locations[0].rating, 0.66, 0.005);
  EXPECT_EQ(evaluation.locations[0].term, "comfortable");
  EXPECT_FALSE(evaluation.locations[8].significant);
  EXPECT_EQ(evaluation.comfort->memberships.size(), 9u);
  EXPECT_THROW(score({{"left ear", 100.0}}, spec), input::InputError);
}

TEST(Sensation, ASideIsJudgedByTheCurveOfItsPlace) {
  // "Front thigh left" has no curve of its own and is rated as "Front thigh"; what only looks like a side is none.
  const SensationCurves curves = trial_curves();
  EXPECT_EQ(without_side("Front thigh left"), "Front thigh");
  EXPECT_EQ(without_side("Front thigh RIGHT"), "Front thigh");
  EXPECT_EQ(without_side("Upright"), "Upright");
  EXPECT_EQ(without_side(" left"), " left");
  ASSERT_NE(curves.find("front thigh left"), nullptr);
  EXPECT_EQ(curves.find("front thigh left"), curves.find("Front thigh"));
  EXPECT_EQ(curves.find("Left"), nullptr);
  SensationCurves own = curves;
  own.curves.push_back(*curves.find("Chest"));
  own.curves.back().location = "Front thigh left";
  EXPECT_EQ(own.find("Front thigh left"), &own.curves.back()) << "a curve of its own goes first";
  SensationCurves bands;
  bands.bands = {{"Front thigh", "much", 1000.0, 2000.0}};
  EXPECT_EQ(verdict(bands, "Front thigh right", 1500.0), "much");
  EXPECT_EQ(verdict(bands, "Back thigh right", 1500.0), "");
}

TEST(Sensation, OfBothSidesTheWorseOneCounts) {
  // Both sides are one question of the trial: the score is that of the worse side alone, whichever comes first.
  input::ComfortSpec comfort;
  comfort.curves.name = "wear trial 2002";
  const SensationCurves curves = trial_curves();
  const SensationCurve& thigh = *curves.find("Front thigh");
  const double low = thigh.low + 0.2 * (thigh.high - thigh.low), high = thigh.low + 0.9 * (thigh.high - thigh.low);
  ASSERT_GT(rate(thigh, high).value, rate(thigh, low).value + 0.1);
  const auto score_of = [&](const std::vector<LocationPressure>& pressures) { return score(pressures, comfort).comfort->score; };
  const double worse = score_of({{"Front thigh", high}});
  EXPECT_NE(worse, score_of({{"Front thigh", low}}));
  EXPECT_DOUBLE_EQ(score_of({{"Front thigh left", low}, {"Front thigh right", high}}), worse);
  EXPECT_DOUBLE_EQ(score_of({{"Front thigh left", high}, {"Front thigh right", low}}), worse);
  EXPECT_EQ(score({{"Front thigh left", low}, {"Front thigh right", high}}, comfort).comfort->memberships.size(), 1u);
}

}  // namespace
}  // namespace snug::postproc
