#include "solver/fem/plane_shape.hpp"

#include <Eigen/LU>

#include <cmath>

namespace snug::fem {

namespace {

/// Monomials at points, one column a point.
Eigen::MatrixXd monomials(int nodes, const Points& points) {
  Eigen::MatrixXd m(nodes, points.cols());
  for (Eigen::Index q = 0; q < points.cols(); ++q) {
    const bool line = points.rows() == 1;
    const double x = points(0, q), y = line ? x * x : points(1, q);
    const std::array<double, 6> all = {1.0, x, y, x * x, x * y, y * y};
    for (int k = 0; k < nodes; ++k) m(k, q) = all[k];
  }
  return m;
}

/// From deal.II's functions at as many points as they have coefficients. These are multiples of a half: what is beyond is
/// round-off of the solution, and without it the functions are one and zero at the nodes to the last bit.
Eigen::MatrixXd found(Element element) {
  const Points at = reference_nodes(element);
  const Eigen::MatrixXd solved = tabulate(element, at).values * monomials(node_count(element), at).inverse();
  return 0.5 * (2.0 * solved).array().round();
}

}  // namespace

template <Element element>
const Coefficients<element>& coefficients() {
  static const Coefficients<element> c = found(element);
  return c;
}
template const Coefficients<Element::line2>& coefficients<Element::line2>();
template const Coefficients<Element::line3>& coefficients<Element::line3>();
template const Coefficients<Element::tri3>& coefficients<Element::tri3>();
template const Coefficients<Element::tri6>& coefficients<Element::tri6>();

}  // namespace snug::fem
