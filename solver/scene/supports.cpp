#include "solver/scene/supports.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>

#include <algorithm>

namespace snug::solver {

const mesh::Surface& named_surface(const mesh::BodyMesh& body, const std::string& name, const input::Location& where) {
  if (const mesh::Surface* surface = body.surface(name)) return *surface;
  std::vector<std::string> names;
  for (const auto& surface : body.surfaces) names.push_back(surface.name);
  throw input::InputError(where, fmt::format("the body has no surface \"{}\"", name),
                          fmt::format("its surfaces are {}", fmt::join(names, ", ")));
}

// A garment whose edges stand in space holds the body in it by contact alone.
bool held_by_garment(const Model& model) {
  return std::any_of(model.contacts.begin(), model.contacts.end(), [&](const ContactModel& contact) {
    if (contact.garment < 0) return false;
    const auto& held = model.garments[contact.garment].spec.held;
    return std::any_of(held.begin(), held.end(), [](const auto& edge) { return edge.held == "all"; });
  });
}

Supports::Supports(const Model& model, const mesh::BodyMesh& body, const Layout& layout) : body_(layout["body"]) {
  const input::Case& description = model.asked;
  if (body_.count == 0 || !description.body) return;
  reference_ = body.nodes;
  const auto fix = [&](const std::string& name, const std::vector<int>& nodes, int first) {
    held_.emplace_back(name, std::vector<Held>());
    for (const int node : nodes)
      for (int c = first; c < 3; ++c) prescribe(node, c);
  };
  fix("bone", body.bone_nodes, 0);
  const std::string& ends = description.body->ends;
  for (const char* name : {"lower", "upper"})
    if (const auto* cut = body.surface(name); cut && description.body->kind != "imported" && ends != "free")
      fix(std::string(name) + " cut", cut->nodes, ends == "fixed" ? 0 : 2);
  hold(body.held);
  for (const auto& spec : description.support) hold(body, spec);
  if (!held_by_garment(model)) hold_free_motions(body);
}

void Supports::hold_free_motions(const mesh::BodyMesh& body) {
  std::set<NodeComponent> held;
  for (const int entry : prescribed_) held.emplace((entry - body_.first) / 3, (entry - body_.first) % 3);
  free_ = solver::free_parts(body, held);
  for (const FreePart& part : free_) {
    held_.emplace_back("free motions of " + part.name, std::vector<Held>());
    for (const auto& [node, component] : determinate_supports(part, body)) {
      prescribe(node, component);
      free_entries_.push_back(body_(node, component));
    }
  }
}

void Supports::prescribe(int node, int component) {
  if (prescribed_.insert(body_(node, component)).second) held_.back().second.push_back({node, component});
}

void Supports::hold(const std::vector<mesh::HeldComponent>& held) {
  if (!held.empty()) held_.emplace_back("supports of the file", std::vector<Held>());
  for (const mesh::HeldComponent& one : held) {
    prescribe(one.node, one.component);
    if (one.displacement == 0.0) continue;
    Moving moving{{one.node}, one.displacement * Eigen::Vector3d::Unit(one.component), 0.0, Eigen::Vector2d::Zero(), {}};
    moving.held[one.component] = true;
    moving_.push_back(std::move(moving));
  }
}

void Supports::hold(const mesh::BodyMesh& body, const input::SupportSpec& spec) {
  const mesh::Surface& surface = named_surface(body, spec.on, spec.where);
  const std::array<std::optional<double>, 3> given = {spec.x, spec.y, spec.z};
  held_.emplace_back(spec.on, std::vector<Held>());
  Moving moving{surface.nodes, Eigen::Vector3d::Zero(), spec.turn, Eigen::Vector2d::Zero(), {}};
  for (int c = 0; c < 3; ++c) {
    if (!given[c]) continue;
    moving.held[c] = true, moving.displacement[c] = *given[c];
    for (const int node : surface.nodes) prescribe(node, c);
  }
  if (moving.displacement.isZero(0.0) && spec.turn == 0.0) return;
  for (const int node : surface.nodes)
    moving.middle += body.nodes[node].head<2>() / static_cast<double>(surface.nodes.size());
  moving_.push_back(std::move(moving));
}

void check_balance(const Supports& supports, const mesh::BodyMesh& body, const std::vector<Eigen::Vector3d>& forces,
                   const input::Location& where) {
  for (const FreePart& part : supports.free_parts()) {
    const NetLoad net = net_load(part, body, forces);
    if (net.balanced) continue;
    std::vector<std::string> loads;
    const auto note = [&](Eigen::Vector3d v, double floor, const char* text) {
      v = (v.array().abs() > floor).select(v, 0.0);
      if (!v.isZero(0.0)) loads.push_back(fmt::format("({:.4g}, {:.4g}, {:.4g}) {}", v.x(), v.y(), v.z(), text));
    };
    const double size = std::max(net.force.norm(), net.moment.norm() / part.size);
    note(net.force, 1e-6 * size, "N"), note(net.moment, 1e-6 * size * part.size, "N m about its middle");
    throw input::InputError(where, fmt::format("{} is free {}, and its loads do not balance: {} is left", part.name, motions_text(part),
                                               fmt::join(loads, " and ")),
                            "hold it with a [[support]] (of a limb: ends = \"sliding\" or \"fixed\", or a rigid bone), or add the load that balances");
  }
}

std::vector<int> Supports::entries() const {
  return {prescribed_.begin(), prescribed_.end()};
}

Eigen::VectorXd Supports::gap(const State& state) const {
  if (moving_.empty()) return {};
  Eigen::VectorXd gap = Eigen::VectorXd::Zero(state.values.size());
  for (const Moving& moving : moving_) {
    const Eigen::Rotation2D<double> turn(state.load * moving.turn);
    for (const int node : moving.nodes) {
      Eigen::Vector3d target = reference_[node] + state.load * moving.displacement;
      if (moving.turn != 0.0)
        target.head<2>() += turn * (reference_[node].head<2>() - moving.middle) - (reference_[node].head<2>() - moving.middle);
      for (int c = 0; c < 3; ++c)
        if (moving.held[c]) gap[body_(node, c)] = target[c] - state.values[body_(node, c)];
    }
  }
  return gap;
}

}  // namespace snug::solver
