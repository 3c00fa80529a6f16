#include "solver/scene/supports.hpp"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "solver/scene/tools.hpp"

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
    return std::any_of(held.begin(), held.end(), [](const auto& edge) { return edge.held == input::HeldDirection::all; });
  });
}

namespace {

/// Of a flat surface, by the largest triangle of three of its nodes with the first.
Eigen::Vector3d plane_normal(const mesh::Surface& surface, const mesh::BodyMesh& body) {
  const Eigen::Vector3d& first = body.nodes[surface.nodes.front()];
  const auto farthest = [&](auto measure) {
    return *std::max_element(surface.nodes.begin(), surface.nodes.end(), [&](int a, int b) { return measure(body.nodes[a]) < measure(body.nodes[b]); });
  };
  const Eigen::Vector3d along = body.nodes[farthest([&](const auto& x) { return (x - first).norm(); })] - first;
  const auto across = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d { return along.cross(x - first); };
  return across(body.nodes[farthest([&](const auto& x) { return across(x).norm(); })]).normalized();
}

}  // namespace

Supports::Supports(const Model& model, const mesh::BodyMesh& body, const Layout& layout, std::shared_ptr<const Carrier> carrier)
    : body_(layout["body"]), carrier_(std::move(carrier)), table_(layout.size()) {
  const input::Case& description = model.asked;
  if (body_.count == 0 || !description.body) return;
  hold_limb(*description.body, description.support, body);
  hold(body.held, description.body->where, body);
  hold_along(body.held_along, description.body->where, body);
  for (const auto& spec : description.support) hold(spec, body);
  resolve_lines(body);
  if (!held_by_garment(model)) hold_free_motions(body);
  for (const input::ToolSpec& tool : description.tools) move(tool, layout[tip_field(tool)], body);
}

void Supports::prescribe(int node, int component, int holder, const Motion& motion, const mesh::BodyMesh& body) {
  const int number = body.node_numbers.empty() ? node + 1 : body.node_numbers[node];
  if (!carries(body_(node))) return table_.prescribe(body_(node, component), holder, component, motion, body.nodes[node], number);
  carried_.insert(body_(node));
  for (int c = 0; c < 3; ++c) table_.prescribe(body_(node, c), holder, c, {}, body.nodes[node], number);
}

void Supports::carry(int first) {
  carried_.insert(first);
  for (int c = 0; c < 3; ++c) table_.fix(first + c);
}

Eigen::VectorXd Supports::gap(const State& state) const {
  Eigen::VectorXd gap = table_.gap(state.values, state.load);
  if (carried_.empty()) return gap;
  if (gap.size() == 0) gap = Eigen::VectorXd::Zero(state.values.size());
  for (const int first : carried_) gap.segment<3>(first) = carrier_->place(first, state.posture) - state.values.segment<3>(first);
  return gap;
}

void Supports::hold_limb(const input::BodySpec& spec, const std::vector<input::SupportSpec>& supports, const mesh::BodyMesh& body) {
  const auto same = [&](const std::string& one, const std::string& other) {  // a surface may have two names
    const mesh::Surface *a = body.surface(one), *b = body.surface(other);
    return one == other || (a && b && a->nodes == b->nodes);
  };
  const std::function<bool(const std::string&, int)> said = [&](const std::string& surface, int c) {  // by a support of the case, whose word counts then
    return std::any_of(supports.begin(), supports.end(), [&](const auto& s) { return std::array{s.x, s.y, s.z}[c] && same(s.on, surface); });
  };
  const auto fix = [&](const std::string& name, const std::string& surface, const std::vector<int>& nodes, int first) {
    const int holder = table_.add({name, spec.where});
    for (const int node : nodes)
      for (int c = first; c < 3; ++c)
        if (!said(surface, c) && (surface == "bone" || !bone_.contains(node))) prescribe(node, c, holder, {}, body);
  };
  bone_.insert(body.bone_nodes.begin(), body.bone_nodes.end());
  fix("bone", "bone", body.bone_nodes, 0);
  if (spec.kind == input::BodyKind::imported || spec.ends == input::Ends::free) return;
  if (!spec.scan || spec.scan->cuts.empty())
    for (const char* surface : {"lower", "upper"})
      if (const auto* cut = body.surface(surface)) fix(std::string(surface) + " cut", surface, cut->nodes, spec.ends == input::Ends::fixed ? 0 : 2);
  if (!spec.scan) return;
  for (const input::NamedCut& cut : spec.scan->cuts) {
    const mesh::Surface* surface = body.surface(cut.name);
    if (!surface) continue;
    if (spec.ends == input::Ends::fixed) fix("cut \"" + cut.name + "\"", cut.name, surface->nodes, 0);
    else slide(cut.name, *surface, said, body);
  }
}

/// Nodes stay in the plane of a cut. Across an axis that is a component; in a tilted plane they keep their place along its normal.
void Supports::slide(const std::string& name, const mesh::Surface& cut, const std::function<bool(const std::string&, int)>& said, const mesh::BodyMesh& body) {
  const Eigen::Vector3d normal = plane_normal(cut, body);
  int across = 0;
  const bool along_axis = normal.cwiseAbs().maxCoeff(&across) > 1.0 - 1e-9;
  if (along_axis ? said(name, across) : said(name, 0) || said(name, 1) || said(name, 2)) return;
  const int holder = table_.add({"cut \"" + name + "\""});
  for (const int node : cut.nodes) {
    if (bone_.contains(node)) continue;
    if (along_axis || carries(body_(node))) prescribe(node, across, holder, {}, body);
    else lines_[node].push_back({holder, normal, 0.0});
  }
}

void Supports::hold_along(const std::vector<mesh::HeldAlong>& held, const input::Location& where, const mesh::BodyMesh& body) {
  if (held.empty()) return;
  const int holder = table_.add({"supports of the file", where});
  for (const mesh::HeldAlong& one : held)
    if (carries(body_(one.node))) prescribe(one.node, 0, holder, {}, body);
    else lines_[one.node].push_back({holder, one.direction, one.displacement});
}

void Supports::move(const input::ToolSpec& tool, const Field& tip, const mesh::BodyMesh& body) {
  const PlacedTool placed = place_tool(body, tool);
  const Motion motion{.displacement = tool.travel * placed.shape.direction};
  const int holder = table_.add({tool.name, tool.where});
  for (int c = 0; c < 3; ++c) table_.prescribe(tip(0, c), holder, c, motion, placed.start, 0);
}

/// When all else is prescribed.
void Supports::resolve_lines(const mesh::BodyMesh& body) {
  std::map<int, std::vector<int>> of_holder;
  for (const auto& [node, lines] : lines_) {
    const int number = body.node_numbers.empty() ? node + 1 : body.node_numbers[node];
    table_.hold_along(body_(node, 0), lines, body.nodes[node], number);
    of_holder[lines.front().holder].push_back(body_(node, 0));
  }
  for (const auto& [holder, first] : of_holder) oblique_.push_back({table_.holders()[holder].name, first});
}

void Supports::hold(const std::vector<mesh::HeldComponent>& held, const input::Location& where, const mesh::BodyMesh& body) {
  if (held.empty()) return;
  const int holder = table_.add({"supports of the file", where});
  for (const mesh::HeldComponent& one : held)
    prescribe(one.node, one.component, holder, {.displacement = one.displacement * Eigen::Vector3d::Unit(one.component)}, body);
}

void Supports::hold(const input::SupportSpec& spec, const mesh::BodyMesh& body) {
  const mesh::Surface& surface = named_surface(body, spec.on, spec.where);
  const std::array<std::optional<double>, 3> given = {spec.x, spec.y, spec.z};
  const int holder = table_.add({spec.on, spec.where});
  Motion motion{.turn = spec.turn};
  for (int c = 0; c < 3; ++c) motion.displacement[c] = given[c].value_or(0.0);
  for (const int node : surface.nodes) motion.middle += body.nodes[node].head<2>() / static_cast<double>(surface.nodes.size());
  for (const int node : surface.nodes)
    for (int c = 0; c < 3; ++c)
      if (given[c] && (spec.on == "bone" || !bone_.contains(node))) prescribe(node, c, holder, motion, body);
}

void Supports::hold_free_motions(const mesh::BodyMesh& body) {
  std::set<NodeComponent> held;
  for (const int entry : table_.prescribed_entries()) held.emplace((entry - body_.first) / 3, (entry - body_.first) % 3);
  std::vector<NodeLine> lines;
  std::set<int> with_lines;
  for (const auto& [node, own] : lines_) {
    with_lines.insert(node);
    for (const Line& line : own) lines.push_back({node, line.direction});
  }
  free_ = solver::free_parts(body, held, lines);
  for (const FreePart& part : free_) {
    const int holder = table_.add({"free motions of " + part.name});
    for (const auto& [node, component] : determinate_supports(part, body, with_lines)) {
      prescribe(node, component, holder, {}, body);
      free_entries_.push_back(body_(node, component));
    }
  }
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

}  // namespace snug::solver
