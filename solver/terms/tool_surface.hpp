// The part of a body's surface that a rigid tool may meet: facets of any kind, with multipliers at their corners.
#pragma once

#include <array>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/terms/facet_kind.hpp"

namespace snug::solver {

/// A value; the multipliers are numbered from 0 in the order in which the facets name their corners.
struct ToolSurface {
  mesh::FacetKind kind = mesh::FacetKind::quad9;
  std::vector<mesh::FacetNodeNumbers> facets;
  std::vector<std::array<int, 4>> vertices;  ///< multipliers of each facet's corners; a triangle has three, then the first again
  std::vector<int> node_of_vertex;
  double mean_edge = 0.0;                    ///< m
};
ToolSurface tool_surface(const mesh::BodyMesh& body, std::vector<mesh::FacetNodeNumbers> facets);

/// Points at which gaps are weighed, the same on every facet: a rule on each of its parts, since the pressure under a rounded edge changes within a facet.
struct ToolPoint {
  double weight = 0.0;       ///< on the reference facet
  FacetShape shape;
  Eigen::Vector4d hat;       ///< of the corners; the fourth of a triangle is 0
};
const std::vector<ToolPoint>& tool_points(mesh::FacetKind kind);
/// The hats at the facet's nodes, slot by slot.
const std::vector<Eigen::Vector4d>& hats_at_nodes(mesh::FacetKind kind);

}  // namespace snug::solver
