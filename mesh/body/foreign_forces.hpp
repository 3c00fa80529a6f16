// Nodal forces of another program's model on a body of other cells.
#pragma once

#include "mesh/body/foreign_nodes.hpp"

namespace snug::mesh {

/// Nodal forces belong to the shape functions of their file: 1/4, 1/4, 1/4, 1/4 of the load of a face on linear cells are 1/36, 1/9
/// and 4/9 of it on quadratic ones. Where all nodes of a boundary face of the file are loaded, the traction t that the forces f stand
/// for is found, (E^T M E) t = f, and integrated over the body's facets, F = M E t; M is the mass matrix of the facets, E gives the
/// values of the file's shape functions at their nodes. Resultants, moments and the work along every motion of the file's nodes
/// stay, E^T F = f. Forces at other nodes (points, edges) stay where they are. Source: Zienkiewicz & Taylor, The Finite Element
/// Method, vol. 1, sec. 3.3 (consistent nodal forces). Changes mesh.forces.
void spread_forces(const Model& model, const ForeignNodes& nodes, BodyMesh& mesh);

}  // namespace snug::mesh
