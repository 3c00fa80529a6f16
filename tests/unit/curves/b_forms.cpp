// The source's definition 3.5, lemmas 3.2, 3.3, theorems 3.10, 3.11 and propositions 3.1, 3.2 as mended.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "mesh/curves/binomial.hpp"
#include "mesh/curves/composition.hpp"
#include "mesh/curves/w_surface.hpp"
#include "tests/unit/curves/random_curves.hpp"
#include "tests/verification/book.hpp"

namespace snug::mesh::curves {
namespace {

using testing::Random;
using tests::book;

BForm random_form(Random& random, int corners, int degree, int dimension = 3) {
  return {corners, degree, random.matrix(dimension, MultiIndices(corners, degree).count())};
}

TensorBezier random_tensor(Random& random, std::vector<int> degrees, int dimension = 3) {
  int count = 1;
  for (const int degree : degrees) count *= degree + 1;
  return {degrees, random.matrix(dimension, count)};
}

Eigen::VectorXd random_coordinates(Random& random, int corners) {
  Eigen::VectorXd xi = random.weights(corners);
  return xi / xi.sum();
}

TEST(MultiIndices, StandWhereTheirNumberSays) {
  for (int corners = 1; corners <= 8; ++corners)
    for (int degree = 0; degree <= 5; ++degree) {
      const MultiIndices all(corners, degree);
      EXPECT_EQ(all.count(), binomial(degree + corners - 1, degree));
      double sum = 0.0;
      for (int a = 0; a < all.count(); ++a) {
        EXPECT_EQ(all.position(all[a]), a);
        double expected = factorial(degree);
        for (const int part : all[a]) expected /= factorial(part);
        EXPECT_NEAR(all.multinomial(a), expected, 1e-9);
        sum += all.multinomial(a);
      }
      EXPECT_EQ(sum, std::pow(corners, degree));  // (1 + … + 1)^n
    }
  EXPECT_THROW(MultiIndices(0, 1), std::invalid_argument);
  EXPECT_THROW(MultiIndices(3, -1), std::invalid_argument);
  EXPECT_THROW(MultiIndices(16, 40), std::invalid_argument);
}

TEST(MultiIndices, SumsOverAClassAreProductsOfBinomials) {
  for (const auto& [variables, degree] : {std::pair{2, 6}, {2, 5}, {3, 3}, {3, 4}, {4, 2}}) {
    const MultiIndices all(1 << variables, degree);
    TensorBezier sums(std::vector<int>(variables, degree),
                      Eigen::MatrixXd::Zero(1, static_cast<int>(std::pow(degree + 1, variables))));
    Eigen::VectorXd total = Eigen::VectorXd::Zero(sums.count());
    for (int i = 0; i < all.count(); ++i) total[sums.position(tensor_index(all[i]))] += all.multinomial(i);
    for (int k = 0; k < sums.count(); ++k) EXPECT_EQ(total[k], sums.multinomial(k)) << "(3.20), (3.21)";
  }
}

TEST(BForm, ValueIsTheSumOfItsTerms) {
  Random random(31);
  double value = 0.0, slope = 0.0, raise = 0.0;
  for (int corners = 2; corners <= 6; ++corners)
    for (int degree = 1; degree <= 5; ++degree) {
      const BForm form = random_form(random, corners, degree);
      const Eigen::VectorXd xi = random_coordinates(random, corners);
      const auto sum = [&](const Eigen::VectorXd& at) {
        Eigen::VectorXd total = Eigen::VectorXd::Zero(3);
        for (int a = 0; a < form.indices().count(); ++a) {
          double term = form.indices().multinomial(a);
          for (int j = 0; j < corners; ++j) term *= std::pow(at[j], form.indices()[a][j]);
          total += term * form.coefficients().col(a);
        }
        return total;
      };
      value = std::max(value, (form.value(xi) - sum(xi)).norm());
      raise = std::max(raise, (form.raised().value(xi) - sum(xi)).norm());
      const Eigen::VectorXd d = random_coordinates(random, corners) - random_coordinates(random, corners);
      const auto along = [&](double t) -> Eigen::VectorXd { return sum(xi + t * d); };
      slope = std::max(slope, (form.along(d).value(xi) - testing::difference(along, 0.0)).norm());
    }
  book("curves: B-form", "value by steps less the sum of its terms", value, 0.0, 1e-12, "definition 3.5");
  book("curves: B-form", "raised by one degree: difference", raise, 0.0, 1e-12, "definition 3.5");
  book("curves: B-form", "derivative along a direction against differences", slope, 0.0, 1e-8,
       "fourth-order difference");
}

TEST(BForm, OfATensorProductEqualsItOnTheManifold) {
  Random random(32);
  double worst = 0.0, back = 0.0;
  for (const std::vector<int>& degrees :
       {std::vector{4}, {2, 2}, {5, 5}, {3, 2}, {1, 6}, {3, 3, 3}, {2, 1, 3}, {2, 2, 2, 2}}) {
    const TensorBezier bezier = random_tensor(random, degrees);
    const BForm form = b_form_of(bezier);
    EXPECT_EQ(form.degree(), *std::max_element(degrees.begin(), degrees.end()));
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::VectorXd t = (random.matrix(bezier.variables(), 1).array() + 1.0) / 2.0;
      worst = std::max(worst, (form.value(tensor_coordinates(t)) - bezier.value(t)).norm());
    }
    back = std::max(back, (tensor_of(form).coefficients() - bezier.raised(tensor_of(form).degrees()).coefficients())
                              .cwiseAbs()
                              .maxCoeff());
  }
  book("curves: B-form", "of tensor products of 1 to 4 variables: largest distance", worst, 0.0, 1e-12,
       "theorems 3.10, 3.11");
  book("curves: B-form", "and back: control points", back, 0.0, 1e-12, "(3.22)");
}

TEST(BForm, AnyOnFourCornersIsATensorProductOnTheManifold) {
  Random random(33);
  double worst = 0.0;
  for (const auto& [corners, degree] : {std::pair{4, 1}, {4, 4}, {4, 6}, {8, 3}}) {
    const BForm form = random_form(random, corners, degree);  // not constant on the classes
    const TensorBezier bezier = tensor_of(form);
    for (int trial = 0; trial < 20; ++trial) {
      const Eigen::VectorXd t = (random.matrix(bezier.variables(), 1).array() + 1.0) / 2.0;
      worst = std::max(worst, (form.value(tensor_coordinates(t)) - bezier.value(t)).norm());
    }
  }
  book("curves: B-form", "any of 4 or 8 corners as tensor product: largest distance", worst, 0.0, 1e-12, "(3.22)");
  EXPECT_THROW(tensor_of(random_form(random, 6, 2)), std::invalid_argument);
}

TEST(BForm, RationalSurfaceGoesThereAndBack) {
  Random random(34);
  double worst = 0.0;
  for (int n = 2; n <= 6; ++n) {
    const SegmentKnots u = random.knots(n), v = random.knots(n);
    const Eigen::Matrix3Xd points = random.matrix(3, (n + 1) * (n + 1));
    const WSurface surface(u, v, points, random.weights((n + 1) * (n + 1)));
    // W -> Bézier -> B-form (homogeneous) -> Bézier -> W. R_k has k steps at t = 1, which is our u at its end.
    const WSurface bezier = surface.bezier();
    Eigen::MatrixXd homogeneous(4, bezier.weights().size());
    homogeneous << bezier.points() * bezier.weights().asDiagonal(), bezier.weights().transpose();
    const TensorBezier tensor = tensor_of(b_form_of(TensorBezier({n, n}, homogeneous)));
    const Eigen::VectorXd w = tensor.coefficients().row(3);
    const Eigen::Matrix3Xd p = tensor.coefficients().topRows(3) * w.cwiseInverse().asDiagonal();
    const WSurface back = WSurface(bezier.u_knots(), bezier.v_knots(), p, w).with_knots(u, v);
    worst = std::max(worst, (back.points() - surface.points()).cwiseAbs().maxCoeff());
    worst = std::max(worst, (back.weights() - surface.weights()).cwiseAbs().maxCoeff());
  }
  book("curves: round trips", "W surface to Bezier to B-form and back: points and weights", worst, 0.0, 1e-12,
       "itself");
}

/// A triangle's curved region inside the simplex: barycentric coordinates of degree m in those of the triangle.
BForm region_on_triangle(Random& random, int corners, int degree) {
  BForm region = random_form(random, 3, degree, corners);
  Eigen::MatrixXd xi = region.coefficients();
  xi.bottomRows(1) = Eigen::RowVectorXd::Ones(xi.cols()) - xi.topRows(corners - 1).colwise().sum();
  return {3, degree, xi};
}

TEST(Composition, DegreesMultiplyOnATriangle) {
  Random random(35);
  double worst = 0.0;
  for (const auto& [corners, n, m] : {std::array{3, 2, 3}, {4, 3, 2}, {4, 2, 4}, {6, 2, 2}, {3, 6, 1}, {4, 1, 5}}) {
    const BForm form = random_form(random, corners, n), region = region_on_triangle(random, corners, m),
                both = composed(form, region);
    EXPECT_EQ(both.degree(), n * m);
    const int enough = (n * m + 1) * (n * m + 2) / 2 + 1;  // two polynomials of this degree that agree there are one
    for (int trial = 0; trial < enough; ++trial) {
      const Eigen::VectorXd sigma = random_coordinates(random, 3), exact = form.value(region.value(sigma));
      worst = std::max(worst, (both.value(sigma) - exact).norm() / std::max(1.0, exact.norm()));
    }
  }
  book("curves: composition", "B-form on a Bezier triangle, degrees multiplied: largest distance", worst, 0.0, 1e-12,
       "proposition 3.1");
}

TEST(Composition, DegreesMultiplyOnATensorProduct) {
  Random random(36);
  double worst = 0.0;
  for (const auto& [n, m] : {std::pair{2, 2}, {3, 2}, {2, 3}, {4, 1}}) {
    const BForm form = random_form(random, 4, n);
    TensorBezier region = random_tensor(random, {m, m}, 4);
    Eigen::MatrixXd xi = region.coefficients();
    xi.row(3) = Eigen::RowVectorXd::Ones(xi.cols()) - xi.topRows(3).colwise().sum();
    region = TensorBezier({m, m}, xi);
    const TensorBezier both = composed(form, region);
    EXPECT_EQ(both.degrees(), (std::vector{n * m, n * m}));
    for (int trial = 0; trial <= (n * m + 1) * (n * m + 1); ++trial) {
      const Eigen::VectorXd t = (random.matrix(2, 1).array() + 1.0) / 2.0, exact = form.value(region.value(t));
      worst = std::max(worst, (both.value(t) - exact).norm() / std::max(1.0, exact.norm()));
    }
  }
  book("curves: composition", "B-form on a tensor-product Bezier, degrees multiplied: largest distance", worst, 0.0,
       1e-12, "proposition 3.2");
  EXPECT_THROW(composed(random_form(random, 4, 2), random_tensor(random, {1, 1}, 3)), std::invalid_argument);
}

/// Corners of the tetrahedron: the section is flat, parallel to u1u3 and u2u4, and its corners halve the other four
/// edges.
TEST(Region, ParallelogramIsTheSectionParallelToTwoEdges) {
  Random random(37);
  const Eigen::Matrix<double, 3, 4> u = random.matrix(3, 4);
  const TensorBezier section = parallelogram_section();
  const auto at = [&](double s, double t) -> Eigen::Vector3d { return u * section.value(Eigen::VectorXd{{s, t}}); };
  EXPECT_LE((at(1, 1) - (u.col(0) + u.col(1)) / 2).norm(), 1e-15);
  EXPECT_LE((at(0, 0) - (u.col(2) + u.col(3)) / 2).norm(), 1e-15);
  EXPECT_LE((at(1, 0) - (u.col(0) + u.col(3)) / 2).norm(), 1e-15);
  EXPECT_LE((at(1, 0.3) - at(0, 0.3) - (u.col(0) - u.col(2)) / 2).norm(), 1e-15);
  EXPECT_LE((at(0.4, 1) - at(0.4, 0) - (u.col(1) - u.col(3)) / 2).norm(), 1e-15);
  const Eigen::VectorXd xi = section.value(Eigen::Vector2d(0.2, 0.7));
  EXPECT_NEAR(xi[0] + xi[2], 0.5, 1e-15);
  EXPECT_NEAR(xi.sum(), 1.0, 1e-15);  // and not 1/2, as in print
  const BForm form = random_form(random, 4, 3);
  const TensorBezier surface = composed(form, section);
  EXPECT_LE((surface.value(Eigen::Vector2d(0.2, 0.7)) - form.value(xi)).norm(), 1e-14);
}

TEST(Region, RegularPolygonsHaveCoordinatesInTheirSimplex) {
  Random random(38);
  for (const int corners : {3, 4, 5, 6, 8}) {
    Eigen::Matrix2Xd v(2, corners);
    for (int j = 0; j < corners; ++j)
      v.col(j) << std::cos(2 * std::numbers::pi * j / corners), std::sin(2 * std::numbers::pi * j / corners);
    for (int trial = 0; trial < 50; ++trial) {
      const Eigen::Vector2d inside = v * random_coordinates(random, corners);
      const Eigen::VectorXd xi = polygon_coordinates(corners, inside);
      EXPECT_NEAR(xi.sum(), 1.0, 1e-14);
      EXPECT_GE(xi.minCoeff(), 0.0);
      EXPECT_LE((v * xi - inside).norm(), 1e-13);
    }
    const Eigen::Vector2d on_edge = 0.3 * v.col(1) + 0.7 * v.col(2);
    const Eigen::VectorXd xi = polygon_coordinates(corners, on_edge);
    EXPECT_NEAR(xi[1], 0.3, 1e-14);
    EXPECT_NEAR(xi[2], 0.7, 1e-14);
  }
}

TEST(Region, SquareIsTheManifoldOfTheTensorProduct) {
  Random random(39);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector2d p(random.between(-0.4, 0.4), random.between(-0.4, 0.4));
    const Eigen::VectorXd xi = polygon_coordinates(4, p);
    EXPECT_NEAR(xi[0] * xi[2], xi[1] * xi[3], 1e-15);  // corners in turn: opposite ones are 0, 2 and 1, 3
    const double s = xi[0] + xi[1], t = xi[0] + xi[3];
    const Eigen::VectorXd tensor = tensor_coordinates(Eigen::Vector2d(s, t));
    EXPECT_LE((tensor - Eigen::Vector4d(xi[0], xi[1], xi[3], xi[2])).norm(), 1e-14);
  }
}

}  // namespace
}  // namespace snug::mesh::curves
