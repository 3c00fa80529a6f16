// Shape functions, gradients and weights of the reference body, tabulated once by deal.II.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mesh/body/body_mesh.hpp"

namespace snug::solver {

/// Per cell of the mesh, at the 27 Gauss points of the reference body; nodes in the mesh's tensor order.
struct HexTable {
  std::vector<Eigen::Matrix<double, 27, 81>> gradient;  ///< node a, column 3 q + J, 1/m
  std::vector<Eigen::Matrix<double, 27, 1>> weight;     ///< m3
  std::vector<Eigen::Matrix<double, 3, 27>> point;      ///< m
};
/// deal.II's FE_Q(2) on its MappingQCache through the mesh's own nodes (isoparametric).
HexTable tabulate_hexahedra(const mesh::BodyMesh& mesh);

/// Values at the 27 nodes from values at the 27 Gauss points, 27 x 27 (point, node): the trilinear least-squares fit,
/// which does not overshoot as the full extrapolation does.
const Eigen::Matrix<double, 27, 27>& gauss_to_nodes();

}  // namespace snug::solver
