// Shape functions of the garment's triangle (P2; P1 for verification) and its quadrature, on area coordinates L = (1 - xi - eta, xi, eta).
#pragma once

#include <Eigen/Core>

#include <vector>

namespace snug::solver {

/// Nodes: vertices 0 1 2, mid-edges 01 12 20.
inline Eigen::Matrix<double, 6, 1> p2_values(const Eigen::Vector3d& L) {
  Eigen::Matrix<double, 6, 1> N;
  N << L[0] * (2 * L[0] - 1), L[1] * (2 * L[1] - 1), L[2] * (2 * L[2] - 1), 4 * L[0] * L[1], 4 * L[1] * L[2],
      4 * L[2] * L[0];
  return N;
}

/// d N_a / d L_i, 6 x 3.
inline Eigen::Matrix<double, 6, 3> p2_derivatives(const Eigen::Vector3d& L) {
  Eigen::Matrix<double, 6, 3> D = Eigen::Matrix<double, 6, 3>::Zero();
  for (int i = 0; i < 3; ++i) D(i, i) = 4 * L[i] - 1;
  D(3, 0) = 4 * L[1], D(3, 1) = 4 * L[0];
  D(4, 1) = 4 * L[2], D(4, 2) = 4 * L[1];
  D(5, 2) = 4 * L[0], D(5, 0) = 4 * L[2];
  return D;
}

/// Values on a mesh of the given order: linear triangles give their mid-edge nodes nothing.
inline Eigen::Matrix<double, 6, 1> garment_values(int order, const Eigen::Vector3d& L) {
  if (order == 2) return p2_values(L);
  Eigen::Matrix<double, 6, 1> N = Eigen::Matrix<double, 6, 1>::Zero();
  N.head<3>() = L;
  return N;
}

/// d N_a / d L_i on a mesh of the given order, 6 x 3.
inline Eigen::Matrix<double, 6, 3> garment_derivatives(int order, const Eigen::Vector3d& L) {
  if (order == 2) return p2_derivatives(L);
  Eigen::Matrix<double, 6, 3> D = Eigen::Matrix<double, 6, 3>::Zero();
  D.topRows<3>().setIdentity();
  return D;
}

/// The pattern at L of a triangle with `nodes` (2 x 6, m), whose edges bend with their mid-edge nodes (order 2).
struct PatternPoint {
  Eigen::Matrix<double, 6, 2> gradient;  ///< of the shape functions along the pattern, 1/m
  double area = 0.0;                     ///< m2, of the triangle if it were everywhere as dense as here
};
PatternPoint pattern_point(int order, const Eigen::Matrix<double, 2, 6>& nodes, const Eigen::Vector3d& L);
/// d L / d (xi, eta), 3 x 2.
Eigen::Matrix<double, 3, 2> area_coordinate_derivatives();

/// Gradients of L on a straight triangle, 3 x 2 (1/m), and its area (m2, positive for counter-clockwise vertices).
struct FlatTriangle {
  Eigen::Matrix<double, 3, 2> gradient;
  double area = 0.0;
};
FlatTriangle flat_triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

struct TrianglePoint {
  Eigen::Vector3d L;
  double weight = 0.0;  ///< fractions of the area, sum 1
};
/// Seven points, exact to degree 5 (deal.II QGaussSimplex).
const std::vector<TrianglePoint>& triangle_rule();

/// The same rule on the n x n congruent parts of the triangle.
std::vector<TrianglePoint> composite_rule(int n);

}  // namespace snug::solver
