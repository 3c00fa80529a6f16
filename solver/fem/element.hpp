// The finite elements of the house in our order of nodes: deal.II's elements, tabulated at points.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace snug::fem {

/// Lines and squares are [-1, 1]^d, cubes [0, 1]^3; triangles and tetrahedra have non-negative coordinates of sum <= 1.
enum class Domain { line, triangle, square, tetrahedron, cube };

/// Lagrange elements of first and second order. Nodes of lines, squares and cubes stand in tensor order (first coordinate
/// fastest); those of simplices are the vertices, the origin first, and then the middles of `simplex_edges`.
enum class Element { line2, line3, tri3, tri6, quad4, quad9, tet4, tet10, hex8, hex27 };

/// Vertices of the edges that the mid-edge nodes stand on; the first three are the triangle's.
inline constexpr std::array<std::array<int, 2>, 6> simplex_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

constexpr int node_count(Element element) {
  constexpr std::array counts = {2, 3, 3, 6, 4, 9, 4, 10, 8, 27};
  return counts[static_cast<int>(element)];
}
constexpr Domain domain(Element element) { return static_cast<Domain>(static_cast<int>(element) / 2); }
constexpr int dimension(Domain domain) {
  return domain == Domain::line ? 1 : domain == Domain::triangle || domain == Domain::square ? 2 : 3;
}

/// Points of a reference domain, one column a point.
using Points = Eigen::MatrixXd;
/// Nodes of the reference element.
Points reference_nodes(Element element);

/// Shape functions at points.
struct Table {
  Eigen::MatrixXd values;                  ///< nodes x points
  std::vector<Eigen::MatrixXd> gradients;  ///< of each point, nodes x dimension
  std::vector<Eigen::MatrixXd> hessians;   ///< of each point, nodes x (11, 22, 33, 12, 23, 13), (11, 22, 12) or (11)
};
/// Derivatives are along the coordinates of the reference domain. Makes an element of deal.II: keep what it returns.
Table tabulate(Element element, const Points& points);

/// A rule of quadrature; the weights add up to the measure of the domain.
struct Rule {
  Points points;
  Eigen::VectorXd weights;
};
/// deal.II's smallest rule that is exact to a degree: Gauss for lines, squares and cubes, to that degree in each coordinate;
/// Witherden and Vincent's for triangles (degree 2: 3 points, 5: 7) and tetrahedra (5: 14), symmetric with positive weights
/// (Comput. Math. Appl. 69 (2015) 1232). Throws std::invalid_argument for other degrees of simplices.
Rule quadrature(Domain domain, int degree);

}  // namespace snug::fem
