// Facets of every kind in nine slots: the shape functions of slots that a kind does not use are zero.
#pragma once

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/algebra/layout.hpp"
#include "solver/algebra/state.hpp"
#include "solver/terms/facet.hpp"

namespace snug::solver {

/// Shape functions at (xi, eta): in [-1, 1]^2 for quadrilaterals; xi, eta >= 0, xi + eta <= 1 for triangles.
FacetShape facet_shape(mesh::FacetKind kind, const Eigen::Vector2d& xi);

/// Gauss points: 3 x 3, 2 x 2 (weights add up to 4) and the 7 of degree 5 (weights add up to 1/2).
struct FacetRulePoint {
  Eigen::Vector2d xi;
  double weight = 0.0;
  FacetShape shape;
};
const std::vector<FacetRulePoint>& facet_rule(mesh::FacetKind kind);

/// The reference domain of a kind and its nodes.
struct FacetDomain {
  Eigen::Vector2d centre;
  double middle, half_width;                    ///< the square round the domain, the same in both coordinates
  std::vector<Eigen::Vector2d> nodes;
  std::vector<int> outline;                     ///< nodes round the edge, counter-clockwise about the outward normal
  std::vector<std::array<int, 2>> edge_corners; ///< corner nodes of each edge
  std::vector<Eigen::Vector3d> edges;           ///< (a, b, c): a xi + b eta + c > 0 beyond the edge; -2 on the far side
};
const FacetDomain& facet_domain(mesh::FacetKind kind);
/// How far xi lies beyond an edge, in units in which the facet measures 2.
double beyond(const FacetDomain& domain, int edge, const Eigen::Vector2d& xi);
/// A place of the domain near xi; xi itself when it is inside.
Eigen::Vector2d clamped(mesh::FacetKind kind, const Eigen::Vector2d& xi);

/// Closest point of the facet's (extended) surface to x by Newton's method from `xi`. Stops at `reach` half widths of the
/// square round the domain. Returns false when it did not converge.
bool project(mesh::FacetKind kind, const FacetNodes& nodes, const Eigen::Vector3d& x, double reach, Eigen::Vector2d& xi);

/// Entries of the nine slots; slots without a node repeat the first one's and get nothing.
std::array<int, 27> facet_entries(const Field& positions, const mesh::FacetNodeNumbers& facet);
/// Positions in the nine slots: of the state, or of the reference body.
FacetNodes facet_positions(const State& state, const Field& positions, const mesh::FacetNodeNumbers& facet);
FacetNodes facet_positions(const mesh::BodyMesh& mesh, const mesh::FacetNodeNumbers& facet);

}  // namespace snug::solver
