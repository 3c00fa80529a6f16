#include "solver/scene/result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "postproc/hem.hpp"
#include "postproc/skin_pressure.hpp"
#include "solver/scene/bands.hpp"
#include "solver/scene/contact_rows.hpp"
#include "solver/scene/friction_result.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/piece_rows.hpp"
#include "solver/scene/reactions.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/shell.hpp"

namespace snug::solver {

namespace field = postproc::field;

postproc::BodyResult body_result(const mesh::BodyMesh& mesh, bool cells) {
  postproc::BodyResult result;
  result.nodes = mesh.nodes;
  result.node_numbers = mesh.node_numbers;
  if (cells) result.cells = mesh.cells, result.cell_layer = mesh.cell_layer;
  result.cell_nodes = node_count(mesh.kind), result.facet_nodes = node_count(facet_kind(mesh.kind));
  result.skin_facets = mesh.skin_facets;
  for (const auto& layer : mesh.layers) result.layers.push_back(layer.name);
  result.locations = mesh.locations;
  result.node_location = mesh.node_location;
  result.location_shares = mesh.location_shares;
  if (mesh.nodes.empty()) return result;
  result.fields.set(field::displacement, std::vector<Eigen::Vector3d>(mesh.nodes.size(), Eigen::Vector3d::Zero()));
  result.fields.set(field::contact_pressure, std::vector<double>(mesh.nodes.size(), 0.0));
  result.fields.set(field::coverage, std::vector<double>(mesh.nodes.size(), 0.0));
  return result;
}

void show_laplace(postproc::BodyResult& body) {
  const std::vector<double>* laplace = body.fields.find(field::laplace_pressure);
  if (!laplace) return;
  body.fields.set(field::contact_pressure, *laplace);
  std::vector<double>& coverage = body.fields[field::coverage];
  for (std::size_t i = 0; i < coverage.size(); ++i) coverage[i] = (*laplace)[i] > 0.0 ? 1.0 : 0.0;
}

// Each course as long as it is, about the middle of the rectangle that the tube is meshed on.
static void draw_as_knitted(const mesh::GarmentMesh& mesh, std::vector<Eigen::Vector2d>& pattern) {
  const std::size_t first = pattern.size() - mesh.pattern.size();
  double widest = 0.0;
  for (const Eigen::Vector2d& x : mesh.pattern) widest = std::max(widest, x.x());
  for (std::size_t n = 0; n < mesh.pattern.size(); ++n) pattern[first + n].x() = 0.5 * widest + mesh.course[n] * (mesh.pattern[n].x() - 0.5 * widest);
}

void append(const mesh::GarmentMesh& mesh, postproc::GarmentResult& result) {
  const int first = static_cast<int>(result.pattern.size()), first_triangle = static_cast<int>(result.triangles.size());
  result.placed.insert(result.placed.end(), mesh.placed.begin(), mesh.placed.end());
  result.pattern.insert(result.pattern.end(), mesh.pattern.begin(), mesh.pattern.end());
  if (!mesh.course.empty()) draw_as_knitted(mesh, result.pattern);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto triangle = mesh.triangles[t];
    for (int& node : triangle) node += first;
    result.triangles.push_back(triangle), result.piece.push_back(mesh.piece_of(t));
  }
  result.parts.push_back(
      {mesh.name, first, static_cast<int>(result.pattern.size()), first_triangle, static_cast<int>(result.triangles.size()), mesh.pieces});
}

namespace {

/// Of results "upper edge"; where there are several garments "band, upper".
std::string edge_of(bool alone, const std::string& garment, const std::string& edge) {
  return alone ? edge : garment + ", " + edge;
}

/// Names of edges; what an edge that is a part of another one has is its own.
std::vector<std::string> shortest_first(const std::map<std::string, std::vector<int>>& edges) {
  std::vector<std::string> names;
  for (const auto& [name, nodes] : edges) names.push_back(name);
  std::stable_sort(names.begin(), names.end(), [&](const auto& a, const auto& b) { return edges.at(a).size() < edges.at(b).size(); });
  return names;
}

void add_positions(const Field& position, const State& state, const mesh::GarmentMesh& mesh, int first, postproc::GarmentResult& result) {
  for (std::size_t node = 0; node < mesh.pattern.size(); ++node)
    result.current.push_back(state.values.segment<3>(position(mesh.merged[node])));
  if (mesh.order == 1)
    for (const auto& triangle : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        result.current[first + triangle[3 + k]] =
            0.5 * (result.current[first + triangle[k]] + result.current[first + triangle[(k + 1) % 3]]);
}

// Adds a garment's places behind those that are there.
void add_garment(const Scene& scene, const State& state, const mesh::GarmentMesh& mesh, bool alone, postproc::GarmentResult& result) {
  append(mesh, result);
  const int first = result.parts.back().first_node;
  add_positions(scene.layout()[mesh.name], state, mesh, first, result);
  add_named_edges(mesh, alone, static_cast<int>(result.parts.size()) - 1, first, result.edges);
}

}  // namespace

void add_named_edges(const mesh::GarmentMesh& mesh, bool alone, int garment, int first, std::vector<postproc::GarmentEdge>& edges) {
  for (const auto& [name, nodes] : mesh.edges) {
    const std::set<int> on_edge(nodes.begin(), nodes.end());
    postproc::GarmentEdge edge{edge_of(alone, mesh.name, name), {}, garment};
    for (const auto& t : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        if (on_edge.count(mesh.merged[t[3 + k]])) edge.sides.push_back({first + t[k], first + t[3 + k], first + t[(k + 1) % 3]});
    edges.push_back(std::move(edge));
  }
}

namespace {

template <class Value>
Value zero() {
  if constexpr (std::is_arithmetic_v<Value>) return 0;
  else return Value::Zero();
}

// Puts the values of one garment into a field of all; a garment that does not have the field has zeros.
void place(const postproc::NamedField& of_part, int first, int end, std::size_t entries, postproc::Fields& all) {
  if (of_part.size() != static_cast<std::size_t>(end - first))
    throw std::logic_error(fmt::format("the field {} has {} values for {} entries", of_part.name, of_part.size(), end - first));
  if (!all.find(of_part.name)) {
    postproc::NamedField empty = of_part;
    std::visit([&]<class Value>(std::vector<Value>& values) { values.assign(entries, zero<Value>()); }, empty.values);
    all.add(std::move(empty));
  }
  std::visit([&]<class Value>(std::vector<Value>& values) {
    const auto& given = std::get<std::vector<Value>>(of_part.values);
    std::copy(given.begin(), given.end(), values.begin() + first);
  }, all.find(of_part.name)->values);
}

void place_garments(const PublishedFields& published, postproc::GarmentResult& garment) {
  for (const postproc::GarmentPart& part : garment.parts)
    if (const auto found = published.find(part.name); found != published.end())
      for (const postproc::NamedField& field : found->second) {
        const bool node = field.place == postproc::Place::node;
        place(field, node ? part.first_node : part.first_triangle, node ? part.end_node : part.end_triangle,
              node ? garment.pattern.size() : garment.triangles.size(), garment.fields);
      }
}

// The points of a garment's contact that act on the skin or on nothing. What acts between garments is in balance by itself.
std::vector<postproc::ContactSample> contact_samples(const Contact& contact, const FabricMembrane& fabric, const State& state, bool deformable,
                                                     postproc::Balance& balance) {
  std::vector<postproc::ContactSample> samples;
  for (const Contact::PointForce& point : contact.point_forces(state)) {
    balance.contact_force += point.force.norm();
    if (point.facet >= 0 && !on_skin(contact.master(), point.facet)) continue;
    postproc::ContactSample sample{.facet = point.facet < 0 ? -1 : skin_facet(contact.master(), point.facet), .xi = point.xi[0], .eta = point.xi[1], .force = point.pressing,
                                   .touching = point.pressing > 0.0, .at = point.y};
    if (sample.facet >= 0) sample.area = fabric.area_ratio(state, point.triangle, point.L) * point.weight * fabric.pattern_area(point.triangle);
    samples.push_back(sample);
    add_action(point.force, point.y, deformable, balance);
  }
  return samples;
}

// Supports answer at prescribed entries: their force is the residual there.
void fill_reactions(const Scene& scene, const State& state, const std::vector<mesh::GarmentMesh>& garments, postproc::Balance& balance) {
  const Layout& layout = scene.layout();
  const Eigen::VectorXd residual = scene.full_residual(state);
  const auto answer = [&](int first, const Eigen::Vector3d& force, Eigen::Vector3d& sum) {  // `first`: the node's x entry
    sum += force;
    balance.moment_error += Eigen::Vector3d(state.values.segment<3>(first)).cross(force);
  };
  const auto note = [&](const std::string& name, const Eigen::Vector3d& sum) {
    balance.force_error += sum;
    if (sum.norm() > 0.0) balance.reactions.try_emplace(name, Eigen::Vector3d::Zero()).first->second += sum;
  };
  const ConstraintTable& table = scene.supports().table();
  for (std::size_t h = 0; h < table.holders().size(); ++h) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const auto& [entry, share] : table.held_by(static_cast<int>(h))) {
      const int component = (entry - layout["body"].first) % 3;
      answer(entry - component, share * residual[entry] * Eigen::Vector3d::Unit(component), sum);
    }
    note(table.holders()[h].name, sum);
  }
  for (const Supports::Oblique& lines : scene.supports().oblique()) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const int first : lines.first) {
      Eigen::Vector3d force = residual.segment<3>(first);
      for (int c = 0; c < 3; ++c)
        if (table.prescribed(first + c)) force[c] = 0.0;
      answer(first, force, sum);
    }
    note(lines.name, sum);
  }
  for (const mesh::GarmentMesh& garment : garments) {
    std::set<int> seen;
    for (const std::string& name : shortest_first(garment.edges)) {
      const Field& position = layout[garment.name];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const int node : garment.edges.at(name))
        if (seen.insert(node).second) answer(position(node), holding_force(scene, residual, position(node)), sum);
      note(edge_of(garments.size() == 1, garment.name, name) + " edge", sum);
    }
  }
  const Eigen::VectorXd load = scene.load_forces(state);
  for (int first = 0; first < layout.positions(); first += 3) {
    const Eigen::Vector3d force = load.segment<3>(first);
    balance.force_error += force;
    balance.moment_error += Eigen::Vector3d(state.values.segment<3>(first)).cross(force);
    if (first >= layout["body"].end()) balance.garment_weight += force;
  }
}

// The springs under a shell are a support, too.
void fill_foundation(const Shell& shell, const State& state, const Layout& layout, postproc::Balance& balance) {
  const std::vector<Eigen::Vector3d> forces = shell.foundation_forces(state);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double total = 0.0;
  for (std::size_t node = 0; node < forces.size(); ++node) {
    sum += forces[node], total += forces[node].norm();
    balance.moment_error += Eigen::Vector3d(state.values.segment<3>(layout["body"](static_cast<int>(node)))).cross(forces[node]);
  }
  balance.force_error += sum;
  if (total > 0.0) balance.reactions["foundation"] = sum;
}

// Mean over the touched skin, hems and all, largest value beside the hems; radial means the skin's own reference normal.
void fill_numbers(const Scene& scene, const mesh::BodyMesh& body, postproc::RunResult& result) {
  double force = 0.0, area = 0.0;
  for (const auto& sample : result.samples)
    if (sample.touching) force += sample.force, area += sample.area;
  if (area > 0.0) result.numbers["mean_contact_pressure_Pa"] = force / area;
  if (!result.samples.empty()) {
    const std::vector<double>& pressure = result.body.fields[field::contact_pressure];
    result.numbers["max_contact_pressure_with_hems_Pa"] = *std::max_element(pressure.begin(), pressure.end());
    result.numbers["contact_area_m2"] = area;
  }
  if (scene.layout()["body"].count == 0) return;
  double sum = 0.0, weight = 0.0, largest = 0.0;
  const std::vector<Eigen::Vector3d>& displacement = result.body.fields[field::displacement];
  const mesh::FacetKind kind = facet_kind(body.kind);
  for (const auto& facet : body.skin_facets) {
    const FacetNodes rest = facet_positions(body, facet);
    FacetNodes moved = FacetNodes::Zero();
    for (int a = 0; a < node_count(kind); ++a) moved.col(a) = displacement[facet[a]];
    for (const FacetRulePoint& q : facet_rule(kind)) {
      const FacetPoint point = facet_point(rest, q.shape);
      sum += q.weight * point.area * (moved * q.shape.N).dot(point.n);
      weight += q.weight * point.area;
    }
    largest = std::max(largest, moved.colwise().norm().maxCoeff());
  }
  if (weight == 0.0) return;
  result.numbers["mean_skin_radial_displacement_m"] = sum / weight;
  result.numbers["max_skin_displacement_m"] = largest;
}

}  // namespace

void add_action(const Eigen::Vector3d& force, const Eigen::Vector3d& at, bool deformable, postproc::Balance& balance) {
  balance.garment_force += force;
  balance.skin_force -= force;
  if (deformable) return;
  balance.force_error += force;
  balance.moment_error += at.cross(force);
}

namespace {

// What a garment presses and rubs the skin with, and where garments lie over one another what each of its contacts carries.
void fill_garment_contact(const Scene& scene, const State& state, const Touch& touch, postproc::RunResult& result) {
  const bool deformable = scene.layout()["body"].count > 0;
  std::vector<postproc::ContactSample> samples = contact_samples(*touch.contact, *touch.sheet, state, deformable, result.balance);
  if (touch.friction) add_friction(*touch.friction, *touch.contact, state, deformable, samples, result.balance);
  result.samples.insert(result.samples.end(), samples.begin(), samples.end());
  if (!has_layers(scene)) return;
  for (postproc::SurfaceContact& row : contact_rows(touch, state)) result.surface_contacts.push_back(std::move(row));
}

void fill_displacement(const Field& position, const State& state, postproc::BodyResult& body) {
  if (position.count == 0) return;
  std::vector<Eigen::Vector3d>& displacement = body.fields[field::displacement];
  for (int node = 0; node < position.count; ++node) displacement[node] = state.values.segment<3>(position(node)) - body.nodes[node];
}

// What all garments together press on the skin.
void fill_skin(const mesh::BodyMesh& body, bool friction, postproc::RunResult& result) {
  const auto pressure = postproc::transfer(body.skin_facets, result.body.nodes.size(), postproc::nodes_now(result.body), result.samples);
  result.body.fields.set(field::contact_pressure, pressure.pressure);
  result.body.fields.set(field::coverage, pressure.coverage);
  result.body.fields.set(field::skin_area, pressure.node_area);
  result.numbers["max_contact_pressure_Pa"] = postproc::keep_hems_apart(body.mean_skin_cell, result);
  if (friction) fill_skin_friction(pressure, result);
}

// Two surfaces of the body: a row of sums.
void fill_solid_contact(const State& state, const Touch& touch, const ContactModel& model, const postproc::Fields& body, postproc::RunResult& result) {
  const Contact& contact = *touch.contact;
  const std::vector<double>& pressure = body[field::contact_pressure];
  const std::vector<double> areas = contact.current_areas(state);
  postproc::SurfaceContact row{model.name, model.slave, model.master, 0.0, 0.0, 0.0, 0.0};
  for (int i = 0; i < contact.vertices(); ++i)
    if (contact.pressure(state, i) > 0.0) row.area += areas[i];
  for (const auto& triangle : contact.slave().triangles)
    for (const int node : triangle.nodes) row.largest_pressure = std::max(row.largest_pressure, pressure[node]);
  for (const auto& point : contact.point_forces(state)) row.force += point.force.norm();
  if (touch.friction)
    for (const auto& point : touch.friction->point_forces(state)) row.friction_force += point.force.norm();
  result.balance.contact_force += row.force, result.balance.friction_force += row.friction_force;
  result.surface_contacts.push_back(std::move(row));
}

// What a contact tells of the body stands at nodes of its own: where garments have filled the same field it comes to theirs.
void place_body(const postproc::Fields& published, postproc::Fields& body) {
  for (const postproc::NamedField& given : published) {
    const bool of_contact = given.name == field::contact_pressure.name || given.name == field::shear_traction.name || given.name == field::slip.name;
    postproc::NamedField* there = of_contact ? body.find(std::string_view(given.name)) : nullptr;
    if (!there) {
      body.add(given);
      continue;
    }
    std::visit([&]<class Value>(std::vector<Value>& sum) {
      const auto& values = std::get<std::vector<Value>>(given.values);
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += values[n];
    }, there->values);
  }
}

}  // namespace

std::string edge_name(const Model& model, const mesh::GarmentMesh& garment, const std::string& edge) {
  return edge_of(model.garments.size() == 1, garment.name, edge) + " edge";
}

void fill_result(const Scene& scene, const State& state, const Model& model, const Meshes& meshes, postproc::RunResult& result) {
  const mesh::BodyMesh& body = meshes.body;
  fill_displacement(scene.layout()["body"], state, result.body);
  for (const mesh::GarmentMesh& garment : meshes.garments) add_garment(scene, state, garment, meshes.garments.size() == 1, result.garment);
  PublishedFields published;
  for (const auto& term : scene.terms()) term->publish(state, published);
  for (const auto& [part, fields] : published)
    if (part != "body" && std::none_of(meshes.garments.begin(), meshes.garments.end(), [&](const auto& m) { return m.name == part; }))
      throw std::logic_error("fields are published of a part \"" + part + "\" that the scene does not have");
  bool on_skin = false, friction = false;
  for (const Touch& touch : scene.touches()) {
    if (!touch.sheet) continue;
    fill_garment_contact(scene, state, touch, result);
    on_skin = true, friction = friction || touch.friction;
  }
  place_garments(published, result.garment);
  if (on_skin) fill_skin(body, friction, result);
  place_body(published["body"], result.body.fields);
  for (const Touch& touch : scene.touches())
    if (!touch.sheet) fill_solid_contact(state, touch, *model.contact(touch.contact->name()), result.body.fields, result);
  result.bands = band_rows(scene, state);
  result.pieces = piece_rows(scene, state, model, meshes.garments), result.seams = seam_rows(scene, state, meshes.garments);
  fill_reactions(scene, state, meshes.garments, result.balance);
  if (const auto* shell = scene.find<Shell>()) fill_foundation(*shell, state, scene.layout(), result.balance);
  result.balance.free_motions_share = borne_by_free_motions(scene, state);
  if (const auto borne = result.balance.free_motions_share) result.numbers["free_motions_share_of_load"] = *borne;
  result.max_penetration = scene.measure(state).penetration;
  fill_numbers(scene, body, result);
}

}  // namespace snug::solver
