#include "solver/scene/constraints.hpp"

#include <algorithm>
#include <set>

#include "materials/laws/solid_law.hpp"
#include "solver/algebra/communicator.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/partition.hpp"
#include "solver/scene/tools.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/pressure_unknowns.hpp"
#include "solver/terms/master_surface.hpp"

namespace snug::solver {

namespace {

/// Pressures of layers whose law has none are not part of the system, nor are the fields of hexahedra.
void constrain_pressures(const Model& model, const mesh::BodyMesh& body, const Layout& layout, ConstraintTable& table) {
  const std::vector<int> layer = pressure_unknowns(body).layer;
  for (std::size_t i = 0; i < layer.size(); ++i)
    if (!materials::is_split(model.tissues[layer[i]].law))
      table.fix(layout["body pressure"](static_cast<int>(i)));
  for (int i = 0; i < layout["body cells"].count; ++i) table.fix(layout["body cells"](i));
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
void hold_along(const Eigen::Vector3d& m, int first, ConstraintTable& table) {
  constexpr double round_off = 1e-12;  // of a unit tangent: a cylinder's has one component
  int largest = 2;
  m.cwiseAbs().maxCoeff(&largest);
  std::vector<Follow> others;
  for (int c = 0; c < 3; ++c)
    if (c != largest && std::abs(m[c]) > round_off) others.push_back({first + c, -m[c] / m[largest]});
  table.bind(first + largest, std::move(others));
}

void hold_edges(const std::vector<input::HeldEdge>& held, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                const Field& position, ConstraintTable& table) {
  for (const auto& edge : held)
    if (edge.held == input::HeldDirection::all)
      for (const int node : garment.edges.at(edge.edge))
        for (int c = 0; c < 3; ++c) table.fix(position(node, c));
  if (std::none_of(held.begin(), held.end(), [](const auto& edge) { return edge.held == input::HeldDirection::axis; })) return;
  const MasterSurface skin({}, body, body.skin_facets);
  for (const auto& edge : held)
    if (edge.held == input::HeldDirection::axis)
      for (const int node : garment.edges.at(edge.edge))
        hold_along(meridian(skin, body, garment.placed[node]), position(node), table);
}

// Neither what is held nor what has two legs can be turned.
bool turns_freely(const input::GarmentSpec& spec, const mesh::GarmentMesh& garment) {
  for (const mesh::LimbFit& limb : garment.fit.limbs)
    if (limb.limb.ends_with("leg") && std::any_of(limb.rows.begin(), limb.rows.end(), [](const auto& row) { return row.cover > 0.999; })) return false;
  return std::none_of(spec.held.begin(), spec.held.end(), [](const auto& edge) { return edge.held == input::HeldDirection::all; });
}

// What a garment is held by goes along with the bones under it.
void carry_garment(const GarmentModel& model, bool rubs, const mesh::GarmentMesh& garment, const Field& position, Supports& supports) {
  const auto carry = [&](int node) {
    if (supports.carries(position(node))) supports.carry(position(node));
  };
  for (const input::HeldEdge& edge : model.spec.held)
    for (const int node : garment.edges.at(edge.edge)) carry(node);
  if (!rubs && turns_freely(model.spec, garment)) carry(turn_pin(garment).node);
}

void constrain_garment(const GarmentModel& model, bool rubs, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                       const Field& position, ConstraintTable& table) {
  auto held = model.spec.held;
  if (held.empty() && !rubs) held.push_back({.edge = probe_edge(garment), .held = input::HeldDirection::axis});
  hold_edges(held, body, garment, position, table);
  if (turns_freely(model.spec, garment) && !rubs) {
    const TurnPin pin = turn_pin(garment);
    table.fix(position(pin.node, pin.component));
  }
  if (garment.order == 1)
    for (const auto& triangle : garment.triangles)
      for (int k = 3; k < 6; ++k)
        for (int c = 0; c < 3; ++c) table.fix(position(garment.merged[triangle[k]], c));
  for (std::size_t node = 0; node < garment.merged.size(); ++node) {
    if (garment.merged[node] == static_cast<int>(node)) continue;
    for (int c = 0; c < 3; ++c)  // a seam: this side follows the other
      table.tie(position(static_cast<int>(node), c), position(garment.merged[node], c));
  }
}

}  // namespace

std::string probe_edge(const mesh::GarmentMesh& garment) {
  const auto width = [&](const std::vector<int>& edge) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int node : edge) centre += garment.placed[node] / static_cast<double>(edge.size());
    double sum = 0.0;
    for (const int node : edge) sum += (garment.placed[node] - centre).norm();
    return sum / static_cast<double>(edge.size());
  };
  std::string widest;
  double most = 0.0;
  for (auto it = garment.edges.rbegin(); it != garment.edges.rend(); ++it)  // "upper" before "lower" where both are as wide
    if (const double found = width(it->second); widest.empty() || found > (1.0 + 1e-6) * most) widest = it->first, most = found;
  return widest;
}

TurnPin turn_pin(const mesh::GarmentMesh& garment) {
  const auto& edge = garment.edges.rbegin()->second;  // "upper" of a tube
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

Layout make_layout(const Model& model, const Meshes& meshes, Skin skin) {
  Layout layout;
  const bool deformable = skin == Skin::deformable;
  if (deformable) add_positions(layout, "body", meshes.body);
  for (const mesh::GarmentMesh& garment : meshes.garments)
    layout.add({.name = garment.name, .count = static_cast<int>(garment.pattern.size()), .components = 3});
  if (deformable)
    for (const input::ToolSpec& tool : model.asked.tools) layout.add({.name = tip_field(tool), .count = 1, .components = 3});
  if (deformable) add_pressures(layout, "body", meshes.body);
  for (const ContactModel& contact : model.contacts) {
    if (contact.garment >= 0)
      add_multipliers(layout, contact.name, garment_slave(layout[meshes.garments[contact.garment].name], meshes.garments[contact.garment]).vertices());
    else if (deformable)
      add_multipliers(layout, contact.name, surface_slave(layout["body"], meshes.body, slave_facets(meshes.body, contact)).vertices());
  }
  if (deformable)
    for (const input::ToolSpec& tool : model.asked.tools)
      add_multipliers(layout, tool_pressures(tool), static_cast<int>(place_tool(meshes.body, tool).surface.node_of_vertex.size()));
  return layout;
}

Supports carried_supports(const Model& model, const Meshes& meshes, const Layout& layout, std::shared_ptr<const Carrier> carrier) {
  Supports supports(model, meshes.body, layout, std::move(carrier));
  for (std::size_t g = 0; g < meshes.garments.size(); ++g)
    carry_garment(model.garments[g], model.rubs(static_cast<int>(g)), meshes.garments[g], layout[meshes.garments[g].name], supports);
  return supports;
}

Numbering make_numbering(const Model& model, const Meshes& meshes, const Layout& layout, const Supports& supports) {
  ConstraintTable table = supports.table();
  if (layout["body"].count > 0) constrain_pressures(model, meshes.body, layout, table);
  for (std::size_t g = 0; g < meshes.garments.size(); ++g)
    constrain_garment(model.garments[g], model.rubs(static_cast<int>(g)), meshes.body, meshes.garments[g],
                      layout[meshes.garments[g].name], table);
  return table.numbering(entry_owners(model, meshes, layout, ranks()), ranks());
}

}  // namespace snug::solver
