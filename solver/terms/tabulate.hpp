// Jacobians and weights of a cell of the reference body (isoparametric), and what carries point values to nodes.
#pragma once

#include <Eigen/Core>

#include "mesh/body/body_mesh.hpp"

namespace snug::solver {

/// At the Gauss points of one cell of the reference body.
struct CellTable {
  Eigen::Matrix3Xd inverse;   ///< 3 x 3 points: of the Jacobian at each, 1/m
  Eigen::VectorXd weight;     ///< m3
  Eigen::Matrix3Xd point;     ///< m
};
CellTable tabulate(const mesh::BodyMesh& mesh, int cell);

/// Gradients on the reference cell at its Gauss points, nodes x 3 points: node a, column 3 q + J.
Eigen::MatrixXd reference_gradients(mesh::CellKind kind);

/// Values at the nodes from values at the Gauss points, points x nodes: a least-squares fit that does not overshoot as
/// the full extrapolation does, trilinear for the 27 points of hex27 and linear for the few of the others.
const Eigen::MatrixXd& points_to_nodes(mesh::CellKind kind);

/// Shape functions of the P1 pressure of a tetrahedron at its Gauss points, 4 x points.
Eigen::Matrix4Xd vertex_shapes();

}  // namespace snug::solver
