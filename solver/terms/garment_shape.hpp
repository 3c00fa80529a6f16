// The garment's triangle (P2; P1 for verification) and its quadrature, on area coordinates L = (1 - xi - eta, xi, eta).
#pragma once

#include <Eigen/Core>

#include <vector>

namespace snug::solver {

/// Values on a mesh of the given order, in six slots: linear triangles give their mid-edge nodes nothing.
Eigen::Matrix<double, 6, 1> garment_values(int order, const Eigen::Vector3d& L);

/// d N_a / d (xi, eta) on a mesh of the given order.
Eigen::Matrix<double, 6, 2> garment_slopes(int order, const Eigen::Vector3d& L);

/// The pattern at L of a triangle with `nodes` (2 x 6, m), whose edges bend with their mid-edge nodes (order 2).
struct PatternPoint {
  Eigen::Matrix<double, 6, 2> gradient;  ///< of the shape functions along the pattern, 1/m
  double area = 0.0;                     ///< m2, of the triangle if it were everywhere as dense as here
};
PatternPoint pattern_point(int order, const Eigen::Matrix<double, 2, 6>& nodes, const Eigen::Vector3d& L);

/// How long a course is at rest over the pattern (GarmentMesh::course_of) where the shape functions are N; exactly 1 of cloth that is cut.
double course_value(const Eigen::Matrix<double, 1, 6>& course, const Eigen::Matrix<double, 6, 1>& N);

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
/// Seven points, exact to degree 5.
const std::vector<TrianglePoint>& triangle_rule();

/// The same rule on the n x n congruent parts of the triangle.
std::vector<TrianglePoint> composite_rule(int n);

}  // namespace snug::solver
