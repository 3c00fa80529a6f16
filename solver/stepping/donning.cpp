#include "solver/stepping/donning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/scene/result.hpp"

namespace snug::solver {

namespace {

// Friction over the last half and the last tenth of the way: bounds of what a careful and a quick wearer may do.
constexpr std::array<double, 2> spread = {0.5, 0.9};

}  // namespace

input::Case without_friction(const input::Case& description) {
  input::Case smooth = description;
  if (smooth.contact) smooth.contact->friction = 0.0;
  return smooth;
}

std::vector<double> donning_variations(const input::Case& description) {
  std::vector<double> list;
  for (const double from : spread)
    if (std::abs(from - description.contact->friction_from) > 1e-9) list.push_back(from);
  return list;
}

std::vector<double> donning_stops(const input::Case& description) {
  std::vector<double> stops = donning_variations(description);
  stops.push_back(description.contact->friction_from);
  if (stops.back() < 1.0) stops.push_back(1.0);
  std::sort(stops.begin(), stops.end());
  return stops;
}

std::string donning_name(double from) {
  if (from == 1.0) return "friction on the tightened garment";
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

Push push(const postproc::RunResult& frictionless, const mesh::GarmentMesh& garment) {
  const auto& balance = frictionless.balance;
  const auto it = balance.reactions.find(probe_edge(garment) + " edge");
  const double force = it == balance.reactions.end() ? 0.0 : it->second.z(), contact = balance.contact_force;
  if (std::abs(force) <= 1e-5 * contact) return {};
  return {force, std::abs(force) / std::sqrt(std::max(1e-30, contact * contact - force * force))};
}

std::string no_equilibrium(const Push& push, const input::Case& description, const mesh::GarmentMesh& garment) {
  std::string text =
      fmt::format("no equilibrium: nothing holds the garment along the axis and a net contact force of {:.3g} N pushes it {}",
                  std::abs(push.force), push.force > 0.0 ? "down" : "up");
  if (has_friction(description))
    text += fmt::format("; friction of {:g} does not bear it, about {:.3g} would", description.contact->friction,
                        push.friction_needed);
  return text + fmt::format("; hold an edge: garment.held = [{{ edge = \"{}\", held = \"axis\" }}]", probe_edge(garment));
}

}  // namespace snug::solver
