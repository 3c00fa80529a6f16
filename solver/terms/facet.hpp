// Geometry of one skin facet: nine slots for the nodes of any kind (facet_kind.hpp), biquadratic in full.
#pragma once

#include <Eigen/Core>

#include "solver/fem/plane_shape.hpp"

namespace snug::solver {

using FacetNodes = Eigen::Matrix<double, 3, 9>;  ///< positions in tensor order, m

/// Shape functions and their derivatives at a point, in the nine slots.
using FacetShape = fem::PlaneShape<9>;

/// Differential geometry at a point: y_a tangents, n outward unit normal, m metric, k_ab = n . y_ab.
struct FacetPoint {
  Eigen::Vector3d y, n;
  Eigen::Matrix<double, 3, 2> tangent;
  Eigen::Matrix2d metric, curvature;
  double area = 0.0;  ///< |y_1 x y_2|
};
FacetPoint facet_point(const FacetNodes& nodes, const FacetShape& shape);

}  // namespace snug::solver
