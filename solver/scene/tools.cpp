#include "solver/scene/tools.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/scene/scene.hpp"
#include "solver/terms/tool_friction.hpp"

namespace snug::solver {

namespace {

Eigen::Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

RigidTool shape_of(const input::ToolSpec& tool) {
  const double round = tool.shape == input::ToolShape::sphere ? tool.radius : tool.edge_radius;
  return {vector(tool.direction).normalized(), tool.radius - round, round};
}

/// What faces the tool near its line: a surface may turn round the body.
std::vector<mesh::FacetNodeNumbers> facing(const mesh::BodyMesh& body, const mesh::Surface& surface, const RigidTool& shape,
                                           const Eigen::Vector3d& tip, double beside) {
  const mesh::FacetKind kind = facet_kind(body.kind);
  const FacetShape centre = facet_shape(kind, facet_domain(kind).centre);
  std::vector<mesh::FacetNodeNumbers> found;
  for (const auto& facet : surface.facets) {
    const FacetNodes x = facet_positions(body, facet);
    double nearest = std::numeric_limits<double>::infinity();
    for (int a = 0; a < node_count(kind); ++a) {
      const Eigen::Vector3d r = x.col(a) - tip;
      nearest = std::min(nearest, (r - r.dot(shape.direction) * shape.direction).norm());
    }
    if (nearest < beside && facet_point(x, centre).n.dot(shape.direction) < 0.0) found.push_back(facet);
  }
  return found;
}

/// What the tool meets first on its way from `tip`, and how deep the tip's place lies in the body, m.
struct Meeting {
  double way = std::numeric_limits<double>::infinity(), inside = 0.0;
};
Meeting meet(const mesh::BodyMesh& body, const ToolSurface& surface, const RigidTool& shape, const Eigen::Vector3d& tip) {
  Meeting meeting;
  for (const auto& facet : surface.facets) {
    const FacetNodes x = facet_positions(body, facet);
    const auto look = [&](const Eigen::Vector3d& at) {
      meeting.way = std::min(meeting.way, shape.way_to(at - tip));
      meeting.inside = std::max(meeting.inside, -shape.gap(at - tip).value);
    };
    for (const ToolPoint& q : tool_points(surface.kind)) look(x * q.shape.N);
    for (int a = 0; a < node_count(surface.kind); ++a) look(x.col(a));
  }
  return meeting;
}

std::string place(const Eigen::Vector3d& x) { return fmt::format("({:.4g}, {:.4g}, {:.4g}) mm", 1e3 * x.x(), 1e3 * x.y(), 1e3 * x.z()); }

std::string text_of_shape(const RigidTool& shape) {
  return shape.flat > 0.0 ? fmt::format("disc of radius {:.4g} mm, edge rounded by {:.4g} mm", 1e3 * shape.radius(), 1e3 * shape.round)
                          : fmt::format("ball of radius {:.4g} mm", 1e3 * shape.round);
}

const ToolContact& contact_of(const Scene& scene, const input::ToolSpec& tool) { return *scene.find<ToolContact>(tool_pressures(tool)); }

std::string tool_friction(const input::ToolSpec& tool) { return "friction of " + tool.name; }

/// All that the surface puts on the tool: `rubbing` the sum of the tangential point forces.
struct Action {
  ToolContact::Sums sums;
  double rubbing = 0.0;
};
Action action(const Scene& scene, const State& state, const input::ToolSpec& tool) {
  Action all{.sums = contact_of(scene, tool).sums(state)};
  const auto* friction = scene.find<ToolFriction>(tool_friction(tool));
  if (!friction) return all;
  const ToolContact::Sums rubbing = friction->sums(state);
  all.sums.force += rubbing.force, all.sums.moment += rubbing.moment, all.rubbing = rubbing.pressing;
  return all;
}

bool in_scene(const Scene& scene, const Model& model) { return !model.asked.tools.empty() && scene.layout()["body"].count > 0; }

postproc::ToolRow row_of(const State& state, const Field& tip, const PlacedTool& placed, const Action& action) {
  const ToolContact::Sums& sums = action.sums;
  const Eigen::Vector3d& d = placed.shape.direction;
  postproc::ToolRow row;
  row.travel = (Eigen::Vector3d(state.values.segment<3>(tip(0))) - placed.start).dot(d);
  row.depth = std::max(0.0, row.travel - placed.first_touch);
  row.force = -sums.force.dot(d);
  row.across = (sums.force - sums.force.dot(d) * d).norm();
  row.area = sums.area, row.largest_pressure = sums.largest_pressure, row.friction_force = action.rubbing;
  return row;
}

/// Gaps are closed in the mean over the cells round a vertex: a contact that is small beside them is not seen, or too soft, as the surface slips round the tool between vertices. Of a block
/// 20 mm thick below a disc of radius 12 mm, edge 3 mm, pressed 2 mm in, cells of 3.3 mm leave 0.31 of the depth inside, those of 6.7 mm 0.87 and a fifth of the force is missing.
constexpr double most_inside = 0.1, no_answer_inside = 1.0 / 3.0;  // of the depth

void judge_mesh(const postproc::ToolResult& tool, double inside, const PlacedTool& placed, postproc::RunResult& result) {
  const double depth = tool.end().depth;
  if (depth <= 0.0 || inside <= most_inside * depth) return;
  const std::string text = fmt::format("points of {} lie up to {:.3g} mm inside {}, which is {:.3g} mm deep: its cells of {:.3g} mm are coarse beside the contact", tool.surface, 1e3 * inside,
                                       tool.name, 1e3 * depth, 1e3 * placed.surface.mean_edge);
  const std::string remedy = "refine the mesh below the tool (a quarter of its contact's radius, or its edge's), or press deeper";
  if (tool.end().force <= 0.0) result.status = postproc::Status::failed, result.message = text + "; no force is found; " + remedy;
  else if (result.status == postproc::Status::converged && inside > no_answer_inside * depth) result.status = postproc::Status::failed, result.message = text + "; " + remedy;
  else if (result.status != postproc::Status::converged) result.message += (result.message.empty() ? "" : "; ") + text + "; " + remedy;
  else result.warnings.push_back({.name = "coarse mesh below a tool", .text = text, .place = tool.surface, .remedy = remedy, .quantity = "penetration", .value = inside, .limit = most_inside * depth});
}

}  // namespace

std::string tip_field(const input::ToolSpec& tool) { return tool.name; }

std::string tool_pressures(const input::ToolSpec& tool) { return "contact of " + tool.name; }

PlacedTool place_tool(const mesh::BodyMesh& body, const input::ToolSpec& tool) {
  PlacedTool placed{.shape = shape_of(tool), .start = vector(tool.tip), .surface = {}};
  const mesh::Surface& surface = named_surface(body, tool.on, tool.where);
  const double beside = placed.shape.radius() + std::max(tool.travel, placed.shape.radius());
  placed.surface = tool_surface(body, facing(body, surface, placed.shape, placed.start, beside));
  const Meeting meeting = meet(body, placed.surface, placed.shape, placed.start);
  if (!std::isfinite(meeting.way))
    throw input::InputError(tool.where, fmt::format("the way of \"{}\" from {} misses the surface \"{}\": nothing of it that faces the tool lies within {:.4g} mm of its line",
                                                    tool.name, place(placed.start), tool.on, 1e3 * placed.shape.radius()),
                            "let the line through tip along direction go into the body, where the surface is");
  if (tool.from_touch) {
    placed.start += meeting.way * placed.shape.direction;
    return placed;
  }
  const double small = 1e-9 * placed.shape.radius();
  if (meeting.inside > small)
    throw input::InputError(tool.where, fmt::format("\"{}\" starts {:.4g} mm inside the body", tool.name, 1e3 * meeting.inside),
                            fmt::format("start outside: move tip back by {:.4g} mm at least, or write from_touch = true", -1e3 * meeting.way));
  if (meeting.way >= tool.travel)
    throw input::InputError(tool.where, fmt::format("the travel of \"{}\" ends {:.4g} mm before the surface \"{}\"", tool.name, 1e3 * (meeting.way - tool.travel), tool.on),
                            fmt::format("let it travel farther than {:.4g} mm, or write from_touch = true", 1e3 * meeting.way));
  placed.first_touch = meeting.way;
  return placed;
}

double way_to_what_is_held(const mesh::BodyMesh& body, const std::vector<input::SupportSpec>& supports, const PlacedTool& placed) {
  std::vector<char> held(body.nodes.size(), 0);
  for (const int node : body.bone_nodes) held[node] = 1;
  for (const input::SupportSpec& support : supports)
    if (const mesh::Surface* surface = body.surface(support.on); surface && support.x && support.y && support.z && !support.moves())
      for (const int node : surface->nodes) held[node] = 1;
  double way = std::numeric_limits<double>::infinity();
  const mesh::FacetKind kind = facet_kind(body.kind);
  for (const auto& facet : mesh::boundary_facets(body, held)) {
    const FacetNodes x = facet_positions(body, facet);
    if (facet_point(x, facet_shape(kind, facet_domain(kind).centre)).n.dot(placed.shape.direction) <= 0.0) continue;  // it is met from within the body
    for (const ToolPoint& q : tool_points(kind)) way = std::min(way, placed.shape.way_to(x * q.shape.N - placed.start));
    for (int a = 0; a < node_count(kind); ++a) way = std::min(way, placed.shape.way_to(x.col(a) - placed.start));
  }
  return way;
}

std::vector<std::string> tool_parts(const Model& model, const mesh::BodyMesh& body) {
  std::vector<std::string> parts;
  if (!model.deformable()) return parts;
  for (const input::ToolSpec& tool : model.asked.tools) {
    const PlacedTool placed = place_tool(body, tool);
    parts.push_back(fmt::format("{}: rigid {}, moved by {:.4g} mm from {}, touches {} after {:.4g} mm; {} facets may meet it, {}", tool.name, text_of_shape(placed.shape),
                                1e3 * tool.travel, place(placed.start), tool.on, 1e3 * placed.first_touch, placed.surface.facets.size(),
                                tool.friction > 0.0 ? fmt::format("friction {:g}", tool.friction) : "no friction"));
  }
  return parts;
}

void add_tools(const Model& model, const mesh::BodyMesh& body, double (*stiffness)(const Model&, double), Scene& scene) {
  for (const input::ToolSpec& tool : model.asked.tools) {
    PlacedTool placed = place_tool(body, tool);
    const Layout& layout = scene.layout();
    const double edge = placed.surface.mean_edge;
    const ToolContact& contact = scene.add(std::make_unique<ToolContact>(tool_pressures(tool), ToolContact::Fields{layout["body"], layout[tip_field(tool)], layout[tool_pressures(tool)]}, body,
                                            std::move(placed.surface), placed.shape, stiffness(model, edge)));
    if (tool.friction > 0.0)
      scene.add(std::make_unique<ToolFriction>(tool_friction(tool), contact, tool.friction, Friction::usual_elastic_slip * edge));
  }
}

std::vector<postproc::ToolRow> tool_rows(const Scene& scene, const State& state, const Model& model, const mesh::BodyMesh& body) {
  std::vector<postproc::ToolRow> rows;
  if (!in_scene(scene, model)) return rows;
  for (const input::ToolSpec& tool : model.asked.tools) rows.push_back(row_of(state, scene.layout()[tip_field(tool)], place_tool(body, tool), action(scene, state, tool)));
  return rows;
}

void fill_tools(const Scene& scene, const State& state, const Model& model, const mesh::BodyMesh& body,
                const std::vector<std::vector<postproc::ToolRow>>& way, postproc::RunResult& result) {
  if (!in_scene(scene, model)) return;
  for (std::size_t t = 0; t < model.asked.tools.size(); ++t) {
    const input::ToolSpec& tool = model.asked.tools[t];
    const PlacedTool placed = place_tool(body, tool);
    const Action all = action(scene, state, tool);
    const ToolContact::Sums& sums = all.sums;
    postproc::ToolResult found{.name = tool.name, .surface = tool.on, .shape = text_of_shape(placed.shape), .direction = placed.shape.direction,
                               .tip = placed.start, .reaction = sums.force, .history = {}};
    found.history.emplace_back();  // the start: it touches at most
    if (t < way.size()) found.history.insert(found.history.end(), way[t].begin(), way[t].end());
    const postproc::ToolRow end = row_of(state, scene.layout()[tip_field(tool)], placed, all);
    if (found.history.back().travel != end.travel) found.history.push_back(end);
    result.balance.contact_force += sums.pressing, result.balance.friction_force += all.rubbing;
    result.balance.moment_error -= sums.moment;  // the guide bears it: a tool does not turn
    const std::string name = model.asked.tools.size() == 1 ? "tool" : tool.name;
    result.numbers[name + "_force_N"] = end.force, result.numbers[name + "_depth_m"] = end.depth;
    result.numbers[name + "_stiffness_N_per_m"] = found.stiffness(), result.numbers[name + "_contact_area_m2"] = end.area;
    result.numbers[name + "_largest_pressure_Pa"] = end.largest_pressure;
    result.numbers[name + "_penetration_m"] = sums.inside;
    judge_mesh(found, sums.inside, placed, result);
    result.tools.push_back(std::move(found));
  }
}

double tool_edge(const Model& model, const mesh::BodyMesh& body) {
  double edge = std::numeric_limits<double>::infinity();
  if (model.deformable())
    for (const input::ToolSpec& tool : model.asked.tools) edge = std::min(edge, place_tool(body, tool).surface.mean_edge);
  return edge;
}

int tool_steps(const Model& model) {
  int steps = 1;
  for (const input::ToolSpec& tool : model.asked.tools) steps = std::max(steps, tool.steps);
  return steps;
}

}  // namespace snug::solver
