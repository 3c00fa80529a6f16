#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "mesh/pattern/curve.hpp"
#include "mesh/pattern/interpolating_spline.hpp"

namespace snug::mesh {
namespace {

using Eigen::Vector2d;
using std::numbers::pi;

Curve quarter(double radius) {
  return {{arc_through({radius, 0.0}, radius * Vector2d(std::sqrt(0.5), std::sqrt(0.5)), {0.0, radius})}};
}

/// A curve of every kind, one after the other.
Curve mixed() {
  return {{Line{{0.0, 0.0}, {0.3, 0.1}}, Quadratic{{0.3, 0.1}, {0.4, 0.5}, {0.2, 0.6}},
           Cubic{{0.2, 0.6}, {0.0, 0.8}, {-0.3, 0.3}, {-0.4, 0.9}},
           arc_of_radius({-0.4, 0.9}, {-0.6, 0.5}, 0.3, false, true)}};
}

TEST(PatternCurve, AnArcThroughThreePointsIsTheCirclesWhicheverWayItTurns) {
  EXPECT_NEAR(ArcLength(quarter(0.2)).length(), 0.1 * pi, 1e-15);
  const Curve large{{arc_through({1.0, 0.0}, {-1.0, 0.0}, {0.0, -1.0})}},
      back{{arc_through({0.0, -1.0}, {-1.0, 0.0}, {1.0, 0.0})}};
  EXPECT_NEAR(ArcLength(large).length(), 1.5 * pi, 1e-13);
  EXPECT_NEAR(ArcLength(back).length(), 1.5 * pi, 1e-13);
  EXPECT_NEAR(swept_area(large), 0.75 * pi, 1e-13);
  EXPECT_NEAR(swept_area(back), -0.75 * pi, 1e-13);
  EXPECT_TRUE(std::holds_alternative<Line>(arc_through({0.0, 0.0}, {1.0, 1.0}, {2.0, 2.0})));
}

/// The four arcs of one radius over one chord: small and large, to either side.
TEST(PatternCurve, AnArcOfARadiusTurnsAsItIsTold) {
  const Vector2d a(0.0, 0.0), b(1.0, 0.0);
  const double radius = 1.0, small = pi / 3.0;
  for (const bool large : {false, true})
    for (const bool left : {false, true}) {
      const Curve curve{{arc_of_radius(a, b, radius, large, left)}};
      EXPECT_NEAR(ArcLength(curve).length(), large ? 2.0 * pi - small : small, 1e-13);
      EXPECT_LT((curve.begin() - a).norm() + (curve.end() - b).norm(), 1e-15);
      EXPECT_EQ(at(curve.spans[0], 0.5).y() < 0.0, left);  // turning left it bulges to the right, which is down
    }
}

/// Perimeter of the ellipse with half-axes 2 and 1: 4 a E(e), 9.688448220547675 (Abramowitz and Stegun 17.3, to 15
/// digits).
TEST(PatternCurve, ACircleThatIsStretchedIsAnEllipse) {
  Eigen::Affine2d map = Eigen::Affine2d::Identity();
  map.linear() = Vector2d(2.0, 1.0).asDiagonal();
  EXPECT_NEAR(4.0 * ArcLength(mapped(quarter(1.0), map)).length(), 9.688448220547675, 1e-12);
}

TEST(PatternCurve, EqualSharesHaveEqualLengths) {
  const Curve curve = mixed();
  const ArcLength along(curve);
  for (const double share : {0.0, 0.11, 0.37, 0.5, 0.83, 1.0}) {
    EXPECT_NEAR(ArcLength(along.between(0.0, share)).length(), share * along.length(), 1e-12);
    EXPECT_NEAR(ArcLength(along.between(share, 1.0)).length(), (1.0 - share) * along.length(), 1e-12);
    EXPECT_NEAR(along.nearest(along.at(share)), share, 1e-6);
    EXPECT_LT((ArcLength(reversed(curve)).at(1.0 - share) - along.at(share)).norm(), 1e-12);
  }
}

TEST(PatternCurve, AStretchIsTheSameCurve) {
  const ArcLength along(mixed());
  const Curve part = along.between(0.2, 0.7);
  EXPECT_LT((part.begin() - along.at(0.2)).norm() + (part.end() - along.at(0.7)).norm(), 1e-14);
  const ArcLength inner(part);
  for (const double share : {0.1, 0.5, 0.9}) EXPECT_LT((inner.at(share) - along.at(0.2 + 0.5 * share)).norm(), 1e-12);
}

/// A cusp stops the derivative, not the length: the semicubical parabola (t^2, t^3) from -1 to 1 is 2 (13 sqrt(13) - 8)
/// / 27 long.
TEST(PatternCurve, ACuspIsMeasuredAndPassed) {
  const Curve cusp{{Cubic{{1.0, -1.0}, {-1.0 / 3.0, 1.0}, {-1.0 / 3.0, -1.0}, {1.0, 1.0}}}};
  const ArcLength along(cusp);
  EXPECT_NEAR(along.length(), 2.0 * (13.0 * std::sqrt(13.0) - 8.0) / 27.0, 1e-4);
  EXPECT_LT(along.at(0.5).norm(), 1e-3);
}

TEST(PatternCurve, BezierCurvesForAnArcAreOffByATenMillionth) {
  const Curve arc{{arc_through({1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0})}};
  double off = 0.0;
  for (const Span& span : without_arcs(arc))
    for (int n = 0; n <= 20; ++n) off = std::max(off, std::abs(at(span, n / 20.0).norm() - 1.0));
  EXPECT_LT(off, 1e-7);
  EXPECT_GT(off, 1e-9);  // it is an approximation, and measured
}

std::vector<Vector2d> on_a_wave(int intervals) {
  std::vector<Vector2d> points;
  for (int n = 0; n <= intervals; ++n)
    points.emplace_back(static_cast<double>(n) / intervals, std::sin(3.0 * n / intervals) / 3.0);
  return points;
}

/// In the middle, where the missing curvature of the ends has died away.
double error(Curve (*spline)(const std::vector<Vector2d>&), int intervals) {
  double worst = 0.0;
  for (const Vector2d& p : flattened(spline(on_a_wave(intervals)), 1e-12))
    if (p.x() > 0.4 && p.x() < 0.6) worst = std::max(worst, std::abs(p.y() - std::sin(3.0 * p.x()) / 3.0));
  return worst;
}

TEST(PatternCurve, SplinesPassThroughTheirPointsWithoutAKink) {
  for (const auto spline : {&cubic_spline, &quadratic_spline}) {
    const auto points = on_a_wave(7);
    const Curve curve = spline(points);
    EXPECT_LT((curve.begin() - points.front()).norm() + (curve.end() - points.back()).norm(), 1e-15);
    const ArcLength along(curve);
    for (const Vector2d& p : points) EXPECT_LT((along.at(along.nearest(p)) - p).norm(), 1e-8);
    for (std::size_t s = 1; s < curve.spans.size(); ++s) {
      EXPECT_LT((at(curve.spans[s - 1], 1.0) - at(curve.spans[s], 0.0)).norm(), 1e-15);
      const Vector2d in = derivative(curve.spans[s - 1], 1.0).normalized(),
                     out = derivative(curve.spans[s], 0.0).normalized();
      EXPECT_LT((in - out).norm(), 1e-12);
    }
  }
}

TEST(PatternCurve, TheCubicSplineIsOfFourthOrderAndTheQuadraticOneOfThird) {
  EXPECT_NEAR(std::log2(error(&cubic_spline, 16) / error(&cubic_spline, 32)), 4.0, 0.5);
  EXPECT_NEAR(std::log2(error(&quadratic_spline, 16) / error(&quadratic_spline, 32)), 3.0, 0.5);
}

TEST(PatternCurve, ChordsStayWithinTheirTolerance) {
  const Curve curve = mixed();
  const auto points = flattened(curve, 1e-5);
  const ArcLength along(curve);
  double worst = 0.0;
  for (std::size_t n = 1; n < points.size(); ++n) {
    const Vector2d middle = 0.5 * (points[n - 1] + points[n]);
    worst = std::max(worst, (along.at(along.nearest(middle)) - middle).norm());
  }
  EXPECT_LT(worst, 1.1e-5);
}

}  // namespace
}  // namespace snug::mesh
