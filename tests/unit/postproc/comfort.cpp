#include "postproc/comfort/comfort.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include "postproc/evaluate.hpp"
#include "tests/fuzzy_example.hpp"

namespace snug::postproc {
namespace {

FuzzySystem worked_example(int resolution) {
  FuzzySystem system = tests::worked_example();
  system.resolution = resolution;
  return system;
}

TEST(Fuzzy, MembershipsAndFiringsOfTheWorkedExample) {
  // Bells and minimum reproduce the printed digits (12) of the reference book, also where |.| matters.
  const FuzzyAnswer answer = infer(worked_example(1001), {1.6, 3.0});
  const std::vector<double> low_mid_high = {0.225429643364, 0.837877588127, 0.006671879746};
  const std::vector<double> soft_stiff = {0.955423749541, 0.117239671654};
  const std::vector<double> firing = {0.225429643364, 0.117239671654, 0.837877588127, 0.117239671654, 0.006671879746};
  for (int t = 0; t < 3; ++t) EXPECT_NEAR(answer.memberships[0][t], low_mid_high[t], 1e-12);
  for (int t = 0; t < 2; ++t) EXPECT_NEAR(answer.memberships[1][t], soft_stiff[t], 1e-12);
  for (int r = 0; r < 5; ++r) EXPECT_NEAR(answer.strengths[r], firing[r], 1e-12);
}

TEST(Fuzzy, CentroidOfTheWorkedExample) {
  // Midpoint sums converge to the centroid (n = 100001 of the book) with the square of the width, as its trapezoidal
  // rule does; with 1001 intervals they are within 1e-5, with 100001 within 1e-8.
  struct Check {
    double p, s, centroid;
  };
  for (const auto& [p, s, centroid] : {Check{1.6, 3.0, 5.1167038760}, {3.2, 7.0, 2.6071268859}, {0.2, 9.0, 5.0}}) {
    EXPECT_NEAR(infer(worked_example(1001), {p, s}).score, centroid, 1e-5);
    EXPECT_NEAR(infer(worked_example(100001), {p, s}).score, centroid, 1e-8);
  }
}

TEST(Fuzzy, TrapezoidsHalveTheEnds) {
  // Of the output x / 10 on 0 to 10 at eleven points: sum of w x^2 / sum of w x with half weights at the ends is 335 / 50, as plain
  // sums 385 / 55.
  FuzzySystem ramp;
  ramp.inputs = {{"p", 0, 1, {{"on", "Rectangle", {0, 1}}}}};
  ramp.output = {"y", 0, 10, {{"high", "Ramp", {0, 10}}}};
  ramp.rules = {"if p is on then y is high"};
  ramp.resolution = 11;
  ramp.integration = Integration::trapezoids;
  EXPECT_NEAR(infer(ramp, {0.5}).score, 6.7, 1e-12);
  ramp.integration = Integration::point_sums;
  EXPECT_NEAR(infer(ramp, {0.5}).score, 7.0, 1e-12);
}

TEST(Fuzzy, WrongRulesAndCountsAreRefused) {
  // A rule that names an unknown term and a missing input value throw instead of answering.
  FuzzySystem wrong = worked_example(101);
  wrong.rules.push_back("if p is huge then y is bad");
  EXPECT_THROW(infer(wrong, {1, 1}), std::invalid_argument);
  EXPECT_THROW(infer(worked_example(101), {1}), std::invalid_argument);
}

std::vector<LocationRating> everywhere(double rating, int locations = 3) {
  std::vector<LocationRating> ratings;
  for (int i = 0; i < locations; ++i) ratings.push_back({"location " + std::to_string(i), rating});
  return ratings;
}

TEST(Comfort, TheIntervalHoldsItsShareOfTheDraws) {
  // Of 2000 single draws 95 % lie in the interval of many: within four standard deviations, 2 %.
  const std::vector<LocationRating> ratings = {{"location 0", 1.3, 0.03, 5}};
  const FuzzySystem system = comfort_system({"location 0"});
  const ScoreInterval interval = *judge(ratings, system, {.samples = 4000, .seed = 1}).interval;
  int inside = 0;
  for (int draw = 0; draw < 2000; ++draw) {
    const double score = judge(ratings, system, {.samples = 1, .seed = 10 + draw}).interval->low;
    inside += score >= interval.low && score <= interval.high;
  }
  EXPECT_NEAR(inside / 2000.0, 0.95, 0.02);
}

TEST(Comfort, RulesOfTable54) {
  // One uncomfortable location spoils the garment; all neutral is acceptable; all comfortable is better than that.
  auto one_bad = everywhere(1.0);
  one_bad[1].rating = 3.0;
  EXPECT_EQ(judge(everywhere(2.0)).term, "uncomfortable");
  EXPECT_EQ(judge(everywhere(4.0)).term, "uncomfortable");
  EXPECT_EQ(judge(one_bad).term, "uncomfortable");
  EXPECT_EQ(judge(everywhere(0.0)).term, "acceptable");
  EXPECT_EQ(judge(everywhere(1.0)).term, "comfortable");
  EXPECT_EQ(judge(everywhere(1.0, 9)).term, "comfortable");
}

TEST(Comfort, TellsWhichRulesFired) {
  // Nine locations give nine "or worse" rules and two over all, each with its strength.
  const Comfort comfort = judge(everywhere(2.5, 9));
  ASSERT_EQ(comfort.rules.size(), 11u);
  EXPECT_DOUBLE_EQ(comfort.rules[0].strength, 1.0);
  EXPECT_LT(comfort.rules[9].strength, 0.01);
  EXPECT_EQ(comfort.memberships.size(), 9u);
  EXPECT_EQ(comfort.memberships[0].degrees.size(), 5u);
  EXPECT_NEAR(comfort.memberships[0].degrees[2], 0.5, 1e-12);
  EXPECT_EQ(comfort.sensation_terms[3], "very uncomfortable");
}

TEST(Comfort, MoreSensationNeverScoresBetterFromComfortableOn) {
  // Among ratings in [1, 4], where the rules are monotone, raising any one never lowers the score (grows with
  // discomfort).
  std::mt19937 random(3);
  std::uniform_real_distribution<double> rating(1.0, 4.0);
  for (int trial = 0; trial < 200; ++trial) {
    auto ratings = everywhere(0.0, 1 + trial % 4);
    for (auto& one : ratings) one.rating = std::min(rating(random), rating(random));
    const double before = judge(ratings).score;
    double& raised = ratings[trial % ratings.size()].rating;
    raised = std::min(4.0, raised + 0.3 * rating(random));
    EXPECT_GE(judge(ratings).score, before - 1e-9);
  }
  double last = 0.0;
  for (double all = 1.0; all <= 4.0; all += 0.05) {
    const double score = judge(everywhere(all)).score;
    EXPECT_GE(score, last - 1e-9) << all;
    last = score;
  }
}

TEST(Comfort, AnUncomfortableLocationNeverImprovesTheScoreByGettingWorse) {
  // Also beside neutral locations: from "uncomfortable" (2) upwards a single location only makes it worse.
  auto ratings = everywhere(0.4);
  double last = 0.0;
  for (double value = 2.0; value <= 4.0; value += 0.05) {
    ratings[0].rating = value;
    const double score = judge(ratings).score;
    EXPECT_GE(score, last - 1e-9) << value;
    last = score;
  }
}

TEST(Comfort, NothingToJudgeIsAnError) {
  // Without a rated location there is no comfort, rather than a number.
  EXPECT_THROW(judge({}), std::invalid_argument);
}

}  // namespace
}  // namespace snug::postproc
