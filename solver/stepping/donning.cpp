#include "solver/stepping/donning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/scene/reactions.hpp"
#include "solver/scene/result.hpp"

namespace snug::solver {

std::string donning_name(double from) {
  if (from == 0.0) return "friction from the start of the tightening";
  return fmt::format("friction over the last {:.0f} % of the tightening", 100.0 * (1.0 - from));
}

postproc::DonningRow donning_row(const std::string& name, double from, bool converged, const Scene& scene,
                                 const State& state, const Model& model, const Meshes& meshes) {
  postproc::RunResult result;
  result.body = body_result(meshes.body, false);
  fill_result(scene, state, model, meshes, result);
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

// Force along the axis that others lying on a garment press it with, N.
double pressed_along(const Scene& scene, const State& state, const std::string& garment) {
  double along = 0.0;
  for (const Touch& touch : scene.touches()) {
    const auto found = std::find(touch.masters.begin(), touch.masters.end(), garment);
    if (!touch.sheet || found == touch.masters.end()) continue;
    const int surface = static_cast<int>(found - touch.masters.begin());
    for (const auto& point : touch.contact->point_forces(state))
      if (point.facet >= 0 && touch.contact->master().surface_of(point.facet) == surface) along -= point.force.z();
  }
  return along;
}

// Sum of the contact forces of a garment, N.
double contact_force(const Scene& scene, const State& state, const Model& model, int garment) {
  const ContactModel* contact = model.contact_of(garment);
  double sum = 0.0;
  if (contact)
    for (const auto& point : scene.find<Contact>(contact->name)->point_forces(state)) sum += point.force.norm();
  return sum;
}

}  // namespace

Push push_on_probes(const Scene& held, const State& state, const Model& model, const Meshes& meshes) {
  Push largest;
  const Eigen::VectorXd residual = held.full_residual(state);
  for (std::size_t g = 0; g < meshes.garments.size(); ++g) {
    if (!model.probed(static_cast<int>(g))) continue;
    const mesh::GarmentMesh& garment = meshes.garments[g];
    const double force = edge_force(held, residual, garment, probe_edge(garment)).z();
    const Push net = push(force, contact_force(held, state, model, static_cast<int>(g)));
    if (std::abs(net.force) > std::abs(largest.force)) largest = net, largest.garment = static_cast<int>(g);
  }
  return largest;
}

Push push_where_it_sticks(const Scene& sticking, const State& state, const Model& model) {
  Push largest;
  const Eigen::VectorXd load = sticking.load_forces(state);  // the garment's weight; on the rigid skin nothing else is loaded
  for (std::size_t g = 0; g < model.garments.size(); ++g) {
    const ContactModel* contact = model.contact_of(static_cast<int>(g));
    if (!model.rubs(static_cast<int>(g)) || !model.garments[g].spec.held.empty()) continue;
    double along = pressed_along(sticking, state, model.garments[g].spec.name), sum = 0.0;
    for (const auto& point : sticking.find<Contact>(contact->name)->point_forces(state)) along += point.force.z(), sum += point.force.norm();
    const Field& garment = sticking.layout()[model.garments[g].spec.name];
    for (int node = 0; node < garment.count; ++node) along += load[garment(node, 2)];
    const Push net = push(-along, sum);
    if (net.friction_needed > largest.friction_needed) largest = net, largest.garment = static_cast<int>(g);
  }
  return largest;
}

std::string no_equilibrium(const Push& push, const Model& model, const Meshes& meshes) {
  const std::string& name = model.garments[push.garment].spec.name;
  std::string text = fmt::format("no equilibrium: nothing holds the {} along the axis and a net force of {:.3g} N pushes it {}", name,
                                 std::abs(push.force), push.force > 0.0 ? "down" : "up");
  const ContactModel* contact = model.contact_of(push.garment);
  if (push.friction_needed > 10.0)
    text += "; no friction bears it, for it hardly touches";
  else if (contact && contact->friction.coefficient > 0.0)
    text += fmt::format("; friction of {:g} does not bear it, about {:.3g} would", contact->friction.coefficient, push.friction_needed);
  return text + fmt::format("; hold an edge: garment.held = [{{ edge = \"{}\", held = \"axis\" }}]", probe_edge(meshes.garments[push.garment]));
}

}  // namespace snug::solver
