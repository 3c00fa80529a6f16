// Facets of every kind in nine slots: the shape functions of slots that a kind does not use are zero.
#pragma once

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/algebra/state.hpp"
#include "solver/terms/facet.hpp"

namespace snug::solver {

/// Shape functions at (xi, eta): in [-1, 1]^2 for quadrilaterals; xi, eta >= 0, xi + eta <= 1 for triangles.
FacetShape facet_shape(mesh::FacetKind kind, const Eigen::Vector2d& xi);

/// Gauss points: 3 x 3, 2 x 2 (weights add up to 4) and Radon's 7 of degree 5 (weights add up to 1/2).
struct FacetRulePoint {
  Eigen::Vector2d xi;
  double weight = 0.0;
};
const std::vector<FacetRulePoint>& facet_rule(mesh::FacetKind kind);

/// Entries of the nine slots; slots without a node repeat the first one's and get nothing.
std::array<int, 27> facet_entries(const Layout& layout, const mesh::FacetNodeNumbers& facet);
/// Positions in the nine slots: of the state, or of the reference body.
FacetNodes facet_positions(const State& state, const Layout& layout, const mesh::FacetNodeNumbers& facet);
FacetNodes facet_positions(const mesh::BodyMesh& mesh, const mesh::FacetNodeNumbers& facet);

}  // namespace snug::solver
