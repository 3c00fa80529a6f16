#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "solver/fem/element.hpp"

namespace snug::fem {

namespace {

/// `first`, `length`: of our domain along each coordinate, 0 and 1 of deal.II's.
template <class Theirs>
Rule rule_of(const Theirs& theirs, double first = 0.0, double length = 1.0) {
  constexpr int dim = std::decay_t<decltype(theirs.point(0))>::dimension;
  Rule rule{Points(dim, theirs.size()), Eigen::VectorXd(theirs.size())};
  for (unsigned int q = 0; q < theirs.size(); ++q) {
    for (int d = 0; d < dim; ++d) rule.points(d, q) = first + length * theirs.point(q)[d];
    rule.weights[q] = std::pow(length, dim) * theirs.weight(q);
  }
  return rule;
}

}  // namespace

Rule quadrature(Domain domain, int degree) {
  const int along = degree / 2 + 1;  // n points of Gauss are exact to degree 2 n - 1
  switch (domain) {
    case Domain::line: return rule_of(dealii::QGauss<1>(along), -1.0, 2.0);
    case Domain::square: return rule_of(dealii::QGauss<2>(along), -1.0, 2.0);
    case Domain::cube: return rule_of(dealii::QGauss<3>(along));
    case Domain::triangle:
      if (degree == 2) return rule_of(dealii::QWitherdenVincentSimplex<2>(1, false));
      if (degree == 5) return rule_of(dealii::QWitherdenVincentSimplex<2>(3));
      break;
    case Domain::tetrahedron:
      if (degree == 5) return rule_of(dealii::QWitherdenVincentSimplex<3>(3));
      break;
  }
  throw std::invalid_argument("no rule of degree " + std::to_string(degree) + " on this simplex");
}

}  // namespace snug::fem
