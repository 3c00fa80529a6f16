// The elements and rules that the rooms take from deal.II, against formulas.
#include "solver/fem/element.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/fem/plane_shape.hpp"

namespace snug::tests {
namespace {

using fem::Domain, fem::Element;

constexpr std::array every_element = {Element::line2, Element::line3, Element::tri3,  Element::tri6, Element::quad4,
                                      Element::quad9, Element::tet4,  Element::tet10, Element::hex8, Element::hex27};

bool simplex(Domain domain) { return domain == Domain::triangle || domain == Domain::tetrahedron; }

/// A few points inside the domain (and all of the simplices).
fem::Points inside(Element element) {
  fem::Points points(3, 4);
  points << 0.21, 0.07, 0.52, 0.11,  //
      0.34, 0.61, 0.13, 0.29,        //
      0.17, 0.23, 0.31, 0.05;
  return points.topRows(fem::dimension(fem::domain(element)));
}

TEST(Element, EachFunctionIsOneAtItsNodeAndZeroAtTheOthers) {
  for (const Element element : every_element) {
    const fem::Points nodes = fem::reference_nodes(element);
    ASSERT_EQ(nodes.cols(), fem::node_count(element));
    const Eigen::MatrixXd values = fem::tabulate(element, nodes).values;
    EXPECT_LE((values - Eigen::MatrixXd::Identity(nodes.cols(), nodes.cols())).cwiseAbs().maxCoeff(), 1e-14)
        << static_cast<int>(element);
  }
}

TEST(Element, FunctionsSumToOneAndTheirDerivativesToNothing) {
  for (const Element element : every_element) {
    const fem::Table at = fem::tabulate(element, inside(element));
    for (std::size_t q = 0; q < at.gradients.size(); ++q) {
      EXPECT_NEAR(at.values.col(q).sum(), 1.0, 1e-14);
      EXPECT_LE(at.gradients[q].colwise().sum().norm(), 1e-13);
      EXPECT_LE(at.hessians[q].colwise().sum().norm(), 1e-12);
    }
  }
}

TEST(Element, NodesOfTheDomainsStandInOurOrder) {
  EXPECT_EQ(fem::reference_nodes(Element::quad9).col(5), Eigen::Vector2d(1.0, 0.0));
  EXPECT_EQ(fem::reference_nodes(Element::hex27).col(9 * 2 + 3 * 1 + 0), Eigen::Vector3d(0.0, 0.5, 1.0));
  EXPECT_EQ(fem::reference_nodes(Element::hex8).col(6), Eigen::Vector3d(0.0, 1.0, 1.0));
  EXPECT_EQ(fem::reference_nodes(Element::tri6).col(4), Eigen::Vector2d(0.5, 0.5));
  EXPECT_EQ(fem::reference_nodes(Element::tet10).col(6), Eigen::Vector3d(0.0, 0.5, 0.0));  // between vertices 2 and 0
  EXPECT_EQ(fem::reference_nodes(Element::tet10).col(8), Eigen::Vector3d(0.5, 0.0, 0.5));  // between 1 and 3
}

/// Interpolates a polynomial that the element holds; what its derivatives are is written out here.
struct Quadratic {
  static double value(double x, double y, double z) { return 2 - 3 * x + 5 * y + 7 * z + 1.5 * x * x - y * y + 4 * z * z + 6 * x * y - 2 * y * z + 9 * x * z; }
  static Eigen::Vector3d gradient(double x, double y, double z) {
    return {-3 + 3 * x + 6 * y + 9 * z, 5 - 2 * y + 6 * x - 2 * z, 7 + 8 * z - 2 * y + 9 * x};
  }
  static constexpr std::array<double, 6> hessian = {3, -2, 8, 6, -2, 9};  // 11, 22, 33, 12, 23, 13
};

TEST(Element, DerivativesAreThoseOfAQuadraticThatIsWrittenOut) {
  for (const Element element : {Element::line3, Element::tri6, Element::quad9, Element::tet10, Element::hex27}) {
    const int dim = fem::dimension(fem::domain(element));
    const auto place = [&](const fem::Points& points, Eigen::Index q) {
      Eigen::Vector3d x = Eigen::Vector3d::Zero();
      for (int d = 0; d < dim; ++d) x[d] = points(d, q);
      return x;
    };
    const fem::Points nodes = fem::reference_nodes(element), points = inside(element);
    Eigen::VectorXd nodal(nodes.cols());
    for (Eigen::Index a = 0; a < nodes.cols(); ++a) {
      const Eigen::Vector3d x = place(nodes, a);
      nodal[a] = Quadratic::value(x[0], x[1], x[2]);
    }
    const fem::Table table = fem::tabulate(element, points);
    for (Eigen::Index q = 0; q < points.cols(); ++q) {
      const Eigen::Vector3d x = place(points, q);
      EXPECT_NEAR(table.values.col(q).dot(nodal), Quadratic::value(x[0], x[1], x[2]), 1e-13);
      EXPECT_LE((table.gradients[q].transpose() * nodal - Quadratic::gradient(x[0], x[1], x[2]).head(dim)).norm(), 1e-12);
      const Eigen::VectorXd second = table.hessians[q].transpose() * nodal;
      const std::vector<int> components = dim == 1 ? std::vector{0} : dim == 2 ? std::vector{0, 1, 3} : std::vector{0, 1, 2, 3, 4, 5};
      ASSERT_EQ(second.size(), static_cast<Eigen::Index>(components.size()));
      for (std::size_t k = 0; k < components.size(); ++k) EXPECT_NEAR(second[k], Quadratic::hessian[components[k]], 1e-11);
    }
  }
}

TEST(Element, ADifferenceQuotientComesToTheGradientAndHessianWithTheSquareOfTheStep) {
  // hex27 holds x2 y2 z2, whose central differences are not exact: the error falls fourfold when the step is halved.
  const Element element = Element::hex27;
  const Eigen::Vector3d x(0.21, 0.34, 0.17);
  const auto at = [&](const Eigen::Vector3d& place) { return fem::tabulate(element, place); };
  const fem::Table exact = at(x);
  const auto error = [&](double h) {
    Eigen::Vector2d worst = Eigen::Vector2d::Zero();
    constexpr std::array<std::array<int, 3>, 3> column = {{{0, 3, 5}, {3, 1, 4}, {5, 4, 2}}};
    for (int d = 0; d < 3; ++d) {
      const Eigen::Vector3d step = h * (Eigen::Vector3d::Unit(d) + 0.5 * Eigen::Vector3d::Unit((d + 1) % 3));
      const fem::Table up = at(x + step), down = at(x - step);
      const Eigen::VectorXd slope = (up.values - down.values) / (2 * h);
      worst[0] = std::max(worst[0], (slope - exact.gradients[0] * step / h).norm());
      for (int e = 0; e < 3; ++e) {
        Eigen::VectorXd second = Eigen::VectorXd::Zero(27);
        for (int k = 0; k < 3; ++k) second += exact.hessians[0].col(column[e][k]) * step[k] / h;
        worst[1] = std::max(worst[1], ((up.gradients[0] - down.gradients[0]).col(e) / (2 * h) - second).norm());
      }
    }
    return worst;
  };
  const Eigen::Vector2d coarse = error(1e-2), fine = error(5e-3);
  EXPECT_NEAR(coarse[0] / fine[0], 4.0, 0.05);
  EXPECT_NEAR(coarse[1] / fine[1], 4.0, 0.05);
}

template <Element element>
void expect_like_the_table() {
  const fem::Points points = inside(element);
  const fem::Table table = fem::tabulate(element, points);
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const auto shape = fem::plane_shape<element>(points.col(q));
    EXPECT_LE((shape.N - table.values.col(q)).norm(), 1e-14);
    EXPECT_LE((fem::plane_values<element>(points.col(q)) - table.values.col(q)).norm(), 1e-14);
    EXPECT_LE((shape.dN - table.gradients[q]).norm(), 1e-13);
    EXPECT_LE((shape.ddN - table.hessians[q]).norm(), 1e-12);
  }
  const fem::Points nodes = fem::reference_nodes(element);
  for (Eigen::Index b = 0; b < nodes.cols(); ++b)
    for (Eigen::Index a = 0; a < nodes.cols(); ++a) EXPECT_EQ(fem::plane_values<element>(nodes.col(b))[a], a == b ? 1.0 : 0.0);
}

TEST(PlaneShape, IsTheTableAtAnyPointAndOneOrZeroAtTheNodesToTheLastBit) {
  expect_like_the_table<Element::tri3>();
  expect_like_the_table<Element::tri6>();
  expect_like_the_table<Element::quad4>();
  expect_like_the_table<Element::quad9>();
}

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

/// Integral of x^a y^b z^c: a! b! c! / (a + b + c + d)! over the simplices of dimension d, products of 1/(a + 1) over the cube and of
/// 2/(a + 1) or 0 over [-1, 1]^d.
double integral(Domain domain, const std::array<int, 3>& power) {
  const int dim = fem::dimension(domain);
  double value = 1.0;
  int sum = dim;
  for (int d = 0; d < dim; ++d) {
    const int a = power[d];
    sum += a;
    if (simplex(domain)) value *= factorial(a);
    else if (domain == Domain::cube) value /= a + 1.0;
    else value *= a % 2 == 1 ? 0.0 : 2.0 / (a + 1.0);
  }
  return simplex(domain) ? value / factorial(sum) : value;
}

/// The largest error over the monomials of a degree: in all of a simplex, in the first coordinate elsewhere.
double largest_error(Domain domain, const fem::Rule& rule, int degree) {
  double worst = 0.0;
  const int dim = fem::dimension(domain);
  for (int b = 0; b <= (dim > 1 ? degree : 0); ++b)
    for (int c = 0; c <= (dim > 2 ? degree : 0); ++c) {
      const int a = simplex(domain) ? degree - b - c : degree;
      if (a < 0) continue;
      const std::array<int, 3> power = {a, b, c};
      double sum = 0.0;
      for (Eigen::Index q = 0; q < rule.weights.size(); ++q) {
        double f = rule.weights[q];
        for (int d = 0; d < dim; ++d) f *= std::pow(rule.points(d, q), power[d]);
        sum += f;
      }
      worst = std::max(worst, std::abs(sum - integral(domain, power)));
    }
  return worst;
}

TEST(Quadrature, IsExactToItsDegreeAndNotBeyond) {
  struct Case {
    Domain domain;
    int degree, points;
  };
  for (const auto& [domain, degree, points] :
       {Case{Domain::line, 3, 2}, Case{Domain::line, 5, 3}, Case{Domain::square, 3, 4}, Case{Domain::square, 5, 9}, Case{Domain::cube, 3, 8},
        Case{Domain::cube, 5, 27}, Case{Domain::triangle, 2, 3}, Case{Domain::triangle, 5, 7}, Case{Domain::tetrahedron, 5, 14}}) {
    const fem::Rule rule = fem::quadrature(domain, degree);
    EXPECT_EQ(rule.weights.size(), points);
    EXPECT_GT(rule.weights.minCoeff(), 0.0);
    for (int d = 0; d <= degree; ++d) EXPECT_LE(largest_error(domain, rule, d), 1e-14) << static_cast<int>(domain) << ", " << d;
    EXPECT_GT(largest_error(domain, rule, degree + 1), 1e-6) << static_cast<int>(domain);
  }
}

TEST(Quadrature, OfADegreeThatNoRuleHasIsRefused) {
  EXPECT_THROW(fem::quadrature(Domain::triangle, 4), std::invalid_argument);
  EXPECT_THROW(fem::quadrature(Domain::tetrahedron, 3), std::invalid_argument);
}

}  // namespace
}  // namespace snug::tests
