#include "postproc/comfort/curve_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/membership_fit.hpp"

namespace snug::postproc {
namespace {

std::filesystem::path written(const std::string& name, const std::string& text) {
  const auto path = std::filesystem::temp_directory_path() / ("snug-fit-" + name);
  std::ofstream(path) << text;
  return path;
}

SensationCurves found(const std::filesystem::path& file) {
  input::MaterialEntry reference;
  reference.name = file.filename().string();
  return find_curves(reference, file.parent_path());
}

Observations observed(const std::vector<double>& pressure, const CurveShape& shape, double noise = 0.0) {
  std::mt19937 random(7);
  std::normal_distribution<double> error(0.0, 1.0);
  Observations seen{"calf", pressure, {}, {}};
  for (const double p : pressure) seen.rating.push_back(value_at(shape, p) + noise * error(random));
  return seen;
}

std::vector<double> steps(double from, double to, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(from + (to - from) * i / (count - 1));
  return values;
}

TEST(CurveFit, StatisticsAreTheOnesOfNistNorris) {
  // NIST StRD "Norris", certified: 36 points, slope 1.00211681802045, intercept -0.262323073774029, their standard
  // errors 0.000429796848199937 and 0.232818234301152, residual standard deviation 0.884796396144373,
  // R2 0.999993745883712. The ratings of the test are these, scaled into [0, 4] (all statistics scale with them).
  const std::vector<double> y = {0.1, 338.8, 118.1, 888.0, 9.2,   228.1, 668.5, 998.5, 449.1, 778.9, 559.2, 0.3,
                                 0.1, 778.1, 668.8, 339.3, 448.9, 10.8,  557.7, 228.3, 998.0, 888.8, 119.6, 0.3,
                                 0.6, 557.6, 339.3, 888.0, 998.5, 778.9, 10.2,  117.6, 228.9, 668.4, 449.2, 0.2};
  const std::vector<double> x = {0.2, 337.4, 118.2, 884.6, 10.1,  226.5, 666.3, 996.3, 448.6, 777.0, 558.2, 0.4,
                                 0.6, 775.5, 666.9, 338.0, 447.5, 11.6,  556.0, 228.1, 995.8, 887.6, 120.2, 0.3,
                                 0.3, 556.8, 339.1, 887.2, 999.0, 779.0, 11.1,  118.3, 229.2, 669.1, 448.9, 0.5};
  Observations seen{"calf", x, {}, {}};
  const double scale = 1.0 / 256;
  for (const double value : y) seen.rating.push_back(value * scale);
  const SensationCurve curve = fit_curve(seen, "linear", "Norris");
  const Line line = std::get<Line>(curve.shape);
  EXPECT_NEAR(line.slope / scale, 1.00211681802045, 1e-12);
  EXPECT_NEAR(line.intercept / scale, -0.262323073774029, 1e-10);
  EXPECT_NEAR(curve.slope_error / scale, 0.000429796848199937, 1e-14);
  EXPECT_NEAR(curve.intercept_error / scale, 0.232818234301152, 1e-11);
  EXPECT_NEAR(curve.scatter / scale, 0.884796396144373, 1e-11);
  EXPECT_NEAR(curve.r_squared, 0.999993745883712, 1e-13);
  EXPECT_EQ(curve.points, 36);
}

TEST(CurveFit, KnownCurvesAreRecovered) {
  // Ratings taken from a curve of each shape give its numbers back.
  const SensationCurve hinge =
      fit_curve(observed(steps(100, 2000, 20), Polyline{{100, 730, 2000}, {0.4, 0.4, 2.9}}), "piecewise", "test");
  EXPECT_NEAR(std::get<Polyline>(hinge.shape).pressures[1], 730.0, 1e-3);
  EXPECT_NEAR(std::get<Polyline>(hinge.shape).ratings[0], 0.4, 1e-6);
  EXPECT_NEAR(std::get<Polyline>(hinge.shape).ratings[2], 2.9, 1e-6);
  const SensationCurve smooth =
      fit_curve(observed(steps(0, 5000, 15), Logistic{.middle = 2900, .width = 640}), "logistic", "test");
  EXPECT_NEAR(std::get<Logistic>(smooth.shape).middle, 2900.0, 1e-3);
  EXPECT_NEAR(std::get<Logistic>(smooth.shape).width, 640.0, 1e-3);
  EXPECT_TRUE(hinge.significant);
  EXPECT_TRUE(smooth.significant);
}

TEST(CurveFit, ScatterIsFoundAgain) {
  // From 400 ratings with a standard deviation of 0.2 about a line: the scatter within 10 % and the slope within four
  // of its own standard errors; ratings that pressure does not touch are called not significant.
  const SensationCurve curve = fit_curve(observed(steps(200, 2200, 400), Line{0.8, 8e-4}, 0.2), "linear", "test");
  EXPECT_NEAR(curve.scatter, 0.2, 0.02);
  EXPECT_NEAR(std::get<Line>(curve.shape).slope, 8e-4, 4 * curve.slope_error);
  EXPECT_LT(curve.p_value, 1e-9);
  const SensationCurve flat = fit_curve(observed(steps(200, 2200, 12), Line{2.0, 0.0}, 0.2), "linear", "test");
  EXPECT_FALSE(flat.significant);
}

TEST(CurveFit, AWrittenFileReadsBackToTheSameCurves) {
  // Curves of all shapes with their statistics, bands and texts survive the TOML file to the last bit.
  SensationCurves set;
  set.name = "my trial";
  set.source = "a \"quoted\" source, with a backslash \\";
  set.patch = "2 cm2";
  set.population = "12 women";
  set.notes = {"one", "two"};
  set.curves = {fit_curve(observed(steps(100, 2000, 9), Line{0.3, 1e-3}, 0.1), "linear", ""),
                fit_curve(observed(steps(100, 2000, 9), Line{0.3, 1e-3}, 0.1), "piecewise", ""),
                fit_curve(observed(steps(100, 2000, 9), Line{0.3, 1e-3}, 0.1), "logistic", "")};
  set.curves[1].location = "thigh";
  set.curves[2].location = "waist";
  set.bands = {{"", "anywhere", 3.0, 7.0}, {"calf", "open", 1.0, INFINITY}};
  const SensationCurves read = found(written("all.toml", curves_toml(set)));
  EXPECT_EQ(read.source, set.source);
  EXPECT_EQ(read.notes, set.notes);
  ASSERT_EQ(read.curves.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const SensationCurve &a = set.curves[i], &b = read.curves[i];
    EXPECT_EQ(shape_name(a.shape), shape_name(b.shape));
    for (const double p : {0.0, 333.3, 1500.0, 4000.0}) {
      EXPECT_DOUBLE_EQ(rate(a, p).value, rate(b, p).value);
      EXPECT_NEAR(rate(a, p).error, rate(b, p).error, 1e-14);
      EXPECT_EQ(rate(a, p).degrees, rate(b, p).degrees);
      EXPECT_EQ(rate(a, p).extrapolated, rate(b, p).extrapolated);
    }
    EXPECT_DOUBLE_EQ(a.p_value, b.p_value);
  }
  ASSERT_EQ(read.bands.size(), 2u);
  EXPECT_TRUE(std::isinf(read.bands[0].high));
}

TEST(CurveFit, WrongFilesAreErrors) {
  // Missing numbers of a shape, corners that do not grow, a second curve of one place, overlapping bands, no content.
  const std::string head = "name = \"a\"\nsource = \"b\"\npatch = \"c\"\npopulation = \"d\"\n";
  const std::string line =
      "[[curves]]\nlocation = \"calf\"\nintercept = 0.1\nslope = \"0.1 cm2/gf\"\n"
      "range = [\"1 kPa\", \"2 kPa\"]\n";
  EXPECT_NO_THROW(found(written("good.toml", head + line)));
  for (const std::string& wrong :
       {head, head + line + line, head + "[[curves]]\nlocation = \"calf\"\nrange = [\"1 kPa\", \"2 kPa\"]\n",
        head + "[[curves]]\nlocation = \"calf\"\nshape = \"piecewise\"\nrange = [\"1 kPa\", \"2 kPa\"]\n"
               "pressures = [\"2 kPa\", \"1 kPa\"]\nratings = [1, 2]\n",
        head + "[[curves]]\nlocation = \"calf\"\nshape = \"logistic\"\nrange = [\"1 kPa\", \"2 kPa\"]\nmiddle = 3\n",
        head + "[[bands]]\nname = \"x\"\nfrom = \"1 kPa\"\nto = \"3 kPa\"\n[[bands]]\nname = \"y\"\nfrom = \"2 kPa\"\n",
        std::string("name = \"a\"\n") + line})
    EXPECT_THROW(found(written("wrong.toml", wrong)), input::InputError) << wrong;
}

TEST(Bands, RangesOfPressureAloneNeedNoPatchAndNobodyAsked) {
  // Ranges with name and source are read, and say that nothing is stated; a curve without patch or population is refused by the key it lacks.
  const std::string name = "name = \"a\"\nsource = \"b\"\n", band = "[[bands]]\nname = \"class 1\"\nfrom = \"1 kPa\"\nto = \"3 kPa\"\n";
  const SensationCurves ranges = found(written("ranges.toml", name + band));
  ASSERT_EQ(ranges.bands.size(), 1u);
  EXPECT_EQ(ranges.patch, "not stated");
  const std::string line = "[[curves]]\nlocation = \"calf\"\nintercept = 0.1\nslope = \"0.1 cm2/gf\"\nrange = [\"1 kPa\", \"2 kPa\"]\n";
  try {
    found(written("curve.toml", name + "patch = \"5 cm2\"\n" + line + band));
    FAIL() << "a curve of nobody";
  } catch (const input::InputError& wrong) {
    EXPECT_NE(std::string(wrong.what()).find("curves without population"), std::string::npos) << wrong.what();
  }
}

TEST(Bands, PressuresGetTheirNames) {
  // Inside, below, between and above the classes of a location; other locations are not spoken of.
  input::MaterialEntry reference;
  reference.name = "RAL-GZ 387";
  const SensationCurves classes = load_bands(reference);
  const auto at = [&](double mmHg) { return verdict(classes, "ankle", mmHg * 133.322387415); };
  EXPECT_EQ(at(10), "below CCL 1");
  EXPECT_EQ(at(19.5), "CCL 1");
  EXPECT_EQ(at(22), "between CCL 1 and CCL 2");
  EXPECT_EQ(at(40), "CCL 3");
  EXPECT_EQ(at(80), "CCL 4");
  EXPECT_EQ(verdict(classes, "Chest", 3000.0), "");
  reference.name = "discomfort, Denton";
  EXPECT_EQ(verdict(load_bands(reference), "Chest", 50 * 98.0665), "above discomfort, by person and part of the body");
}

TEST(Bands, EveryShippedSetNamesItsEvidence) {
  // Citation, patch and population are said of each, if only that they are not known.
  for (const SensationCurves& set : shipped_curves()) {
    EXPECT_FALSE(set.source.empty() || set.patch.empty() || set.population.empty()) << set.name;
    for (const SensationCurve& curve : set.curves) EXPECT_LT(curve.low, curve.high);
  }
}

/// Answers of `people` at each rating, shared among the words as the bells of the system say.
std::string answers_of(const std::vector<std::pair<double, double>>& bells, int people) {
  const char* words[] = {"neutral", "comfortable", "uncomfortable", "very uncomfortable", "extremely uncomfortable"};
  std::string text = "location,pressure_Pa,sensation_rating,sensation_term,answers\n";
  for (int i = 0; i <= 40; ++i) {
    const double x = 0.1 * i;
    double sum = 0.0;
    std::vector<double> m;
    for (std::size_t t = 0; t < bells.size(); ++t)
      sum += m.emplace_back(1.0 / (1.0 + std::pow(std::abs((x - t) / bells[t].first), 2 * bells[t].second)));
    for (std::size_t t = 0; t < bells.size(); ++t)
      text += "calf," + std::to_string(100 + 50 * i) + "," + std::to_string(x) + "," + words[t] + "," +
              std::to_string(std::lround(people * m[t] / sum)) + "\n";
  }
  return text;
}

TEST(MembershipFit, KnownBellsAreRecovered) {
  // Shares of words made with known bells give their half widths and slopes back, to the rounding of the counts.
  const std::vector<std::pair<double, double>> bells = {{0.6, 2.0}, {0.45, 3.0}, {0.55, 2.5}, {0.5, 1.8}, {0.4, 2.2}};
  input::Diagnostics diagnostics;
  const MembershipFit fit =
      fit_memberships(input::read_csv(written("words.csv", answers_of(bells, 1000000)), diagnostics));
  ASSERT_EQ(fit.variables.size(), 1u);
  for (std::size_t t = 0; t < bells.size(); ++t) {
    EXPECT_TRUE(fit.variables[0].terms[t].fitted);
    EXPECT_NEAR(fit.variables[0].terms[t].width, bells[t].first, 2e-3) << t;
    EXPECT_NEAR(fit.variables[0].terms[t].slope, bells[t].second, 2e-2) << t;
    EXPECT_DOUBLE_EQ(fit.system.inputs[0].terms[t].parameters[1], fit.variables[0].terms[t].width);
  }
  EXPECT_LT(fit.variables[0].deviation, 1e-5);
}

TEST(MembershipFit, WithoutWordsNothingIsInvented) {
  // A table of ratings alone keeps the shipped memberships and says so; an unknown word is an error with its line.
  input::Diagnostics diagnostics;
  const MembershipFit fit = fit_memberships(
      input::read_csv(written("plain.csv", "location,pressure_Pa,sensation_rating\ncalf,1,1\n"), diagnostics));
  EXPECT_TRUE(fit.variables.empty());
  EXPECT_EQ(fit.system.inputs.size(), 1u);
  const auto wrong = input::read_csv(
      written("word.csv", "location,pressure_Pa,sensation_rating,sensation_term\ncalf,1,1,fine\n"), diagnostics);
  try {
    fit_memberships(wrong);
    FAIL();
  } catch (const input::InputError& fault) {
    EXPECT_NE(std::string(fault.what()).find(":2:"), std::string::npos) << fault.what();
  }
}

}  // namespace
}  // namespace snug::postproc
