// The hems of a garment: line loads, apart from the pressure.
#pragma once

#include "postproc/result.hpp"

namespace snug::postproc {

/// A held edge, or the edge of a sleeve that the skin bulges round, presses along a line; its nodal pressure is that force over
/// whatever the mesh gives it for an area and grows with every refinement. So the strip beside each named edge is kept apart:
///   width  w = max(one skin cell, length of the edge / 24), at most half of the garment's depth (the distance of the
///          node that is farthest from all edges). The fixed share keeps the strip where it is when the mesh is refined: the
///          pressure beside it has a slope, and a strip as wide as a cell would move with it. 24: the skin cells round a limb
///          of a coarse mesh.
///   reach  c = one skin cell, at most w: as far as a line load spreads in the contact of the two meshes,
///   force  F = sum of the normal contact forces of the points nearer than c to the edge,
///   line load  q = (F - p A) / length, with the area A of these points and the pressure p there, which is that of the points
///          c to 3 c from the edge, continued along its slope across the edge (least squares by area). What the slope misses
///          of a smooth pressure is of the third order in c. An edge that lies on other cloth has pressure on both sides: there
///          p A is the sum over both, each with its own line.
/// Distances are straight ones to the edge as worn. A point belongs to the nearest edge.
///
/// Fills run.hems, the samples' `hem`, and of the body `hem`, `pressure_inside` (its `contact_pressure` less the strips) and
/// `largest_inside` from the samples, their places and the garment's edges. `cell`: mean edge length of the skin's facets, m.
/// Returns the largest pressure beside the strips, Pa: of the nodes, and of the points in the facets that a strip's border
/// runs through, where the last node may be half a cell away.
double keep_hems_apart(double cell, RunResult& run);

}  // namespace snug::postproc
