// The source's (3.14) to (3.19) and theorems 3.8, 3.9 as mended. Residuals: 1e-12 where exact, 1e-8 where differenced.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mesh/curves/w_curve.hpp"
#include "mesh/curves/w_surface.hpp"
#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh::curves {
namespace {

using testing::difference;
using testing::Random;
using tests::book;

WSurface random_surface(Random& random, int n, int m) {
  const int count = (n + 1) * (m + 1);
  const SegmentKnots u = random.knots(n), v = random.knots(m, false);
  const Eigen::Matrix3Xd points = random.matrix(3, count);
  return {u, v, points, random.weights(count)};
}

TEST(WSurface, StepsEachWayAtItsOwnDegree) {
  Random random(21);
  double worst = 0.0;
  for (int n = 1; n <= 6; ++n)
    for (int m = 1; m <= 6; ++m) {
      const WSurface surface = random_surface(random, n, m);
      const double u = random.between(0.0, 1.0), v = random.between(0.0, 1.0);
      // Curves along v at each i, then the curve along u through their points, all homogeneous.
      const Eigen::MatrixXd points = surface.points(), weights = surface.weights();
      Eigen::MatrixXd rows(3, n + 1);
      Eigen::VectorXd row_weights(n + 1);
      for (int i = 0; i <= n; ++i) {
        const Eigen::MatrixXd w = weights.col(0).segment(i * (m + 1), m + 1);
        rows.col(i) = WCurve(surface.v_knots(), points.middleCols(i * (m + 1), m + 1), w).point(v);
        row_weights[i] = WCurve(surface.v_knots(), w.transpose()).point(v)[0];
      }
      worst = std::max(worst, (surface.point(u, v) - WCurve(surface.u_knots(), rows, row_weights).point(u)).norm());
    }
  book("curves: W surface", "degrees 1 to 6 by 1 to 6: point by rows of curves", worst, 0.0, 1e-12, "(3.14)");
}

TEST(WSurface, DerivativesNormalAndCurvaturesMatchDifferences) {
  Random random(22);
  double first = 0.0, second = 0.0, bend = 0.0;
  for (int n = 2; n <= 6; ++n) {
    const WSurface s = random_surface(random, n, 8 - n);
    const double u = random.between(0.2, 0.8), v = random.between(0.2, 0.8);
    const SurfacePoint p = s.derivatives(u, v);
    const double scale = std::max({1.0, p.x_uu.norm(), p.x_uv.norm(), p.x_vv.norm()});
    first = std::max(first, (p.x_u - difference([&](double t) { return s.point(t, v); }, u)).norm() / scale);
    first = std::max(first, (p.x_v - difference([&](double t) { return s.point(u, t); }, v)).norm() / scale);
    const auto x_u = [&](double t) { return s.derivatives(t, v).x_u; };
    const auto x_u_along_v = [&](double t) { return s.derivatives(u, t).x_u; };
    const auto x_v_along_v = [&](double t) { return s.derivatives(u, t).x_v; };
    second = std::max(second, (p.x_uu - difference(x_u, u)).norm() / scale);
    second = std::max(second, (p.x_uv - difference(x_u_along_v, v)).norm() / scale);
    second = std::max(second, (p.x_vv - difference(x_v_along_v, v)).norm() / scale);
    // Weingarten: the normal's change along u and v has the trace and determinant of the curvatures.
    const Eigen::Vector3d n_u = difference([&](double t) { return s.derivatives(t, v).normal(); }, u);
    const Eigen::Vector3d n_v = difference([&](double t) { return s.derivatives(u, t).normal(); }, v);
    Eigen::Matrix2d form, change;
    form << p.x_u.dot(p.x_u), p.x_u.dot(p.x_v), p.x_v.dot(p.x_u), p.x_v.dot(p.x_v);
    change << -n_u.dot(p.x_u), -n_u.dot(p.x_v), -n_v.dot(p.x_u), -n_v.dot(p.x_v);
    const Eigen::Matrix2d shape = form.inverse() * change;
    const Eigen::Vector2d k = p.curvatures();
    const double size = std::max(1.0, k.cwiseAbs().maxCoeff());
    bend = std::max(bend, std::abs(shape.trace() - k.sum()) / size);
    bend = std::max(bend, std::abs(shape.determinant() - k.prod()) / (size * size));
  }
  book("curves: W surface", "first derivatives against differences", first, 0.0, 1e-8, "fourth-order difference");
  book("curves: W surface", "second derivatives against differences", second, 0.0, 1e-8, "fourth-order difference");
  book("curves: W surface", "mean and Gauss curvature against the normal's differences", bend, 0.0, 1e-8, "Weingarten");
}

TEST(WSurface, IsTheEnvelopeOfItsFamily) {
  Random random(23);
  double touch = 0.0, slopes = 0.0;
  for (int n = 2; n <= 6; ++n)
    for (int m = 2; m <= 6; ++m)
      for (int k = 1; k < n; ++k)
        for (int l = 1; l < m; ++l) {
          const WSurface surface = random_surface(random, n, m);
          const double u = random.between(0.0, 1.0), v = random.between(0.0, 1.0);
          const SurfacePoint whole = surface.derivatives(u, v), member = surface.stepped(k, l, u, v).derivatives(u, v);
          touch = std::max(touch, (member.x - whole.x).norm());
          const double scale = std::max({1.0, whole.x_u.norm(), whole.x_v.norm()});
          slopes = std::max(slopes, (member.x_u - (n - k) / double(n) * whole.x_u).norm() / scale);
          slopes = std::max(slopes, (member.x_v - (m - l) / double(m) * whole.x_v).norm() / scale);
        }
  book("curves: envelope", "surface (3.17), where a member touches: distance", touch, 0.0, 1e-12, "theorem 3.8");
  book("curves: envelope", "its derivatives less (n-k)/n and (m-l)/m of the surface's", slopes, 0.0, 1e-12,
       "theorem 3.8");
}

TEST(WSurface, DualFamilyTouchesWithTheOtherShare) {
  Random random(24);
  const WSurface surface = random_surface(random, 4, 3);
  const double u = 0.4, v = 0.6;
  const SurfacePoint whole = surface.derivatives(u, v);
  const auto eps = [&](double t) { return surface.stepped(1, 2, t, v).point(u, v); };
  const auto eta = [&](double t) { return surface.stepped(1, 2, u, t).point(u, v); };
  EXPECT_LE((difference(eps, u) - 0.25 * whole.x_u).norm(), 1e-8);
  EXPECT_LE((difference(eta, v) - 2.0 / 3.0 * whole.x_v).norm(), 1e-8);
}

TEST(WSurface, EqualsItsRationalBezierSurface) {
  Random random(25);
  double worst = 0.0;
  for (int n = 1; n <= 6; ++n)
    for (int m = 1; m <= 6; ++m) {
      const WSurface surface = random_surface(random, n, m), bezier = surface.bezier();
      const SegmentKnots &ku = surface.u_knots(), &kv = surface.v_knots();
      EXPECT_TRUE((bezier.weights().array() > 0.0).all());
      for (const double s : {0.0, 0.3, 1.0}) {
        const double u = ku.start() + s * (ku.end() - ku.start()), v = kv.end() - s * s * (kv.end() - kv.start());
        worst = std::max(worst, (surface.point(u, v) - bezier.point(u, v)).norm());
      }
      EXPECT_LE((bezier.points().col(m) - surface.point(ku.start(), kv.end())).norm(), 1e-12);
    }
  book("curves: W surface", "as rational Bezier surface: largest distance", worst, 0.0, 1e-12, "theorem 3.9");
}

TEST(WSurface, QuarterCylinderIsExact) {
  const double radius = 0.05, half = std::numbers::sqrt2 / 2.0;
  Eigen::Matrix3Xd points(3, 6);
  points << 1, 1, 1, 1, 0, 0,  //
      0, 0, 1, 1, 1, 1,        //
      0, 2, 0, 2, 0, 2;
  Eigen::VectorXd weights(6);
  weights << 1, 1, half, half, 1, 1;
  const WSurface cylinder(SegmentKnots::bezier(2), SegmentKnots::bezier(1), radius * points, weights);
  double off = 0.0, bend = 0.0, tilt = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const SurfacePoint p = cylinder.derivatives(i / 20.0, 0.3);
    off = std::max(off, std::abs(p.x.head<2>().norm() / radius - 1.0));
    tilt = std::max(tilt, (p.normal().head<2>() - p.x.head<2>() / radius).norm());  // x_u × x_v points outwards
    bend = std::max({bend, std::abs(p.curvatures()[0]) * radius, std::abs(p.curvatures()[1] * radius + 1.0)});
  }
  book("curves: W surface", "quarter cylinder: radius less R, over R", off, 0.0, 4e-16, "cylinder");
  book("curves: W surface", "quarter cylinder: normal less the radial direction", tilt, 0.0, 1e-14, "cylinder");
  book("curves: W surface", "quarter cylinder: curvatures less 0 and 1/R, times R", bend, 0.0, 1e-13, "cylinder");
}

TEST(WSurface, WhereItHasNoTangentPlaneItSaysSo) {
  const WSurface collapsed(SegmentKnots::bezier(1), SegmentKnots::bezier(1),
                           Eigen::Matrix3Xd{{0, 0, 1, 1}, {0, 0, 0, 1}, {0, 0, 0, 0}});
  EXPECT_THROW(collapsed.derivatives(0.0, 0.5).normal(), std::domain_error);
  EXPECT_NO_THROW(collapsed.derivatives(0.5, 0.5).normal());
  EXPECT_THROW(WSurface(SegmentKnots::bezier(1), SegmentKnots::bezier(2), Eigen::Matrix3Xd::Zero(3, 4)),
               std::invalid_argument);
}

}  // namespace
}  // namespace snug::mesh::curves
