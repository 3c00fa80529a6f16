#include "solver/scene/result.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "postproc/hem.hpp"
#include "postproc/skin_pressure.hpp"
#include "solver/scene/friction_result.hpp"
#include "solver/scene/loads.hpp"
#include "solver/scene/reactions.hpp"
#include "solver/scene/surface_result.hpp"
#include "solver/terms/facet_kind.hpp"
#include "solver/terms/shell.hpp"

namespace snug::solver {

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
  result.displacement.assign(mesh.nodes.size(), Eigen::Vector3d::Zero());
  result.contact_pressure.assign(mesh.nodes.size(), 0.0);
  result.coverage.assign(mesh.nodes.size(), 0.0);
  return result;
}

void append(const mesh::GarmentMesh& mesh, postproc::GarmentResult& result) {
  const int first = static_cast<int>(result.pattern.size()), first_triangle = static_cast<int>(result.triangles.size());
  result.placed.insert(result.placed.end(), mesh.placed.begin(), mesh.placed.end());
  result.pattern.insert(result.pattern.end(), mesh.pattern.begin(), mesh.pattern.end());
  for (auto triangle : mesh.triangles) {
    for (int& node : triangle) node += first;
    result.triangles.push_back(triangle);
  }
  result.parts.push_back({mesh.name, first, static_cast<int>(result.pattern.size()), first_triangle, static_cast<int>(result.triangles.size())});
}

namespace {

void fill_stress(const Tissue& tissue, const State& state, postproc::BodyResult& body) {
  body.cauchy_stress.assign(body.nodes.size(), Eigen::Matrix<double, 6, 1>::Zero());
  std::vector<int> count(body.nodes.size(), 0);
  for (std::size_t c = 0; c < body.cells.size(); ++c) {
    const auto stress = tissue.nodal_stress(state, static_cast<int>(c));
    for (int a = 0; a < body.cell_nodes; ++a) {
      body.cauchy_stress[body.cells[c][a]] += stress.col(a);
      ++count[body.cells[c][a]];
    }
  }
  for (std::size_t node = 0; node < count.size(); ++node)
    if (count[node] > 0) body.cauchy_stress[node] /= count[node];
}

/// Averages over the triangles of a node, of the top, the middle and the bottom.
void fill_shell_stress(const Shell& shell, const mesh::BodyMesh& mesh, const State& state, postproc::BodyResult& body) {
  std::vector<double> count(body.nodes.size(), 0.0);
  for (const mesh::ShellTriangle& triangle : mesh.shell)
    for (int a = 0; a < 6; ++a) count[triangle.nodes[a]] += 1.0;
  for (const auto& [height, stress] : {std::pair{1.0, &body.stress_top}, {0.0, &body.cauchy_stress}, {-1.0, &body.stress_bottom}}) {
    stress->assign(body.nodes.size(), Eigen::Matrix<double, 6, 1>::Zero());
    for (int t = 0; t < shell.triangles(); ++t) {
      const auto nodal = shell.nodal_stress(state, t, height);
      for (int a = 0; a < 6; ++a) (*stress)[mesh.shell[t].nodes[a]] += nodal.col(a) / count[mesh.shell[t].nodes[a]];
    }
  }
}

/// Of results "upper edge"; where there are several garments "band, upper".
std::string edge_of(bool alone, const std::string& garment, const std::string& edge) {
  return alone ? edge : garment + ", " + edge;
}

// Sides of triangles whose mid-edge node is a node of the edge; `first` node of the garment in the result.
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

void add_positions(const Field& position, const State& state, const mesh::GarmentMesh& mesh, int first, postproc::GarmentResult& result) {
  for (std::size_t node = 0; node < mesh.pattern.size(); ++node)
    result.current.push_back(state.values.segment<3>(position(mesh.merged[node])));
  if (mesh.order == 1)
    for (const auto& triangle : mesh.triangles)
      for (int k = 0; k < 3; ++k)
        result.current[first + triangle[3 + k]] =
            0.5 * (result.current[first + triangle[k]] + result.current[first + triangle[(k + 1) % 3]]);
}

// Adds a garment behind those that are there.
void add_garment(const Scene& scene, const State& state, const mesh::GarmentMesh& mesh, bool alone, postproc::GarmentResult& result) {
  const auto& fabric = *scene.find<FabricMembrane>("fabric of " + mesh.name);
  append(mesh, result);
  const int first = result.parts.back().first_node;
  add_positions(scene.layout()[mesh.name], state, mesh, first, result);
  add_named_edges(mesh, alone, static_cast<int>(result.parts.size()) - 1, first, result.edges);
  result.contact_pressure.resize(result.pattern.size(), 0.0);
  for (int t = 0; t < fabric.triangles(); ++t) {
    const auto s = fabric.summary(state, t);
    result.tension_warp.push_back(s.tension_warp);
    result.tension_weft.push_back(s.tension_weft);
    result.shear.push_back(s.shear);
    result.stretch_warp.push_back(s.stretch_warp);
    result.stretch_weft.push_back(s.stretch_weft);
    result.wrinkled.push_back(s.wrinkled);
  }
}

// Raw multipliers on the garment, per current area; mid-edge nodes get the mean of their edge. `first`: its node in the result.
void fill_garment_pressure(const Contact& contact, const FabricMembrane& fabric, const State& state, const mesh::GarmentMesh& mesh,
                           int first, std::vector<double>& pressure) {
  std::vector<double> ratio(mesh.pattern.size(), 0.0), count(mesh.pattern.size(), 0.0);
  for (int t = 0; t < fabric.triangles(); ++t) {
    const double r = fabric.summary(state, t).area_ratio;
    for (const int node : mesh.triangles[t]) ratio[mesh.merged[node]] += r, count[mesh.merged[node]] += 1.0;
  }
  const auto at = [&](int node) {
    const int m = mesh.merged[node], i = contact.multiplier_of(m);
    return i < 0 ? 0.0 : contact.pressure(state, i) * count[m] / ratio[m];
  };
  for (const auto& triangle : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      pressure[first + triangle[k]] = at(triangle[k]);
      pressure[first + triangle[3 + k]] = 0.5 * (at(triangle[k]) + at(triangle[(k + 1) % 3]));
    }
}

std::vector<postproc::ContactSample> samples_of(const Contact& contact, const FabricMembrane& fabric, const State& state) {
  std::vector<postproc::ContactSample> samples = contact.samples(state);
  auto sample = samples.begin();
  for (const auto& place : contact.places(state)) {
    if (sample->facet >= 0)
      sample->area = fabric.area_ratio(state, place.triangle, place.L) * place.weight * fabric.pattern_area(place.triangle);
    ++sample;
  }
  return samples;
}

// Forces and places of the points, in the order of the samples.
void fill_contact_points(const Contact& contact, const State& state, bool deformable, std::vector<postproc::ContactSample>& samples,
                         postproc::Balance& balance) {
  auto sample = samples.begin();
  for (const auto& point : contact.point_forces(state)) {
    (sample++)->at = point.y;
    add_action(point.force, point.y, deformable, balance);
    balance.contact_force += point.force.norm();
  }
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
  for (const mesh::GarmentMesh& garment : garments)
    for (const auto& [name, nodes] : garment.edges) {
      const Field& position = layout[garment.name];
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const int node : nodes) answer(position(node), holding_force(scene, residual, position(node)), sum);
      note(edge_of(garments.size() == 1, garment.name, name) + " edge", sum);
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
    result.numbers["max_contact_pressure_with_hems_Pa"] =
        *std::max_element(result.body.contact_pressure.begin(), result.body.contact_pressure.end());
    result.numbers["contact_area_m2"] = area;
  }
  if (scene.layout()["body"].count == 0) return;
  double sum = 0.0, weight = 0.0, largest = 0.0;
  const mesh::FacetKind kind = facet_kind(body.kind);
  for (const auto& facet : body.skin_facets) {
    const FacetNodes rest = facet_positions(body, facet);
    FacetNodes moved = FacetNodes::Zero();
    for (int a = 0; a < node_count(kind); ++a) moved.col(a) = result.body.displacement[facet[a]];
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

// Pressure of a garment on the skin, with what friction adds.
void fill_garment_contact(const Scene& scene, const State& state, const Touch& touch, const mesh::GarmentMesh& mesh,
                          postproc::RunResult& result) {
  const auto& fabric = *scene.find<FabricMembrane>("fabric of " + mesh.name);
  const bool deformable = scene.layout()["body"].count > 0;
  const auto part = std::find_if(result.garment.parts.begin(), result.garment.parts.end(), [&](const auto& p) { return p.name == mesh.name; });
  std::vector<postproc::ContactSample> samples = samples_of(*touch.contact, fabric, state);
  fill_garment_pressure(*touch.contact, fabric, state, mesh, part->first_node, result.garment.contact_pressure);
  fill_contact_points(*touch.contact, state, deformable, samples, result.balance);
  if (touch.friction) add_friction(*touch.friction, *touch.contact, state, deformable, mesh, part->first_node, samples, result);
  result.samples.insert(result.samples.end(), samples.begin(), samples.end());
}

// What all garments together press on the skin.
void fill_skin(const mesh::BodyMesh& body, bool friction, postproc::RunResult& result) {
  std::vector<Eigen::Vector3d> current = result.body.nodes;
  for (std::size_t i = 0; i < current.size(); ++i) current[i] += result.body.displacement[i];
  const auto pressure = postproc::transfer(body.skin_facets, current.size(), current, result.samples);
  result.body.contact_pressure = pressure.pressure;
  result.body.coverage = pressure.coverage;
  result.numbers["max_contact_pressure_Pa"] = postproc::keep_hems_apart(body.mean_skin_cell, result);
  if (friction) fill_skin_friction(pressure, result);
}

// Two surfaces of the body: pressure per current area at the slave's nodes, and a row of sums.
void fill_solid_contact(const Scene& scene, const State& state, const Touch& touch, const ContactModel& model, const mesh::BodyMesh& body,
                        postproc::RunResult& result) {
  const SurfacePressures found = surface_pressures(*touch.contact, scene.layout()["body"], state, slave_facets(body, model));
  for (const auto& [node, pressure] : found.at_node) result.body.contact_pressure[node] = pressure;
  postproc::SurfaceContact row{model.name, model.slave, model.master, 0.0, found.area, 0.0, 0.0};
  for (const auto& point : touch.contact->point_forces(state)) row.force += point.force.norm();
  for (const auto& [node, pressure] : found.at_node) row.largest_pressure = std::max(row.largest_pressure, pressure);
  if (touch.friction)
    for (const auto& point : touch.friction->point_forces(state)) row.friction_force += point.force.norm();
  result.balance.contact_force += row.force, result.balance.friction_force += row.friction_force;
  result.surface_contacts.push_back(std::move(row));
}

}  // namespace

std::string edge_name(const Model& model, const mesh::GarmentMesh& garment, const std::string& edge) {
  return edge_of(model.garments.size() == 1, garment.name, edge) + " edge";
}

void fill_result(const Scene& scene, const State& state, const Model& model, const Meshes& meshes, postproc::RunResult& result) {
  const Field& position = scene.layout()["body"];
  const mesh::BodyMesh& body = meshes.body;
  for (int node = 0; node < position.count; ++node)
    result.body.displacement[node] = state.values.segment<3>(position(node)) - body.nodes[node];
  if (const auto* tissue = scene.find<Tissue>()) fill_stress(*tissue, state, result.body);
  if (const auto* shell = scene.find<Shell>()) fill_shell_stress(*shell, body, state, result.body);
  for (const mesh::GarmentMesh& garment : meshes.garments) add_garment(scene, state, garment, meshes.garments.size() == 1, result.garment);
  bool on_skin = false, friction = false;
  for (const Touch& touch : scene.touches()) {
    if (!touch.of_garment) continue;
    const auto mesh = std::find_if(meshes.garments.begin(), meshes.garments.end(), [&](const auto& m) { return m.name == touch.slave; });
    fill_garment_contact(scene, state, touch, *mesh, result);
    on_skin = true, friction = friction || touch.friction;
  }
  if (on_skin) fill_skin(body, friction, result);
  for (const Touch& touch : scene.touches())
    if (!touch.of_garment) fill_solid_contact(scene, state, touch, *model.contact(touch.contact->name()), body, result);
  fill_reactions(scene, state, meshes.garments, result.balance);
  if (const auto* shell = scene.find<Shell>()) fill_foundation(*shell, state, scene.layout(), result.balance);
  result.balance.free_motions_share = borne_by_free_motions(scene, state);
  if (const auto borne = result.balance.free_motions_share) result.numbers["free_motions_share_of_load"] = *borne;
  result.max_penetration = scene.measure(state).penetration;
  fill_numbers(scene, body, result);
}

}  // namespace snug::solver
