// Pressure between two surfaces of the body, as a result.
#pragma once

#include <map>
#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "solver/terms/contact.hpp"

namespace snug::solver {

struct SurfacePressures {
  std::map<int, double> at_node;  ///< Pa per current area, on the slave's nodes
  double area = 0.0;              ///< m2, current area of the slave's facets that touch, shared out by their vertices
};

/// Multipliers stand per rest area: here they are brought to the current one, and mid-edge nodes get the mean of their edge.
SurfacePressures surface_pressures(const Contact& contact, const Field& position, const State& state,
                                   const std::vector<mesh::FacetNodeNumbers>& slave_facets);

}  // namespace snug::solver
