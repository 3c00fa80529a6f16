// Cuts a garment triangle along the edges of the skin's facets, so that a quadrature rule meets no kink inside its parts.
#pragma once

#include <Eigen/Core>

#include <array>
#include <functional>
#include <vector>

#include "solver/terms/garment_shape.hpp"
#include "solver/terms/master_surface.hpp"

namespace snug::solver {

/// Positions (m) of a garment triangle's nodes: vertices 0 1 2, mid-edges 01 12 20.
using TriangleNodes = Eigen::Matrix<double, 3, 6>;

/// A quadrature point of a garment triangle and the facet that it meets.
struct ContactPoint {
  Eigen::Vector3d L;                  ///< area coordinates: a material point of the pattern
  double weight = 0.0;                ///< fraction of the triangle's rest area
  Eigen::Matrix<double, 6, 1> N;      ///< shape functions of the garment
  Site site;
  int line = 0;                       ///< 1: it stands for a part of a line, not of the triangle's area (ContactSlave::lines)
};

/// Positions and unit normals of the skin's nodes in one state: a node's normal is the mean over its facets, so that two
/// facets project a common node to the same place.
struct MasterNodes {
  std::vector<Eigen::Vector3d> position, normal;
};
MasterNodes master_nodes(const MasterSurface& skin, const State& state);

/// Projects the outline of every facet that the triangle meets on to the triangle (its nodes along the skin's normals,
/// joined by straight lines in area coordinates), clips it (Sutherland & Hodgman 1974) and puts the seven-point rule on
/// its fan of triangles. Parts of the triangle beyond the border of the skin get no point: nothing touches there.
/// What a straight line leaves of a facet's curved edge is of higher order than the rule. Sites are those of the facet
/// cut, with xi at its centre: the caller projects. Empty where the cut fails (the caller falls back on a fixed rule): the
/// triangle faces no facet, is folded, or the parts overlap.
std::vector<ContactPoint> cut_by_facets(const MasterSurface& skin, const MasterNodes& nodes, const TriangleNodes& triangle,
                                        int order, int start_facet);

/// The seven-point rule on n x n parts of the triangle, facets unknown.
std::vector<ContactPoint> uncut_rule(int n, int order);

}  // namespace snug::solver
