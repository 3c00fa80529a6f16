#include "solver/stepping/donning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/scene/friction_choice.hpp"
#include "solver/scene/result.hpp"

namespace snug::solver {

std::string donning_name(double from) {
  if (from == 0.0) return "friction from the start of the tightening";
  return fmt::format("friction over the last {:.0f} % of the tightening", 100.0 * (1.0 - from));
}

postproc::DonningRow donning_row(const std::string& name, double from, bool converged, const Scene& scene,
                                 const State& state, const Meshes& meshes) {
  postproc::RunResult result;
  result.body = body_result(meshes.body, false);
  fill_result(scene, state, meshes.body, meshes.garment, result);
  const auto number = [&](const char* name_of) {
    const auto it = result.numbers.find(name_of);
    return it == result.numbers.end() ? 0.0 : it->second;
  };
  return {name, from, converged, number("mean_contact_pressure_Pa"), number("max_contact_pressure_Pa")};
}

namespace {

Push push(double force, double contact) {
  if (std::abs(force) <= 1e-5 * contact) return {};
  return {force, std::abs(force) / std::sqrt(std::max(1e-30, contact * contact - force * force))};
}

}  // namespace

Push push(const postproc::RunResult& frictionless, const mesh::GarmentMesh& garment) {
  const auto& balance = frictionless.balance;
  const auto it = balance.reactions.find(probe_edge(garment) + " edge");
  return push(it == balance.reactions.end() ? 0.0 : it->second.z(), balance.contact_force);
}

Push push(const Scene& sticking, const State& state) {
  double along = 0.0, sum = 0.0;
  for (const auto& point : sticking.find<Contact>()->point_forces(state)) along += point.force.z(), sum += point.force.norm();
  const Eigen::VectorXd load = sticking.load_forces(state);  // the garment's weight; on the rigid skin nothing else is loaded
  const Field& garment = sticking.layout()["garment"];
  for (int node = 0; node < garment.count; ++node) along += load[garment(node, 2)];
  return push(-along, sum);
}

std::string no_equilibrium(const Push& push, const input::Case& description, const mesh::GarmentMesh& garment) {
  std::string text =
      fmt::format("no equilibrium: nothing holds the garment along the axis and a net force of {:.3g} N pushes it {}",
                  std::abs(push.force), push.force > 0.0 ? "down" : "up");
  if (push.friction_needed > 10.0)
    text += "; no friction bears it, for it hardly touches";
  else if (has_friction(description))
    text += fmt::format("; friction of {:g} does not bear it, about {:.3g} would", friction_choice(description).coefficient,
                        push.friction_needed);
  return text + fmt::format("; hold an edge: garment.held = [{{ edge = \"{}\", held = \"axis\" }}]", probe_edge(garment));
}

}  // namespace snug::solver
