// The kinds of cell a body is made of, as elements of the fem room: nodes, faces, and the points that cells are looked at in.
#pragma once

#include <Eigen/Core>

#include <array>
#include <span>
#include <string>
#include <vector>

#include "solver/fem/element.hpp"

namespace snug::mesh {

/// Reference cells and their nodes as in solver/fem/element.hpp.
enum class CellKind { hex27, hex8, tet10 };

/// Faces of these.
enum class FacetKind { quad9, quad4, tri6 };

constexpr int max_cell_nodes = 27, max_facet_nodes = 9;
/// Node numbers of one cell or facet; entries past the kind's nodes are -1.
using CellNodes = std::array<int, max_cell_nodes>;
using FacetNodeNumbers = std::array<int, max_facet_nodes>;

constexpr fem::Element element(CellKind kind) {
  return kind == CellKind::hex27 ? fem::Element::hex27 : kind == CellKind::hex8 ? fem::Element::hex8 : fem::Element::tet10;
}
constexpr fem::Element element(FacetKind kind) {
  return kind == FacetKind::quad9 ? fem::Element::quad9 : kind == FacetKind::quad4 ? fem::Element::quad4 : fem::Element::tri6;
}
constexpr int node_count(CellKind kind) { return fem::node_count(element(kind)); }
constexpr int node_count(FacetKind kind) { return fem::node_count(element(kind)); }
constexpr FacetKind facet_kind(CellKind kind) {
  return kind == CellKind::hex27 ? FacetKind::quad9 : kind == CellKind::hex8 ? FacetKind::quad4 : FacetKind::tri6;
}
/// "Q2/P1 hexahedra", ...
std::string to_string(CellKind kind);

using ShapeValues = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_cell_nodes, 1>;
using ShapeGradients = Eigen::Matrix<double, Eigen::Dynamic, 3, 0, max_cell_nodes, 3>;
struct SamplePoint {
  Eigen::Vector3d reference;
  double weight = 0.0;       ///< 0 where the point is only looked at
  ShapeValues values;        ///< N_a, one row a node
  ShapeGradients gradients;  ///< dN_a / dreference
};

/// Nodes of the reference cell.
const std::vector<Eigen::Vector3d>& reference_nodes(CellKind kind);
/// Gauss points, weights add up to the volume of the reference cell: 27, 8 and 14 points.
const std::vector<SamplePoint>& gauss_points(CellKind kind);
/// Gauss points and then nodes (weight 0): where a Jacobian is looked at.
const std::vector<SamplePoint>& check_points(CellKind kind);
/// Local nodes of each face in the order of its facet kind; tangents of the facet's two coordinates turn outwards.
const std::vector<std::vector<int>>& faces(CellKind kind);

/// Positions of a cell's nodes, one column a node.
using CellPositions = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, max_cell_nodes>;
CellPositions cell_positions(CellKind kind, const CellNodes& cell, std::span<const Eigen::Vector3d> nodes);

/// dx/dreference at a point; columns are the tangents along the reference coordinates.
Eigen::Matrix3d jacobian(const CellPositions& nodes, const SamplePoint& at);

}  // namespace snug::mesh
