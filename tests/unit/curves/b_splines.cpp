// B-splines of many segments against GSL's, and their segments as W curves.
#include "mesh/curves/b_spline.hpp"

#include <gsl/gsl_bspline.h>
#include <gsl/gsl_vector.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh::curves {
namespace {

using testing::Random;
using tests::book;

/// Random knots, some of them double, the ends clamped or not.
std::vector<double> random_knots(Random& random, int degree, int spans, bool clamped) {
  std::vector<double> inner(spans - 1);
  for (double& knot : inner) knot = random.between(0.1, 0.9);
  if (spans > 3 && degree > 1) inner[1] = inner[0];
  std::sort(inner.begin(), inner.end());
  std::vector<double> knots = {0.0};
  for (int k = 0; k < degree; ++k) knots.push_back(clamped ? 0.0 : -random.between(0.1, 1.0));
  std::sort(knots.begin(), knots.end());
  knots.insert(knots.end(), inner.begin(), inner.end());
  std::vector<double> end = {1.0};
  for (int k = 0; k < degree; ++k) end.push_back(clamped ? 1.0 : 1.0 + random.between(0.1, 1.0));
  std::sort(end.begin(), end.end());
  knots.insert(knots.end(), end.begin(), end.end());
  return knots;
}

BSplineCurve random_spline(Random& random, int degree, int spans, bool clamped, int dimension = 3) {
  BSplineCurve curve{degree, random_knots(random, degree, spans, clamped), {}, {}};
  const int count = static_cast<int>(curve.knots.size()) - degree - 1;
  curve.points = random.matrix(dimension, count);
  curve.weights = random.weights(count);
  EXPECT_EQ(curve.fault(), "");
  return curve;
}

BSplineSurface random_surface(Random& random, int p, int q, bool clamped) {
  BSplineSurface surface{{p, q}, {random_knots(random, p, 4, clamped), random_knots(random, q, 3, clamped)}, {}, {}};
  surface.points = random.matrix(3, surface.rows() * surface.columns());
  surface.weights = random.weights(surface.rows() * surface.columns());
  EXPECT_EQ(surface.fault(), "");
  return surface;
}

TEST(BSpline, EqualsThatOfGsl) {
  Random random(61);
  double worst = 0.0;
  for (int degree = 2; degree <= 6; ++degree) {
    std::vector<double> breaks = {0.0, 0.13, random.between(0.2, 0.4), random.between(0.5, 0.8), 1.0};
    gsl_bspline_workspace* workspace = gsl_bspline_alloc(degree + 1, breaks.size());
    const gsl_vector_view view = gsl_vector_view_array(breaks.data(), breaks.size());
    gsl_bspline_knots(&view.vector, workspace);
    const int count = static_cast<int>(gsl_bspline_ncoeffs(workspace));
    const double* knots = workspace->knots->data;
    const BSplineCurve curve{
        degree, {knots, knots + workspace->knots->size}, random.matrix(3, count), Eigen::VectorXd::Ones(count)};
    Eigen::VectorXd bases(count);
    gsl_vector_view into = gsl_vector_view_array(bases.data(), count);
    for (int trial = 0; trial <= 100; ++trial) {
      gsl_bspline_eval(trial / 100.0, &into.vector, workspace);
      worst = std::max(worst, (curve.point(trial / 100.0) - curve.points * bases).norm());
    }
    gsl_bspline_free(workspace);
  }
  book("curves: B-spline", "curves of several segments, degrees 2 to 6: largest distance from GSL's", worst, 0.0, 1e-14,
       "GSL");
}

TEST(BSpline, KeepsItsShapeWhenItsEndsAreClamped) {
  Random random(62);
  double curves = 0.0, surfaces = 0.0;
  for (int degree = 1; degree <= 6; ++degree) {
    const BSplineCurve curve = random_spline(random, degree, 5, false), clamped = curve.clamped();
    EXPECT_EQ(clamped.fault(), "");
    EXPECT_LE((clamped.points.col(0) - curve.point(0.0)).norm(), 1e-12);
    const BSplineSurface surface = random_surface(random, degree, 7 - degree, false), whole = surface.clamped();
    EXPECT_EQ(whole.fault(), "");
    EXPECT_LE((whole.points.rightCols(1) - surface.point(1.0, 1.0)).norm(), 1e-12);
    for (const double t : {0.0, 0.11, 0.35, 0.62, 0.87, 1.0}) {
      curves = std::max(curves, (curve.point(t) - clamped.point(t)).norm());
      surfaces = std::max(surfaces, (surface.point(t, 1 - t * t) - whole.point(t, 1 - t * t)).norm());
    }
  }
  book("curves: B-spline", "curves with clamped ends: largest distance", curves, 0.0, 1e-12, "knot insertion");
  book("curves: B-spline", "surfaces with clamped ends: largest distance", surfaces, 0.0, 1e-12, "knot insertion");
}

TEST(BSpline, SegmentsAndPatchesAreTheWholeInOrder) {
  Random random(63);
  const BSplineCurve curve = random_spline(random, 3, 5, false);
  double at = curve.start();
  for (const WCurve& segment : curve.segments()) {
    EXPECT_EQ(segment.knots().start(), at);
    at = segment.knots().end();
    const double middle = 0.5 * (segment.knots().start() + at);
    EXPECT_EQ(segment.point(middle), curve.point(middle));
  }
  EXPECT_EQ(at, curve.end());
  const BSplineSurface surface = random_surface(random, 2, 3, true);
  const auto patches = surface.patches();
  EXPECT_EQ(patches.size(), 9u);  // 3 spans by 3: one of four is empty
  for (const WSurface& patch : patches) {
    const double u = 0.5 * (patch.u_knots().start() + patch.u_knots().end()),
                 v = 0.5 * (patch.v_knots().start() + patch.v_knots().end());
    EXPECT_EQ(patch.point(u, v), surface.point(u, v));
  }
}

TEST(BSpline, OfAWCurveIsIt) {
  Random random(64);
  for (const bool sorted : {true, false}) {
    const WCurve curve = random.curve(4, 3, sorted);
    const BSplineCurve spline = b_spline_of(curve);
    EXPECT_EQ(spline.fault(), "");
    EXPECT_LE((spline.point(0.4) - curve.point(0.4)).norm(), 1e-13);
    if (sorted) {
      EXPECT_EQ(spline.points, curve.points());
    }
    const WSurface surface(random.knots(3, sorted), random.knots(2), random.matrix(3, 12), random.weights(12));
    EXPECT_EQ(b_spline_of(surface).fault(), "");
    EXPECT_LE((b_spline_of(surface).point(0.4, 0.3) - surface.point(0.4, 0.3)).norm(), 1e-13);
  }
}

TEST(BSpline, FaultsAreNamed) {
  Random random(65);
  const BSplineCurve good = random_spline(random, 3, 5, true);
  const auto fault = [&](auto change) {
    BSplineCurve curve = good;
    change(curve);
    return curve.fault();
  };
  EXPECT_NE(fault([](BSplineCurve& c) { c.degree = 0; }).find("degree 0"), std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { c.knots.resize(4); }).find("4 knots"), std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { std::swap(c.knots[3], c.knots[4]); }).find("never fall"), std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { c.points.conservativeResize(3, 4); }).find("4 points"), std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { c.weights[1] = 0.0; }).find("weight"), std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { c.points(0, 0) = std::nan(""); }).find("finite"), std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { c.knots[5] = c.knots[6] = c.knots[7] = c.knots[4]; }).find("more than 3"),
            std::string::npos);
  EXPECT_NE(fault([](BSplineCurve& c) { std::fill(c.knots.begin(), c.knots.end(), 1.0); }).find("no span"),
            std::string::npos);
}

}  // namespace
}  // namespace snug::mesh::curves
