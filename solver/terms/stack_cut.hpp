// The quadrature points of a slave triangle over surfaces that lie over one another.
#pragma once

#include "solver/terms/facet_cut.hpp"
#include "solver/terms/master_stack.hpp"

namespace snug::solver {

/// Those of every surface.
std::vector<MasterNodes> master_nodes(const MasterStack& master, const State& state);

/// A triangle that lies over one surface altogether is cut along its facets (cut_by_facets); one that an edge of an upper surface
/// runs through has the points of a fixed rule, each of which meets what it faces (facets unknown: the caller looks for
/// them), and so has one that cannot be cut: `parts` squared seven-point rules. Sites are those of the stack.
std::vector<ContactPoint> cut_by_stack(const MasterStack& master, const std::vector<MasterNodes>& nodes, const State& state,
                                       const TriangleNodes& triangle, int order, int parts, const MasterStack::Trees& trees = {});

}  // namespace snug::solver
