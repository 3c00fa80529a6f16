// Shape functions of plane elements at any point, for loops that search, project and cut: polynomials with the coefficients of
// deal.II's elements, evaluated inline.
#pragma once

#include "solver/fem/element.hpp"

namespace snug::fem {

/// Rows: nodes; columns: of 1, x, x2 (lines) or 1, x, y, x2, xy, y2 (triangles), as many as there are nodes.
template <Element element>
using Coefficients = Eigen::Matrix<double, node_count(element), node_count(element)>;
/// For line2, line3, tri3 and tri6; found once.
template <Element element>
const Coefficients<element>& coefficients();

template <int nodes>
struct PlaneShape {
  Eigen::Matrix<double, nodes, 1> N;
  Eigen::Matrix<double, nodes, 2> dN;   ///< d/dxi, d/deta
  Eigen::Matrix<double, nodes, 3> ddN;  ///< d2/dxi2, d2/deta2, d2/dxi deta
};

/// Value, slope and second derivative along a line.
template <int nodes>
struct LineShape {
  Eigen::Matrix<double, nodes, 1> N, d, dd;
};
template <int nodes>
inline LineShape<nodes> line_shape(double x) {
  const auto& c = coefficients<nodes == 3 ? Element::line3 : Element::line2>();
  if constexpr (nodes == 2) return {c.col(0) + x * c.col(1), c.col(1), Eigen::Vector2d::Zero()};
  else return {c.col(0) + x * (c.col(1) + x * c.col(2)), c.col(1) + 2.0 * x * c.col(2), 2.0 * c.col(2)};
}

template <Element element>
using PlaneValues = Eigen::Matrix<double, node_count(element), 1>;

/// Values at a point; squares are products of two lines.
template <Element element>
inline PlaneValues<element> plane_values(const Eigen::Vector2d& xi)
  requires(domain(element) == Domain::square)
{
  constexpr int along = element == Element::quad9 ? 3 : 2;
  const auto u = line_shape<along>(xi[0]).N, v = line_shape<along>(xi[1]).N;
  return (u * v.transpose()).reshaped();
}
template <Element element>
inline PlaneValues<element> plane_values(const Eigen::Vector2d& xi)
  requires(domain(element) == Domain::triangle)
{
  const auto& c = coefficients<element>();
  const double x = xi[0], y = xi[1];
  if constexpr (element == Element::tri3) return c.col(0) + x * c.col(1) + y * c.col(2);
  else return c.col(0) + x * (c.col(1) + x * c.col(3) + y * c.col(4)) + y * (c.col(2) + y * c.col(5));
}

/// With derivatives, in the first rows of `slots`; the others are zero.
template <Element element, int slots = node_count(element)>
inline PlaneShape<slots> plane_shape(const Eigen::Vector2d& xi)
  requires(domain(element) == Domain::square)
{
  constexpr int along = element == Element::quad9 ? 3 : 2;
  const LineShape<along> u = line_shape<along>(xi[0]), v = line_shape<along>(xi[1]);
  PlaneShape<slots> s;
  if constexpr (slots > node_count(element)) s.N.setZero(), s.dN.setZero(), s.ddN.setZero();
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < along; ++i) {
      const int a = along * j + i;
      s.N[a] = u.N[i] * v.N[j];
      s.dN(a, 0) = u.d[i] * v.N[j], s.dN(a, 1) = u.N[i] * v.d[j];
      s.ddN(a, 0) = u.dd[i] * v.N[j], s.ddN(a, 1) = u.N[i] * v.dd[j], s.ddN(a, 2) = u.d[i] * v.d[j];
    }
  return s;
}
template <Element element, int slots = node_count(element)>
inline PlaneShape<slots> plane_shape(const Eigen::Vector2d& xi)
  requires(domain(element) == Domain::triangle)
{
  constexpr int nodes = node_count(element);
  const auto& c = coefficients<element>();
  const double x = xi[0], y = xi[1];
  PlaneShape<slots> s;
  if constexpr (slots > nodes) s.N.setZero(), s.dN.setZero(), s.ddN.setZero();
  s.N.template head<nodes>() = plane_values<element>(xi);
  if constexpr (element == Element::tri3) {
    s.dN.template topRows<nodes>() = c.template middleCols<2>(1);
    s.ddN.setZero();
  } else {
    s.dN.col(0).template head<nodes>() = c.col(1) + 2.0 * x * c.col(3) + y * c.col(4);
    s.dN.col(1).template head<nodes>() = c.col(2) + x * c.col(4) + 2.0 * y * c.col(5);
    s.ddN.col(0).template head<nodes>() = 2.0 * c.col(3);
    s.ddN.col(1).template head<nodes>() = 2.0 * c.col(5);
    s.ddN.col(2).template head<nodes>() = c.col(4);
  }
  return s;
}

}  // namespace snug::fem
