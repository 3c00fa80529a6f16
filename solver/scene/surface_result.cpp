#include "solver/scene/surface_result.hpp"

#include <Eigen/Dense>

#include <array>

#include "solver/terms/facet_kind.hpp"

namespace snug::solver {

SurfacePressures surface_pressures(const Contact& contact, const Field& position, const State& state,
                                   const std::vector<mesh::FacetNodeNumbers>& slave_facets) {
  std::vector<double> now(contact.vertices(), 0.0);  // int L_i da of a vertex, m2
  for (const auto& facet : slave_facets)
    for (const FacetRulePoint& q : facet_rule(mesh::FacetKind::tri6)) {
      const FacetNodes x = facet_positions(state, position, facet);
      const double part = q.weight * facet_point(x, q.shape).area;
      const Eigen::Vector3d L(1.0 - q.xi.sum(), q.xi[0], q.xi[1]);
      for (int v = 0; v < 3; ++v) now[contact.multiplier_of(facet[v])] += part * L[v];
    }
  SurfacePressures found;
  const auto at = [&](int node) {
    const int i = contact.multiplier_of(node);
    return contact.pressure(state, i) * contact.rest_area(i) / now[i];
  };
  for (const auto& facet : slave_facets)
    for (int v = 0; v < 3; ++v) {
      const double here = at(facet[v]), next = at(facet[(v + 1) % 3]);
      found.at_node[facet[v]] = here, found.at_node[facet[3 + v]] = 0.5 * (here + next);
    }
  for (int i = 0; i < contact.vertices(); ++i)
    if (contact.pressure(state, i) > 0.0) found.area += now[i];
  return found;
}

}  // namespace snug::solver
