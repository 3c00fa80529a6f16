// The kinds of cell a body is made of: their nodes, faces, shape functions and quadrature on the reference cell.
#pragma once

#include <Eigen/Core>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace snug::mesh {

/// hex27 and hex8 live on the cube [0, 1]^3 with nodes in tensor order (i fastest); tet10 on the simplex
/// x, y, z >= 0, x + y + z <= 1 with the vertices first and the mid-edge nodes 01, 12, 20, 03, 13, 23 after them.
enum class CellKind { hex27, hex8, tet10 };

/// Faces of these: quad9 and quad4 in tensor order on [-1, 1]^2, tri6 as vertices, then mid-edge nodes 01, 12, 20.
enum class FacetKind { quad9, quad4, tri6 };

constexpr int max_cell_nodes = 27, max_facet_nodes = 9;
/// Node numbers of one cell or facet; entries past the kind's nodes are -1.
using CellNodes = std::array<int, max_cell_nodes>;
using FacetNodeNumbers = std::array<int, max_facet_nodes>;

constexpr int node_count(CellKind kind) { return kind == CellKind::hex27 ? 27 : kind == CellKind::hex8 ? 8 : 10; }
constexpr int node_count(FacetKind kind) { return kind == FacetKind::quad9 ? 9 : kind == FacetKind::quad4 ? 4 : 6; }
constexpr FacetKind facet_kind(CellKind kind) {
  return kind == CellKind::hex27 ? FacetKind::quad9 : kind == CellKind::hex8 ? FacetKind::quad4 : FacetKind::tri6;
}
/// "Q2/P1 hexahedra", ...
std::string to_string(CellKind kind);

struct SamplePoint {
  Eigen::Vector3d reference;
  double weight = 0.0;  ///< 0 where the point is only looked at
};

/// Nodes of the reference cell.
const std::vector<Eigen::Vector3d>& reference_nodes(CellKind kind);
/// Gauss points, weights add up to the volume of the reference cell: 27, 8 and 14 points (Walkington's rule of degree 5,
/// all weights positive: Walkington, Quadrature on simplices of arbitrary dimension, 2000).
const std::vector<SamplePoint>& gauss_points(CellKind kind);
/// Gauss points and then nodes (weight 0): where a Jacobian is looked at.
const std::vector<SamplePoint>& check_points(CellKind kind);
/// Local nodes of each face in the order of its facet kind; tangents of the facet's two coordinates turn outwards.
const std::vector<std::vector<int>>& faces(CellKind kind);

using ShapeGradients = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_cell_nodes, 3>;
/// dN_a / dreference, one row a node.
ShapeGradients shape_gradients(CellKind kind, const Eigen::Vector3d& reference);
using ShapeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_cell_nodes, 1>;
ShapeValues shape_values(CellKind kind, const Eigen::Vector3d& reference);

/// Positions of a cell's nodes, one column a node.
using CellPositions = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_cell_nodes>;
CellPositions cell_positions(CellKind kind, const CellNodes& cell, std::span<const Eigen::Vector3d> nodes);

/// dx/dreference at a reference point; columns are the tangents along the reference coordinates.
Eigen::Matrix3d jacobian(CellKind kind, const CellPositions& nodes, const Eigen::Vector3d& reference);

}  // namespace snug::mesh
