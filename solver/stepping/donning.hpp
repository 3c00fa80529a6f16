// Where on the garment's way friction acts, and what that assumption changes.
#pragma once

#include <string>
#include <vector>

#include "solver/scene/run.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// The case without its friction.
input::Case without_friction(const input::Case& description);

/// Fractions of the tightening at which friction sets in, ascending: that of the case, those of the rows that show the
/// spread (friction over the last 50 % and 10 %) and 1, where the frictionless tightening ends.
std::vector<double> donning_stops(const input::Case& description);
/// Of those, the ones that only show the spread.
std::vector<double> donning_variations(const input::Case& description);
std::string donning_name(double from);

/// Pressures of a state on the rigid skin.
postproc::DonningRow donning_row(const std::string& name, double from, bool converged, const Scene& scene,
                                 const State& state, const Meshes& meshes);

/// What pushes a garment that no edge holds along the axis: the frictionless state's force at its probe edge (N, upwards
/// positive; 0: none to speak of), and the coefficient of friction that would bear it, F / sqrt(C^2 - F^2) with the sum
/// C of the contact forces (tan of the half angle on a cone).
struct Push {
  double force = 0.0, friction_needed = 0.0;
};
Push push(const postproc::RunResult& frictionless, const mesh::GarmentMesh& garment);
/// Says so, and what would help.
std::string no_equilibrium(const Push& push, const input::Case& description, const mesh::GarmentMesh& garment);

}  // namespace snug::solver
