// Cloth of particles falls on the skin until it is at rest.
#pragma once

#include "solver/scene/particle_scene.hpp"
#include "solver/stepping/run_log.hpp"

namespace snug::solver {

/// When cloth counts as at rest, and how long it is waited for.
struct RestRule {
  double residual = 1e-3;  ///< sum of the amounts of forces out of balance at all particles, over the weight
  double energy = 1e-8;    ///< kinetic energy over the weight times the mean edge of the triangles
  int steps = 1500;        ///< no more of them
};

/// Falls from where the garment is placed, in implicit steps in each of which no particle goes farther than a third of an edge, longer and
/// longer as the cloth comes to rest. The status: converged when both bounds of the rule are met; partial when they are not in the
/// steps given, or the user stops it; failed when the garment has slid down by its own length.
void drape(const Model& model, const Meshes& meshes, const KeptStates& kept, const Stop& stop, RunLog& log, postproc::RunResult& result,
           const RestRule& rule = {});

}  // namespace snug::solver
