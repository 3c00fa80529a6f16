// The source's (3.1) to (3.13) and theorems 3.1 to 3.7 as mended. Residuals: 1e-12 where exact, 1e-8 where differenced.
#include <gsl/gsl_bspline.h>
#include <gsl/gsl_vector.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mesh/curves/convexity.hpp"
#include "mesh/curves/recurrence.hpp"
#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh::curves {
namespace {

using testing::difference;
using testing::Random;
using tests::book;

double error(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

/// The de Boor bases of GSL for the knots x, u_1…u_n, r_0…r_{n-1}, x. It takes breakpoints; its knots are set over.
Eigen::VectorXd gsl_bases(const SegmentKnots& knots, double t) {
  const std::size_t n = knots.degree();
  gsl_bspline_workspace* workspace = gsl_bspline_alloc(n + 1, 2);
  double* knot = workspace->knots->data;
  *knot++ = knots.u().front() - 1.0;
  knot = std::copy(knots.u().begin(), knots.u().end(), knot);
  knot = std::copy(knots.r().begin(), knots.r().end(), knot);
  *knot = knots.r().back() + 1.0;
  Eigen::VectorXd bases(n + 1);
  gsl_vector_view view = gsl_vector_view_array(bases.data(), n + 1);
  gsl_bspline_eval(t, &view.vector, workspace);
  gsl_bspline_free(workspace);
  return bases;
}

TEST(WCurve, IsOneSegmentOfABSpline) {
  Random random(1);
  double worst = 0.0;
  for (int degree = 2; degree <= 6; ++degree)
    for (int trial = 0; trial < 50; ++trial) {
      const SegmentKnots knots = random.knots(degree);
      const double t = random.between(0.0, 1.0);
      worst = std::max(worst, error(knots.bases(t), gsl_bases(knots, t)));
    }
  book("curves: W curve", "bases, degrees 2 to 6, random knots: largest difference from GSL's B-splines", worst, 0.0,
       1e-14, "GSL");
}

TEST(WCurve, KnotsMeetTheConditionsAndComeBackFromTheSteps) {
  Random random(2);
  double worst = 0.0;
  for (int degree = 2; degree <= 6; ++degree)
    for (const bool sorted : {true, false}) {
      const SegmentKnots knots = random.knots(degree, sorted);
      const LinearSteps steps(knots);
      worst = std::max(worst, steps.w_residual());
      const auto back = steps.knots();
      ASSERT_TRUE(back);
      for (int i = 0; i < degree; ++i) {
        EXPECT_NEAR(back->u()[i], knots.u()[i], 1e-12);
        EXPECT_NEAR(back->r()[i], knots.r()[i], 1e-12);
      }
    }
  book("curves: W curve", "conditions (3.2), random knots: largest residual", worst, 0.0, 1e-12, "definition 3.2");
}

TEST(WCurve, StepsThatMissTheConditionsAreNoWCurve) {
  Random random(3);
  for (int degree = 2; degree <= 6; ++degree) {
    LinearSteps steps(random.knots(degree));
    steps.b(0, degree) += 1e-6;  // the last step alone no longer belongs to the others
    EXPECT_GT(steps.w_residual(), 1e-8);
    EXPECT_FALSE(steps.knots());
  }
  LinearSteps flat(random.knots(3));
  flat.a(1, 1) = 0.0;
  EXPECT_FALSE(flat.knots());
}

TEST(WCurve, RecurrenceBasesAndRationalRecurrenceAgree) {
  Random random(4);
  for (int degree = 1; degree <= 6; ++degree)
    for (const bool sorted : {true, false}) {
      const WCurve curve = random.curve(degree, 2, sorted);
      const LinearSteps steps(curve.knots());
      const double t = random.between(0.0, 1.0);
      const Eigen::VectorXd w = steps.point(curve.weights().transpose(), t);
      const Eigen::VectorXd wp = steps.point(curve.points() * curve.weights().asDiagonal(), t);
      EXPECT_LE(error(curve.point(t), wp / w[0]), 1e-12);
      EXPECT_NEAR(curve.knots().bases(t).sum(), 1.0, 1e-14);
    }
}

TEST(WCurve, DerivativesAreTheSlopesOfTheSteps) {
  Random random(5);
  double exact = 0.0, differenced = 0.0;
  for (int degree = 2; degree <= 6; ++degree) {
    const WCurve curve = random.curve(degree);
    // (3.6) of the polynomial curve: n a_0n (W_{0,n-1} - W_{1,n-1}), by the points after n - 1 steps.
    const WCurve polynomial(curve.knots(), curve.points());
    const double t = random.between(0.1, 0.9);
    const Eigen::MatrixXd last = polynomial.stepped(degree - 1, t).points();
    const Eigen::VectorXd slope = degree * curve.knots().slope(0, degree) * (last.col(0) - last.col(1));
    exact = std::max(exact, error(polynomial.derivatives(t, 1).col(1), slope));
    for (int order = 1; order <= 3; ++order) {
      const auto lower = [&](double s) -> Eigen::VectorXd { return curve.derivatives(s, order - 1).col(order - 1); };
      const Eigen::MatrixXd derivatives = curve.derivatives(t, order);
      const double scale = std::max(1.0, derivatives.cwiseAbs().maxCoeff());
      differenced = std::max(differenced, error(derivatives.col(order), difference(lower, t)) / scale);
    }
  }
  book("curves: W curve", "derivative of the polynomial curve against (3.6)", exact, 0.0, 1e-12, "theorem 3.1");
  book("curves: W curve", "derivatives 1 to 3 of the rational curve against differences", differenced, 0.0, 1e-8,
       "fourth-order difference");
}

TEST(WCurve, IsTheEnvelopeOfItsFamilies) {
  Random random(6);
  double touch = 0.0, slopes = 0.0, duals = 0.0;
  for (int degree = 2; degree <= 6; ++degree)
    for (int l = 1; l < degree; ++l) {
      const WCurve curve = random.curve(degree);
      const double t = random.between(0.1, 0.9), n = degree;
      const Eigen::VectorXd slope = curve.derivatives(t, 1).col(1);
      const WCurve member = curve.stepped(l, t);
      EXPECT_EQ(member.degree(), degree - l);
      touch = std::max(touch, error(member.point(t), curve.point(t)));
      slopes = std::max(slopes, error(member.derivatives(t, 1).col(1), (n - l) / n * slope));
      // The dual family: tau varies, t stands.
      const auto dual = [&](double tau) { return curve.stepped(l, tau).point(t); };
      duals = std::max(duals, error(difference(dual, t), l / n * slope));
    }
  book("curves: envelope", "member of the family where it touches: distance from the curve", touch, 0.0, 1e-12,
       "theorem 3.2");
  book("curves: envelope", "its derivative less (n-l)/n of the curve's", slopes, 0.0, 1e-12, "theorem 3.2");
  book("curves: envelope", "dual family, differenced: derivative less l/n of the curve's", duals, 0.0, 1e-8,
       "theorem 3.3");
}

TEST(WCurve, FamilyOfLinesIsTheTangents) {
  Random random(7);
  for (int degree = 2; degree <= 6; ++degree) {
    const WCurve curve = random.curve(degree, 2);
    const double t = random.between(0.0, 1.0);
    const Eigen::MatrixXd line = curve.stepped(degree - 1, t).points();
    const Eigen::Vector2d along = (line.col(1) - line.col(0)).normalized(),
                          slope = curve.derivatives(t, 1).col(1).normalized();
    EXPECT_NEAR(along.x() * slope.y() - along.y() * slope.x(), 0.0, 1e-12);
  }
}

TEST(WCurve, EqualsItsRationalBezierCurve) {
  Random random(8);
  double worst = 0.0;
  for (int degree = 1; degree <= 6; ++degree)
    for (const bool sorted : {true, false}) {
      const WCurve curve = random.curve(degree, 3, sorted), bezier = curve.bezier(0.0, 1.0),
                   part = curve.bezier(0.25, 0.5);
      EXPECT_TRUE((bezier.weights().array() > 0.0).all());  // lemma 3.1
      for (const double t : {0.25, 0.3, 0.41, 0.5}) {
        worst = std::max(worst, error(bezier.point(t), curve.point(t)));
        worst = std::max(worst, error(part.point(t), curve.point(t)));
      }
      EXPECT_LE(error(bezier.points().col(0), curve.point(0.0)), 1e-12);
      EXPECT_LE(error(bezier.points().col(degree), curve.point(1.0)), 1e-12);
    }
  book("curves: W curve", "as rational Bezier curve, degrees 1 to 6: largest distance", worst, 0.0, 1e-12,
       "theorem 3.5");
}

TEST(WCurve, QuarterCircleIsExact) {
  const Eigen::Matrix<double, 2, 3> corner{{1, 1, 0}, {0, 1, 1}};
  const WCurve arc(SegmentKnots::bezier(2), corner, Eigen::VectorXd{{1.0, std::numbers::sqrt2 / 2.0, 1.0}});
  double worst = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const double t = i / 100.0;
    const Eigen::MatrixXd d = arc.derivatives(t, 2);
    worst = std::max(worst, std::abs(d.col(0).norm() - 1.0));
    const double curvature = (d(0, 1) * d(1, 2) - d(1, 1) * d(0, 2)) / std::pow(d.col(1).norm(), 3);
    EXPECT_NEAR(curvature, 1.0, 1e-14);
  }
  book("curves: W curve", "quarter circle of weights 1, 1/sqrt 2, 1: radius less 1", worst, 0.0, 4e-16, "circle");
}

/// Points of an ellipse in the order of their angles, the arc shorter than the whole: a convex polygon without a
/// straight corner.
Eigen::MatrixXd convex_polygon(Random& random, int corners) {
  std::vector<double> angles(corners);
  const double start = random.between(0.0, 6.0), arc = random.between(0.5, 6.0);
  for (double& angle : angles) angle = start + arc * random.between(0.0, 1.0);
  std::sort(angles.begin(), angles.end());
  const Eigen::Matrix2d shear = random.matrix(2, 2) + 2.0 * Eigen::Matrix2d::Identity();
  Eigen::MatrixXd polygon(2, corners);
  for (int i = 0; i < corners; ++i)
    polygon.col(i).head<2>() = shear * Eigen::Vector2d(std::cos(angles[i]), std::sin(angles[i]));
  return polygon;
}

/// Every control polygon is convex, so are the Bézier polygon (3.6) and the curve (3.7), by the signs of its curvature
/// and the turn of its tangent.
TEST(Convexity, IsKeptByTenThousandRandomPolygons) {
  Random random(9);
  int faults = 0;
  for (int trial = 0; trial < 10000; ++trial) {
    const int degree = 2 + trial % 5;
    const WCurve curve(random.knots(degree, trial % 2 == 0), convex_polygon(random, degree + 1),
                       random.weights(degree + 1));
    if (!is_convex(curve.points(), 0.0)) continue;
    Eigen::MatrixXd samples(2, 25);
    for (int i = 0; i < samples.cols(); ++i) samples.col(i) = curve.point(i / 24.0);
    faults += convexity(curve) != Convexity::by_polygon || !is_convex(curve.bezier(0.0, 1.0).points()) ||
              !is_convex(samples, 1e-9);
    double least = 0.0, most = 0.0;
    for (int i = 0; i <= 24; ++i) {
      const Eigen::MatrixXd d = curve.derivatives(i / 24.0, 2);
      const double sign = (d(0, 1) * d(1, 2) - d(1, 1) * d(0, 2)) / (d.col(1).norm() * d.col(2).norm() + 1e-300);
      least = std::min(least, sign), most = std::max(most, sign);
    }
    faults += least < -1e-9 && most > 1e-9;
  }
  book("curves: convexity", "curves of 10 000 random convex polygons, degrees 2 to 6, that are not convex", faults, 0.0,
       0.0, "theorems 3.6, 3.7");
}

TEST(Convexity, TestTellsConvexFromOthers) {
  Random random(10);
  int kept = 0;
  for (int trial = 0; trial < 10000; ++trial) kept += is_convex(convex_polygon(random, 3 + trial % 5), 0.0);
  EXPECT_EQ(kept, 10000);  // the test above leaves none out
  const Eigen::Matrix<double, 2, 4> zigzag{{0, 1, 2, 3}, {0, 1, -1, 0}};
  EXPECT_FALSE(is_convex(zigzag));
  const WCurve s_curve(SegmentKnots::bezier(3), zigzag);
  EXPECT_EQ(convexity(s_curve), Convexity::not_shown);
  // A pentagram turns one way only, and goes round twice.
  Eigen::MatrixXd star(2, 5);
  for (int i = 0; i < 5; ++i) star.col(i) << std::cos(i * 0.8 * std::numbers::pi), std::sin(i * 0.8 * std::numbers::pi);
  EXPECT_FALSE(is_convex(star));
  const Eigen::Matrix<double, 2, 3> back{{0, 2, 1}, {0, 0, 0}};
  EXPECT_FALSE(is_convex(back));
}

/// Theorem 3.6 has no converse: this polygon crosses itself, and that of its Bézier curve is convex.
TEST(Convexity, BezierPolygonMayBeConvexWhereTheControlPolygonIsNot) {
  const SegmentKnots knots({-1.26, -0.81, -0.14}, {1.69, 1.96, 1.99});
  const Eigen::Matrix<double, 2, 4> crossing{{-0.78, 0.1, -0.14, -0.34}, {-0.82, 0.91, -0.73, -0.62}};
  EXPECT_FALSE(is_convex(crossing));
  EXPECT_EQ(convexity(WCurve(knots, crossing)), Convexity::by_bezier);
}

TEST(WCurve, WrongInputIsRefused) {
  const Eigen::MatrixXd three = Eigen::MatrixXd::Random(2, 3);
  EXPECT_THROW(SegmentKnots({0.0, 0.0}, {1.0}), std::invalid_argument);
  EXPECT_THROW(SegmentKnots({0.0, 1.0}, {1.0, 2.0}), std::invalid_argument);
  EXPECT_THROW(SegmentKnots({}, {}), std::invalid_argument);
  EXPECT_THROW(SegmentKnots::bezier(highest_degree + 1), std::invalid_argument);
  EXPECT_THROW(SegmentKnots({0.0, std::nan("")}, {1.0, 1.0}), std::invalid_argument);
  EXPECT_THROW(WCurve(SegmentKnots::bezier(3), three), std::invalid_argument);
  EXPECT_THROW(WCurve(SegmentKnots::bezier(2), three, Eigen::VectorXd{{1, 0, 1}}), std::invalid_argument);
  const WCurve curve(SegmentKnots::bezier(2), three);
  EXPECT_THROW(curve.stepped(2, 0.5), std::invalid_argument);
  EXPECT_THROW(curve.bezier(0.5, 0.5), std::invalid_argument);
  EXPECT_THROW(curve.bezier(0.0, 1.5), std::invalid_argument);
}

}  // namespace
}  // namespace snug::mesh::curves
