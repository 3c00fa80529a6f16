// Linear tetrahedra between nested surfaces made quadratic, with the surfaces' edges on their smooth shapes.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/body/nested_surfaces.hpp"
#include "mesh/surface/tetrahedra.hpp"

namespace snug::mesh {

/// Where the vertices of each surface begin among the nodes of the complex.
struct QuadraticCells {
  std::vector<Eigen::Vector3d> nodes;
  std::vector<CellNodes> cells;                   ///< tet10
  std::vector<std::vector<int>> on_surface;       ///< nodes by surface
  std::vector<std::vector<int>> on_cut;           ///< nodes by cut, of the cut faces
  int straightened = 0;                           ///< edges that were left less curved, since a cell would have turned inside out
};

/// `first[s]`: number of the first vertex of surface s; `caps[c]`: triangles of cut c.
QuadraticCells quadratic(const Tetrahedra& cells, const std::vector<NestedSurface>& surfaces, const std::vector<int>& first,
                         const std::vector<std::vector<std::array<int, 3>>>& caps, const std::vector<Cut>& cuts);

}  // namespace snug::mesh
