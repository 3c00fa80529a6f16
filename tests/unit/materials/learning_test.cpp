// Learning from recorded runs and from the properties of fabrics.
#include <gmock/gmock.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <stdexcept>

#include "materials/learning/response_surface.hpp"
#include "materials/learning/standard_scale.hpp"

namespace snug::testing {
namespace {

using Eigen::Index, Eigen::MatrixXd, Eigen::VectorXd;
using materials::Degree, materials::ResponseSurface;
using ::testing::ElementsAre;

/// Properties of very different sizes: J/m2, a plain number, m.
MatrixXd properties(int rows, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> of(0.0, 1.0);
  MatrixXd table(rows, 3);
  for (int r = 0; r < rows; ++r) table.row(r) << 5.0 + 10.0 * of(random), 0.8 + 0.4 * of(random), 0.35 + 0.1 * of(random);
  return table;
}
double quadratic(const VectorXd& x) { return 300.0 + 12.0 * x[0] - 80.0 * x[1] - 900.0 * x[2] + 0.7 * x[0] * x[0] + 40.0 * x[1] * x[1] + 1500.0 * x[2] * x[2] - 3.0 * x[0] * x[1] + 11.0 * x[0] * x[2] + 60.0 * x[1] * x[2]; }
VectorXd gradient(const VectorXd& x) {
  return Eigen::Vector3d(12.0 + 1.4 * x[0] - 3.0 * x[1] + 11.0 * x[2], -80.0 + 80.0 * x[1] - 3.0 * x[0] + 60.0 * x[2], -900.0 + 3000.0 * x[2] + 11.0 * x[0] + 60.0 * x[1]);
}
VectorXd responses(const MatrixXd& table) {
  VectorXd all(table.rows());
  for (Index r = 0; r < table.rows(); ++r) all[r] = quadratic(table.row(r).transpose());
  return all;
}

TEST(ResponseSurface, AQuadraticResponseIsRecoveredExactly) {
  // Values and sensitivities inside and far outside of the runs, to round-off, from 15 runs for 10 coefficients.
  const MatrixXd table = properties(15, 3);
  const ResponseSurface fit = fit_response(table, responses(table), Degree::quadratic);
  for (const VectorXd& x : {VectorXd(Eigen::Vector3d(9.0, 1.0, 0.4)), VectorXd(Eigen::Vector3d(30.0, 0.2, 0.9))}) {
    EXPECT_NEAR(fit.at(x), quadratic(x), 1e-9 * std::abs(quadratic(x)));
    EXPECT_LT((fit.gradient(x) - gradient(x)).norm(), 1e-8 * gradient(x).norm());
  }
  EXPECT_LT(fit.rms, 1e-9);
  EXPECT_LT(fit.cross_validated_rms, 1e-8);
  EXPECT_NEAR(fit.r_squared, 1.0, 1e-12);
}

TEST(ResponseSurface, TheCrossValidatedErrorIsThatOfFitsWithoutTheRun) {
  // The formula of leverages against fits in which each run is left out in turn, of a linear fit to a quadratic response and noise.
  const MatrixXd table = properties(12, 5);
  VectorXd y = responses(table);
  for (Index r = 0; r < y.size(); ++r) y[r] += std::sin(7.0 * static_cast<double>(r));
  const ResponseSurface fit = fit_response(table, y, Degree::linear);
  double squares = 0.0;
  for (Index out = 0; out < y.size(); ++out) {
    MatrixXd others(y.size() - 1, 3);
    VectorXd of_others(y.size() - 1);
    for (Index r = 0, next = 0; r < y.size(); ++r)
      if (r != out) others.row(next) = table.row(r), of_others[next++] = y[r];
    squares += std::pow(fit_response(others, of_others, Degree::linear).at(table.row(out).transpose()) - y[out], 2);
  }
  EXPECT_NEAR(fit.cross_validated_rms, std::sqrt(squares / 12.0), 1e-9 * fit.cross_validated_rms);
  EXPECT_GT(fit.cross_validated_rms, fit.rms);
  EXPECT_LT(fit.q_squared, fit.r_squared);
}

TEST(ResponseSurface, NoiseIsNotTakenForKnowledge) {
  // A response that has nothing to do with the properties: the fit tells some of it, the cross-validation nothing.
  std::mt19937 random(11);
  std::normal_distribution<> noise;
  const MatrixXd table = properties(20, 9);
  const VectorXd y = VectorXd::NullaryExpr(20, [&] { return noise(random); });
  const ResponseSurface fit = fit_response(table, y, Degree::quadratic);
  EXPECT_GT(fit.r_squared, 0.3);
  EXPECT_LT(fit.q_squared, 0.0);
}

TEST(ResponseSurface, WhatCannotBeToldApartIsRefused) {
  MatrixXd table = properties(15, 3);
  const VectorXd y = responses(table);
  EXPECT_THROW(fit_response(table.topRows(10), y.head(10), Degree::quadratic), std::invalid_argument) << "10 runs, 10 terms";
  table.col(1) = 2.0 * table.col(0);
  EXPECT_THROW(fit_response(table, y, Degree::linear), std::invalid_argument) << "one follows from the other";
  table.col(1).setConstant(0.1);
  EXPECT_THROW(fit_response(table, y, Degree::linear), std::invalid_argument) << "the same everywhere";
}

TEST(Neighbours, AreNearInStandardDeviationsWhateverTheUnits) {
  // By hand: column deviations sqrt(14/3) and 1000 times that; the distance of row 0 from row 1 is that of one column.
  const double none = std::nan("");
  MatrixXd table(4, 2);
  table << 0.0, 0.0, 1.0, 0.0, 0.0, 4000.0, 5.0, 5000.0;
  const auto near = materials::neighbours(table, 0);
  ASSERT_EQ(near.size(), 3u);
  EXPECT_EQ(near[0].row, 1);
  EXPECT_EQ(near[1].row, 2);
  EXPECT_EQ(near[2].row, 3);
  const double deviation = std::sqrt((1.5 * 1.5 + 0.5 * 0.5 + 1.5 * 1.5 + 3.5 * 3.5) / 3.0);
  EXPECT_NEAR(near[0].distance, 1.0 / deviation / std::sqrt(2.0), 1e-12);
  MatrixXd in_other_units = table;
  in_other_units.col(1) *= 1e-6;
  EXPECT_NEAR(materials::neighbours(in_other_units, 0)[1].distance, near[1].distance, 1e-12);
  table(1, 1) = none;
  EXPECT_EQ(materials::neighbours(table, 0)[0].shared, 1);
  MatrixXd three(3, 3);
  three << 1, 2, 3, 4, none, none, 2, 3, none;
  EXPECT_EQ(materials::neighbours(three, 0).size(), 1u) << "of row 1 less than half is known";
}

TEST(Clusters, GroupsThatLieApartAreFound) {
  // Three groups of 5, 4 and 3 about (0, 0), (100, 0), (0, 1), in units a hundred times apart, their rows mixed.
  std::mt19937 random(2);
  std::uniform_real_distribution<> of(-0.05, 0.05);
  MatrixXd table(12, 2);
  const int group[] = {0, 1, 2, 0, 0, 1, 2, 1, 0, 2, 0, 1};
  for (int r = 0; r < 12; ++r) table.row(r) << (group[r] == 1 ? 100.0 : 0.0) + 100.0 * of(random), (group[r] == 2 ? 1.0 : 0.0) + of(random);
  const auto found = materials::clusters(table, 3);
  EXPECT_THAT(found.of, ::testing::ElementsAreArray(group));
  EXPECT_NEAR(found.centres(1, 0), 100.0, 5.0);
  EXPECT_NEAR(found.centres(2, 1), 1.0, 0.05);
  EXPECT_GT(found.share_between, 0.98);
  EXPECT_EQ(materials::clusters(table, 1).share_between, 0.0);
  EXPECT_NEAR(materials::clusters(table, 12).share_between, 1.0, 1e-12);
  EXPECT_THROW(materials::clusters(table, 13), std::invalid_argument);
  table.row(1) = table.row(0);
  EXPECT_THROW(materials::clusters(table, 12), std::invalid_argument) << "eleven different rows";
}

}  // namespace
}  // namespace snug::testing
