#include "solver/scene/constraints.hpp"

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <set>

#include "materials/laws/solid_law.hpp"
#include "solver/algebra/communicator.hpp"
#include "solver/scene/friction_choice.hpp"
#include "solver/scene/partition.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/pressure_unknowns.hpp"
#include "solver/terms/master_surface.hpp"

namespace snug::solver {

namespace {

using Constraints = dealii::AffineConstraints<double>;

void fix(Constraints& constraints, int entry) {
  if (!constraints.is_constrained(entry)) constraints.add_line(entry);
}

/// Pressures of layers whose law has none are not part of the system, nor are the fields of hexahedra.
void constrain_pressures(const mesh::BodyMesh& body, const Layout& layout, Constraints& constraints) {
  const std::vector<int> layer = pressure_unknowns(body).layer;
  for (std::size_t i = 0; i < layer.size(); ++i)
    if (!materials::is_split(materials::find_tissue(body.layers[layer[i]].material).law))
      fix(constraints, layout["body pressure"](static_cast<int>(i)));
  for (int i = 0; i < layout["body cells"].count; ++i) fix(constraints, layout["body cells"](i));
}

// Unit tangent of the skin at the foot point of x along the body's axis: the axis without its part along the normal. The axis
// itself where x faces no skin.
Eigen::Vector3d meridian(const MasterSurface& skin, const mesh::BodyMesh& body, const Eigen::Vector3d& x) {
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  const Site foot = skin.find(State{}, x);
  if (foot.facet < 0) return axis;
  const FacetNodes nodes = facet_positions(body, skin.nodes_of(foot.facet));
  const Eigen::Vector3d n = facet_point(nodes, facet_shape(skin.kind(), foot.xi)).n;
  return (axis - axis.dot(n) * n).normalized();
}

// A node moves freely round and off the body but not along its meridian m: m . u = 0, solved for the largest component.
void hold_along(const Eigen::Vector3d& m, int first, Constraints& constraints) {
  constexpr double round_off = 1e-12;  // of a unit tangent: a cylinder's has one component
  int largest = 2;
  m.cwiseAbs().maxCoeff(&largest);
  if (constraints.is_constrained(first + largest)) return;
  constraints.add_line(first + largest);
  for (int c = 0; c < 3; ++c)
    if (c != largest && std::abs(m[c]) > round_off) constraints.add_entry(first + largest, first + c, -m[c] / m[largest]);
}

void hold_edges(const std::vector<input::HeldEdge>& held, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                const Layout& layout, Constraints& constraints) {
  for (const auto& edge : held)
    if (edge.held == "all")
      for (const int node : garment.edges.at(edge.edge))
        for (int c = 0; c < 3; ++c) fix(constraints, layout["garment"](node, c));
  if (std::none_of(held.begin(), held.end(), [](const auto& edge) { return edge.held == "axis"; })) return;
  const MasterSurface skin({}, body, body.skin_facets);
  for (const auto& edge : held)
    if (edge.held == "axis")
      for (const int node : garment.edges.at(edge.edge))
        hold_along(meridian(skin, body, garment.placed[node]), layout["garment"](node), constraints);
}

bool turns_freely(const input::GarmentSpec& spec) {
  return std::none_of(spec.held.begin(), spec.held.end(), [](const auto& edge) { return edge.held == "all"; });
}

void constrain_garment(const input::Case& description, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                       const Layout& layout, Constraints& constraints) {
  auto held = description.garment->held;
  if (slides_freely(description) && !has_friction(description)) held.push_back({.edge = probe_edge(garment), .held = "axis"});
  hold_edges(held, body, garment, layout, constraints);
  if (turns_freely(*description.garment) && !has_friction(description)) {
    const TurnPin pin = turn_pin(garment);
    fix(constraints, layout["garment"](pin.node, pin.component));
  }
  if (garment.order == 1)
    for (const auto& triangle : garment.triangles)
      for (int k = 3; k < 6; ++k)
        for (int c = 0; c < 3; ++c) fix(constraints, layout["garment"](garment.merged[triangle[k]], c));
  for (std::size_t node = 0; node < garment.merged.size(); ++node) {
    if (garment.merged[node] == static_cast<int>(node)) continue;
    for (int c = 0; c < 3; ++c) {  // a seam: this side follows the other
      const int entry = layout["garment"](static_cast<int>(node), c);
      constraints.add_line(entry);
      constraints.add_entry(entry, layout["garment"](garment.merged[node], c), 1.0);
    }
  }
}

}  // namespace

std::string probe_edge(const mesh::GarmentMesh& garment) {
  const auto width = [&](const std::string& name) {
    const auto& edge = garment.edges.at(name);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int node : edge) centre += garment.placed[node] / static_cast<double>(edge.size());
    double sum = 0.0;
    for (const int node : edge) sum += (garment.placed[node] - centre).norm();
    return sum / static_cast<double>(edge.size());
  };
  return width("lower") > (1.0 + 1e-6) * width("upper") ? "lower" : "upper";
}

TurnPin turn_pin(const mesh::GarmentMesh& garment) {
  const auto& edge = garment.edges.at("upper");
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int node : edge) centre += garment.placed[node] / static_cast<double>(edge.size());
  const int seam = *std::min_element(edge.begin(), edge.end(), [&](int a, int b) {
    return garment.pattern[a].x() < garment.pattern[b].x();
  });
  const Eigen::Vector3d arm = garment.placed[seam] - centre;
  return {seam, std::abs(arm.x()) > std::abs(arm.y()) ? 1 : 0};
}

void add_positions(Layout& layout, const std::string& part, const mesh::BodyMesh& mesh) {
  layout.add({.name = part, .count = static_cast<int>(mesh.nodes.size()), .components = 3});
}

void add_pressures(Layout& layout, const std::string& part, const mesh::BodyMesh& mesh) {
  const int unknowns = static_cast<int>(pressure_unknowns(mesh).layer.size());
  const int fields = 2 * pressure_modes(mesh.kind) * static_cast<int>(mesh.cells.size());
  if (unknowns > 0) layout.add({.name = part + " pressure", .rows = Rows::constraint, .count = unknowns});
  if (fields > 0) layout.add({.name = part + " cells", .rows = Rows::cell, .count = fields});
}

void add_multipliers(Layout& layout, const std::string& interface, int vertices) {
  layout.add({.name = interface, .rows = Rows::constraint, .count = vertices, .non_negative = true});
}

Tissue::Fields body_fields(const Layout& layout, const std::string& part) {
  return {layout[part], layout[part + " pressure"], layout[part + " cells"]};
}

Layout make_layout(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, bool deformable, bool contact) {
  Layout layout;
  if (deformable) add_positions(layout, "body", body);
  if (!garment.pattern.empty()) layout.add({.name = "garment", .count = static_cast<int>(garment.pattern.size()), .components = 3});
  if (deformable) add_pressures(layout, "body", body);
  if (contact) {
    std::set<int> vertices;
    for (const auto& triangle : garment.triangles)
      for (int v = 0; v < 3; ++v) vertices.insert(garment.merged[triangle[v]]);
    add_multipliers(layout, "contact", static_cast<int>(vertices.size()));
  }
  return layout;
}

bool slides_freely(const input::Case& description) { return description.garment && description.garment->held.empty(); }

Numbering make_numbering(const input::Case& description, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                         const Layout& layout, const Supports& supports) {
  Constraints constraints;
  if (layout["body"].count > 0) {
    constrain_pressures(body, layout, constraints);
    for (const int entry : supports.entries()) fix(constraints, entry);
  }
  if (layout["garment"].count > 0) constrain_garment(description, body, garment, layout, constraints);
  constraints.close();
  std::vector<int> master(layout.size());
  Bound bound;
  for (int i = 0; i < layout.size(); ++i) {
    master[i] = i;
    if (!constraints.is_constrained(i)) continue;
    const auto& line = *constraints.get_constraint_entries(i);
    const bool sewn = line.size() == 1 && line.front().second == 1.0 && static_cast<int>(line.front().first) / 3 != i / 3;
    master[i] = sewn ? static_cast<int>(line.front().first) : -1;
    if (!sewn)
      for (const auto& [entry, weight] : line) bound[i].push_back({static_cast<int>(entry), weight});
  }
  std::vector<int> vertex_node;  // in the order in which contact numbers its multipliers
  if (layout["contact"].count > 0) {
    std::vector<char> seen(garment.pattern.size(), 0);
    for (const auto& triangle : garment.triangles)
      for (int v = 0; v < 3; ++v)
        if (const int node = garment.merged[triangle[v]]; !seen[node]) seen[node] = 1, vertex_node.push_back(node);
  }
  return Numbering(std::move(master), entry_owners(layout, body, garment, vertex_node, ranks()), ranks(),
                   std::move(bound));
}

}  // namespace snug::solver
