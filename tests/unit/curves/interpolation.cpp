// Four-point subdivision (3.4) and the piecewise quadratic spline (4.1) to (4.3) of the source, as mended.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mesh/curves/four_point.hpp"
#include "mesh/curves/quadratic_spline.hpp"
#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh::curves {
namespace {

using testing::Random;
using tests::book;

/// Three random polynomials, cubic in x and in y.
struct Bicubic {
  explicit Bicubic(Random& random) : c(random.matrix(3, 16)) {}
  Eigen::Vector3d operator()(double x, double y) const {
    Eigen::VectorXd powers(16);
    for (int k = 0; k < 16; ++k) powers[k] = std::pow(x, k / 4) * std::pow(y, k % 4);
    return c * powers;
  }
  Eigen::MatrixXd c;
};

template <class Function>
Net sampled(int rows, int columns, const Function& f) {
  Net net{rows, columns, false, false, Eigen::MatrixXd(3, rows * columns)};
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j)
      net.points.col(i * columns + j).head<3>() = f(i / (rows - 1.0), j / (columns - 1.0));
  return net;
}

TEST(FourPoint, OpenNetsReproduceBicubicsUpToTheirEdges) {
  Random random(51);
  double worst = 0.0;
  for (const auto& [rows, columns] : {std::pair{4, 4}, {5, 7}, {9, 4}}) {
    const Bicubic f(random);
    Net net = sampled(rows, columns, f);
    for (int step = 0; step < 4; ++step) net = subdivided(net);
    const Net exact = sampled((rows - 1) * 16 + 1, (columns - 1) * 16 + 1, f);
    ASSERT_EQ(net.rows, exact.rows);
    ASSERT_EQ(net.columns, exact.columns);
    worst = std::max(worst, (net.points - exact.points).cwiseAbs().maxCoeff());
  }
  book("curves: four-point", "open nets of bicubics, four steps: largest distance", worst, 0.0, 1e-13, "bicubic");
}

TEST(FourPoint, MiddleOfACubicIsExactAndNotThatOfThePrint) {
  const Eigen::RowVectorXd x = Eigen::RowVectorXd::LinSpaced(4, -1.0, 2.0);
  const Eigen::MatrixXd fine = subdivided(Eigen::MatrixXd(x.array().cube()), false);
  EXPECT_EQ(fine(0, 3), 0.125);  // at 1/2; with P_i-2 in place of P_i+2, as printed, 1.125
}

TEST(FourPoint, OrderOfTheDirectionsDoesNotMatter) {
  Random random(52);
  for (const bool rows_closed : {false, true})
    for (const bool columns_closed : {false, true}) {
      const Net net{4, 5, rows_closed, columns_closed, random.matrix(3, 20)};
      Net turned{5, 4, columns_closed, rows_closed, Eigen::MatrixXd(3, 20)};
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 5; ++j) turned.points.col(j * 4 + i) = net.points.col(i * 5 + j);
      const Net a = subdivided(net), b = subdivided(turned);
      ASSERT_EQ(a.rows, b.columns);
      for (int i = 0; i < a.rows; ++i)
        for (int j = 0; j < a.columns; ++j)
          EXPECT_LE((a.points.col(i * a.columns + j) - b.points.col(j * b.columns + i)).norm(), 1e-15);
    }
}

TEST(FourPoint, TensionZeroIsBilinearAndPointsAreKept) {
  Random random(53);
  const Net net{3, 4, false, true, random.matrix(2, 12)};
  const Net flat = subdivided(net, 0.0), smooth = subdivided(net);
  EXPECT_EQ(flat.rows, 5);
  EXPECT_EQ(flat.columns, 8);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 4; ++j) EXPECT_EQ(smooth.points.col(2 * i * 8 + 2 * j), net.points.col(i * 4 + j));
  const Eigen::VectorXd middle = (net.points.col(0) + net.points.col(1) + net.points.col(4) + net.points.col(5)) / 4.0;
  EXPECT_LE((flat.points.col(8 + 1) - middle).norm(), 1e-15);
}

/// A torus, closed both ways: the fourth order of the cubic's error.
TEST(FourPoint, ClosedNetsConvergeWithFourthOrder) {
  const auto torus = [](double a, double b) {
    const double u = 2 * std::numbers::pi * a, v = 2 * std::numbers::pi * b;
    return Eigen::Vector3d((3 + std::cos(v)) * std::cos(u), (3 + std::cos(v)) * std::sin(u), std::sin(v));
  };
  std::vector<double> errors;
  for (const int count : {8, 16, 32}) {
    Net net{count, count, true, true, Eigen::MatrixXd(3, count * count)};
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j)
        net.points.col(i * count + j).head<3>() = torus(i / double(count), j / double(count));
    for (int step = 0; step < 3; ++step) net = subdivided(net);
    double worst = 0.0;
    for (int i = 0; i < net.rows; ++i)
      for (int j = 0; j < net.columns; ++j)
        worst = std::max(
            worst, (net.points.col(i * net.columns + j) - torus(i / double(net.rows), j / double(net.columns))).norm());
    errors.push_back(worst);
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), 4.0, 0.3);
  book("curves: four-point", "closed torus, 16 to 32 points around: order of the error",
       std::log2(errors[1] / errors[2]), 4.0, 0.05, "fourth order");
}

/// The limit's tangent is continuous, up to the ends: slopes of neighbouring edges approach each other.
TEST(FourPoint, SlopesOfTheLimitAreContinuous) {
  Random random(54);
  for (const bool closed : {false, true}) {
    Eigen::MatrixXd points = random.matrix(1, 7);
    double last = 0.0;
    for (int step = 0; step <= 10; ++step) {
      const Eigen::MatrixXd edges =
          (points.rightCols(points.cols() - 1) - points.leftCols(points.cols() - 1)) * std::pow(2.0, step);
      const double jump = (edges.rightCols(edges.cols() - 1) - edges.leftCols(edges.cols() - 1)).cwiseAbs().maxCoeff();
      if (step == 10) {
        EXPECT_LT(jump, 0.05 * last);
      }
      if (step == 1) last = jump;
      points = subdivided(points, closed);
    }
  }
}

TEST(FourPoint, ShortOrWrongNetsAreRefused) {
  EXPECT_THROW(subdivided(Eigen::MatrixXd::Zero(2, 1), false), std::invalid_argument);
  EXPECT_THROW(subdivided(Eigen::MatrixXd::Zero(2, 2), true), std::invalid_argument);
  EXPECT_THROW(subdivided(Net{2, 3, false, false, Eigen::MatrixXd::Zero(3, 5)}), std::invalid_argument);
  EXPECT_EQ(subdivided(Eigen::MatrixXd(Eigen::RowVector2d(0, 1)), false),
            Eigen::MatrixXd(Eigen::RowVector3d(0, 0.5, 1)));
}

Eigen::MatrixXd row(const std::vector<double>& t, const auto& f) {
  Eigen::MatrixXd points(1, t.size());
  for (std::size_t i = 0; i < t.size(); ++i) points(0, i) = f(t[i]);
  return points;
}

SplineEnds tangents(double first, double last) {
  return {SplineEnds::Kind::tangents, Eigen::VectorXd::Constant(1, first), Eigen::VectorXd::Constant(1, last)};
}

TEST(QuadraticSpline, ReproducesQuadratics) {
  const std::vector<double> t = {0, 0.2, 0.5, 0.6, 1.0};
  const auto f = [](double x) { return 3 * x * x - x + 2; };
  const QuadraticSpline spline(t, row(t, f), tangents(-1.0, 5.0));
  double worst = 0.0;
  for (int i = 0; i <= 100; ++i) worst = std::max(worst, std::abs(spline.point(i / 100.0)[0] - f(i / 100.0)));
  book("curves: quadratic spline", "quadratic with its end tangents: largest distance", worst, 0.0, 1e-14, "(4.1)");
}

TEST(QuadraticSpline, MeetsTheSineWithThirdOrder) {
  std::vector<double> errors;
  for (const int count : {8, 16, 32, 64}) {
    std::vector<double> t;
    for (int i = 0; i <= count; ++i) t.push_back(i / double(count));
    const QuadraticSpline spline(t, row(t, [](double x) { return std::sin(3 * x); }),
                                 tangents(3.0, 3.0 * std::cos(3.0)));
    double worst = 0.0;
    for (int i = 0; i <= 4000; ++i)
      worst = std::max(worst, std::abs(spline.point(i / 4000.0)[0] - std::sin(3 * i / 4000.0)));
    errors.push_back(worst);
  }
  EXPECT_NEAR(errors[0], 5.6e-4, 0.05e-4);  // the value of the mended formula, evaluated apart
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), 3.0, 0.1);
  book("curves: quadratic spline", "sin 3t, 32 to 64 intervals: order of the error", std::log2(errors[2] / errors[3]),
       3.0, 0.02, "third order");
}

TEST(QuadraticSpline, GoesThroughItsPointsWithAContinuousTangent) {
  Random random(55);
  Eigen::MatrixXd points = random.matrix(2, 7);
  points.col(6) = points.col(0);
  double jump = 0.0, off = 0.0;
  for (const auto kind : {SplineEnds::Kind::natural, SplineEnds::Kind::periodic}) {
    const QuadraticSpline spline = QuadraticSpline::by_chords(points, {kind, {}, {}});
    const std::vector<double>& t = spline.parameters();
    for (std::size_t i = 0; i < t.size(); ++i) off = std::max(off, (spline.point(t[i]) - points.col(i)).norm());
    for (std::size_t i = 1; i < t.size(); ++i) {
      const double middle = 0.5 * (t[i] + t[i - 1]), before = std::nextafter(middle, 0.0),
                   after = std::nextafter(middle, 1e9);
      jump = std::max(jump, (spline.point(after) - spline.point(before)).norm());
      jump = std::max(jump, (spline.derivative(after) - spline.derivative(before)).norm());
    }
    const double end = t.back(), h = 1e-3 * end;
    if (kind == SplineEnds::Kind::periodic)
      EXPECT_LE((spline.derivative(0.0) - spline.derivative(end)).norm(), 1e-13);
    else
      EXPECT_LE((spline.derivative(h) - spline.derivative(0.0)).norm() +
                    (spline.derivative(end - h) - spline.derivative(end)).norm(),
                1e-12);
  }
  EXPECT_LE(off, 1e-14);
  book("curves: quadratic spline", "random points, natural and periodic: jump of place and tangent", jump, 0.0, 1e-13,
       "(4.2), (4.3)");
}

TEST(QuadraticSpline, IsABSplineOfDegreeTwo) {
  Random random(56);
  double worst = 0.0;
  for (const int count : {2, 3, 8}) {
    const QuadraticSpline spline = QuadraticSpline::by_chords(random.matrix(3, count));
    const BSplineCurve curve = b_spline_of(spline);
    EXPECT_EQ(curve.fault(), "");
    for (int i = 0; i <= 100; ++i) {
      const double t = curve.end() * i / 100.0;
      worst = std::max(worst, (curve.point(t) - spline.point(t)).norm());
    }
  }
  book("curves: quadratic spline", "as B-spline of degree 2: largest distance", worst, 0.0, 1e-14, "itself");
}

TEST(QuadraticSpline, WrongInputIsRefused) {
  const Eigen::MatrixXd points = Eigen::MatrixXd::Random(2, 3);
  EXPECT_THROW(QuadraticSpline({0, 1}, points), std::invalid_argument);
  EXPECT_THROW(QuadraticSpline({0, 1, 1}, points), std::invalid_argument);
  EXPECT_THROW(QuadraticSpline({0}, points.leftCols(1)), std::invalid_argument);
  EXPECT_THROW(QuadraticSpline({0, 1, 2}, points, tangents(1, 1)), std::invalid_argument);
  EXPECT_THROW(QuadraticSpline({0, 1, 2}, points, {SplineEnds::Kind::periodic, {}, {}}), std::invalid_argument);
  EXPECT_THROW(QuadraticSpline::by_chords(Eigen::MatrixXd::Ones(2, 3)), std::invalid_argument);
  EXPECT_NO_THROW(QuadraticSpline({0, 1}, points.leftCols(2)));
}

}  // namespace
}  // namespace snug::mesh::curves
