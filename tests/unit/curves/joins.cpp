// The source's (3.24) to (3.28) as mended: joins of order mu of two triangles, tangent planes of triangle and
// rectangle.
#include "mesh/curves/joins.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh::curves {
namespace {

using testing::Random;
using tests::book;

Eigen::MatrixXd random_triangle(Random& random, int degree) {
  return random.matrix(3, MultiIndices(3, degree).count());
}

Eigen::Vector3d random_alpha(Random& random) {
  const double third = random.between(-1.5, -0.5), second = random.between(-0.5, 1.0);
  return {1.0 - second - third, second, third};
}

/// The second triangle's derivative of order k across the edge along e3 - e1, at t.
Eigen::VectorXd across(BForm form, const Eigen::Vector3d& direction, int order, double t) {
  for (int k = 0; k < order; ++k) form = form.along(direction);
  return form.value(Eigen::Vector3d(1.0 - t, t, 0.0));
}

TEST(Join, OfTrianglesByEveryOrderIsOnePolynomial) {
  Random random(41);
  double worst = 0.0;
  for (int n = 2; n <= 6; ++n) {
    const Eigen::Vector3d alpha = random_alpha(random);
    const BForm first(3, n, random_triangle(random, n));
    Eigen::MatrixXd b = Eigen::MatrixXd::Zero(3, first.indices().count());
    complete(b, triangle_join(n, alpha, n), first.coefficients());
    const BForm second(3, n, b);
    for (int trial = 0; trial < 40; ++trial) {
      Eigen::VectorXd xi = random.weights(3);
      xi /= xi.sum();
      const Eigen::Vector3d in_first(xi[0] + alpha[0] * xi[2], xi[1] + alpha[1] * xi[2], alpha[2] * xi[2]);
      const Eigen::VectorXd exact = first.value(in_first);
      worst = std::max(worst, (second.value(xi) - exact).norm() / std::max(1.0, exact.norm()));
    }
  }
  book("curves: join", "two triangles, all orders: distance from one polynomial", worst, 0.0, 1e-12, "(3.26) mended");
}

TEST(Join, OfOrderMuKeepsDerivativesUpToMuAndNoFurther) {
  Random random(42);
  double kept = 0.0, next = 1.0;
  for (int n = 3; n <= 6; ++n)
    for (int order = 0; order < n; ++order) {
      const Eigen::Vector3d alpha = random_alpha(random);
      const BForm first(3, n, random_triangle(random, n));
      Eigen::MatrixXd b = random_triangle(random, n);
      complete(b, triangle_join(n, alpha, order), first.coefficients());
      const BForm second(3, n, b);
      // Along e3* - e1 of the second is along alpha - e1 in the first.
      const Eigen::Vector3d out(-1, 0, 1), same(alpha[0] - 1.0, alpha[1], alpha[2]);
      for (int k = 0; k <= order + 1; ++k) {
        const Eigen::VectorXd exact = across(first, same, k, 0.37);
        const double gap = (across(second, out, k, 0.37) - exact).norm() / std::max(1.0, exact.norm());
        k <= order ? kept = std::max(kept, gap) : next = std::min(next, gap);
      }
    }
  book("curves: join", "of order mu: derivatives up to mu across the edge", kept, 0.0, 1e-12, "(3.26) mended");
  EXPECT_GT(next, 1e-3);  // the next one is free
}

TEST(Join, OfTrianglesHasOneTangentPlaneAndAMovedPointIsFound) {
  Random random(43);
  double open = 0.0, least = 1.0;
  for (int n = 2; n <= 6; ++n) {
    const Eigen::Vector3d alpha = random_alpha(random);
    const BForm first(3, n, random_triangle(random, n));
    Eigen::MatrixXd b = random_triangle(random, n);
    complete(b, triangle_join(n, alpha, 1), first.coefficients());
    BForm second(3, n, b);
    const JoinGap gap = join_gap(first, second);
    EXPECT_LE(gap.position, 1e-14);
    open = std::max(open, gap.tangent);
    EXPECT_LE((fitted_alpha(first, second) - alpha).norm(), 1e-12);
    EXPECT_LE(residual(b, triangle_join(n, fitted_alpha(first, second), 1), first.coefficients()), 1e-12);
    second.set(std::array{n - 1, 0, 1},
               second.coefficient(std::array{n - 1, 0, 1}) + Eigen::Vector3d(0.3e-6, 0.6e-6, 0.74e-6));
    least = std::min(least, join_gap(first, second).tangent);
    EXPECT_GT(residual(second.coefficients(), triangle_join(n, fitted_alpha(first, second), 1), first.coefficients()),
              1e-8);
  }
  book("curves: join", "two triangles: tangent-plane gap along the edge", open, 0.0, 1e-14, "(3.24)");
  EXPECT_GT(least, 1e-8) << "a control point moved by 1e-6 is not seen";
}

TEST(Join, OfTriangleAndRectangleHasOneTangentPlaneAndAMovedPointIsFound) {
  Random random(44);
  double open = 0.0, least = 1.0;
  for (int n = 2; n <= 6; ++n) {
    const BForm triangle(3, n, random_triangle(random, n));
    const Eigen::Vector3d alpha = random_alpha(random), beta = random_alpha(random);
    const auto conditions = rectangle_join(n, alpha, beta);
    Eigen::MatrixXd r = random.matrix(3, (n + 1) * (n + 1));
    complete(r, conditions, triangle.coefficients());
    const JoinGap gap = join_gap(triangle, TensorBezier({n, n}, r));
    EXPECT_LE(gap.position, 1e-14);
    open = std::max(open, gap.tangent);
    EXPECT_LE(residual(r, conditions, triangle.coefficients()), 1e-15);
    // (3.27): the outer ones stand where alpha and beta say.
    const auto b = [&](int i, int j, int k) -> Eigen::Vector3d { return triangle.coefficient(std::array{i, j, k}); };
    EXPECT_LE((r.col(1) - alpha[0] * b(n, 0, 0) - alpha[1] * b(n - 1, 1, 0) - alpha[2] * b(n - 1, 0, 1)).norm(), 1e-14);
    EXPECT_LE(
        (r.col(n * (n + 1) + 1) - beta[0] * b(0, n, 0) - beta[1] * b(1, n - 1, 0) - beta[2] * b(0, n - 1, 1)).norm(),
        1e-14);
    r.col((n / 2) * (n + 1) + 1).head<3>() += Eigen::Vector3d(0.3e-6, 0.6e-6, 0.74e-6);
    least = std::min(least, join_gap(triangle, TensorBezier({n, n}, r)).tangent);
    EXPECT_GT(residual(r, conditions, triangle.coefficients()), 0.9e-6);
  }
  book("curves: join", "triangle and rectangle: tangent-plane gap along the edge", open, 0.0, 1e-14, "(3.28) mended");
  EXPECT_GT(least, 1e-8) << "a control point moved by 1e-6 is not seen";
}

TEST(Join, WrongPlacesAreRefused) {
  EXPECT_THROW(triangle_join(3, {0.5, 0.2, 0.3}, 1), std::invalid_argument);   // on the same side
  EXPECT_THROW(triangle_join(3, {1.0, 1.0, -0.5}, 1), std::invalid_argument);  // sum 1.5
  EXPECT_THROW(triangle_join(3, {1.0, 0.5, -0.5}, 4), std::invalid_argument);  // order above the degree
  EXPECT_THROW(rectangle_join(3, {1.0, 0.5, -0.5}, {1, 0, 0}), std::invalid_argument);
}

}  // namespace
}  // namespace snug::mesh::curves
