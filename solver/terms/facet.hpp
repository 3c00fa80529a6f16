// Geometry of one skin facet: nine slots for the nodes of any kind (facet_kind.hpp), biquadratic in full.
#pragma once

#include <Eigen/Core>

namespace snug::solver {

using FacetNodes = Eigen::Matrix<double, 3, 9>;  ///< positions in tensor order, m

/// Shape functions and their derivatives at (xi, eta) in [-1, 1]^2.
struct FacetShape {
  Eigen::Matrix<double, 9, 1> N;
  Eigen::Matrix<double, 9, 2> dN;   ///< d/dxi, d/deta
  Eigen::Matrix<double, 9, 3> ddN;  ///< d2/dxi2, d2/deta2, d2/dxi deta
};
FacetShape facet_shape(const Eigen::Vector2d& xi);

/// Differential geometry at a point: y_a tangents, n outward unit normal, m metric, k_ab = n . y_ab.
struct FacetPoint {
  Eigen::Vector3d y, n;
  Eigen::Matrix<double, 3, 2> tangent;
  Eigen::Matrix2d metric, curvature;
  double area = 0.0;  ///< |y_1 x y_2|
};
FacetPoint facet_point(const FacetNodes& nodes, const FacetShape& shape);

}  // namespace snug::solver
