// What a garment that nothing holds needs to stay, and what other ways of putting it on would change.
#pragma once

#include <string>

#include "solver/scene/run.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Of the way on which friction acts from this fraction of the tightening.
std::string donning_name(double from);

/// Pressures of a state on the rigid skin.
postproc::DonningRow donning_row(const std::string& name, double from, bool converged, const Scene& scene,
                                 const State& state, const Model& model, const Meshes& meshes);

/// What moves a garment that no edge holds along the axis: the net force of contact pressures and weight (N, what would have to
/// answer it is positive upwards; 0: none to speak of), and the coefficient of friction that would bear it,
/// F / sqrt(C^2 - F^2) with the sum C of the contact forces (tan of the half angle on a cone).
struct Push {
  double force = 0.0, friction_needed = 0.0;
  int garment = 0;  ///< of several that which is pushed most
};
/// Of a frictionless state whose garments are held at their probe edges.
Push push_on_probes(const Scene& held, const State& state, const Model& model, const Meshes& meshes);
/// Of garments that stick where they were placed.
Push push_where_it_sticks(const Scene& sticking, const State& state, const Model& model);
/// Says so, and what would help.
std::string no_equilibrium(const Push& push, const Model& model, const Meshes& meshes);

}  // namespace snug::solver
