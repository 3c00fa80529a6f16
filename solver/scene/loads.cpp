#include "solver/scene/loads.hpp"

#include <fmt/format.h>

#include "mesh/placement/fit_on_body.hpp"
#include "solver/scene/supports.hpp"
#include "solver/terms/dead_load.hpp"
#include "solver/terms/fabric_bending.hpp"
#include "solver/terms/pressure_load.hpp"

namespace snug::solver {

namespace {

Eigen::Vector3d vector(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

const std::vector<mesh::FacetNodeNumbers>& facets_of(const mesh::BodyMesh& body, const std::string& name,
                                                     const input::Location& where) {
  const auto& facets = named_surface(body, name, where).facets;
  if (facets.empty())
    throw input::InputError(where, fmt::format("\"{}\" has no facets: it is a curve, a point, or not on the boundary", name),
                            "name a surface, or load it with a [[load.force]]");
  return facets;
}

int nearest_node(const mesh::BodyMesh& body, const Eigen::Vector3d& point) {
  int best = 0;
  for (std::size_t n = 1; n < body.nodes.size(); ++n)
    if ((body.nodes[n] - point).squaredNorm() < (body.nodes[best] - point).squaredNorm()) best = static_cast<int>(n);
  return best;
}

void add_force(const input::Force& force, const mesh::BodyMesh& body, NodalForces& forces) {
  const Eigen::Vector3d total = vector(force.value);
  if (force.at) {
    forces[nearest_node(body, vector(*force.at))] += total;
    return;
  }
  const mesh::Surface& surface = named_surface(body, force.on, force.where);
  if (!surface.facets.empty()) return add_traction(body, surface.facets, total / area(body, surface.facets), forces);
  for (const int node : surface.nodes) forces[node] += total / static_cast<double>(surface.nodes.size());
}

}  // namespace

NodalForces dead_forces(const Model& model, const mesh::BodyMesh& body) {
  const input::LoadSpec load = model.asked.load.value_or(input::LoadSpec{});
  NodalForces forces(body.nodes.size(), Eigen::Vector3d::Zero());
  for (const mesh::NodalForce& force : body.forces) forces[force.node] += force.force;
  for (const auto& t : load.traction) add_traction(body, facets_of(body, t.on, t.where), vector(t.value), forces);
  for (const auto& f : load.force) add_force(f, body, forces);
  if (const Eigen::Vector3d gravity = vector(load.gravity); !gravity.isZero(0.0)) {
    if (!body.shell.empty())
      throw input::InputError({}, "gravity does not act on a shell body", "give its weight as [[load.traction]]");
    std::vector<double> density;
    for (const materials::Tissue& tissue : model.tissues) density.push_back(tissue.density);
    add_weight(body, density, gravity, forces);
  }
  return forces;
}

std::vector<mesh::FacetPressure> surface_pressures(const input::LoadSpec& load, const mesh::BodyMesh& body) {
  std::vector<mesh::FacetPressure> pressures = body.pressures;
  if (load.skin_pressure != 0.0) pressures.push_back({body.skin_facets, load.skin_pressure});
  for (const auto& p : load.pressure) pressures.push_back({facets_of(body, p.on, p.where), p.value});
  return pressures;
}

LooseCloth loose_cloth(const input::GarmentSpec& garment, const mesh::GarmentMesh& mesh) {
  const bool loose = mesh.stand_off > 0.0;
  if (garment.bending.value_or(false) && mesh.order != 2)
    throw input::InputError(garment.where, "bending takes quadratic triangles and order is 1", "write order = 2, or leave bending out");
  const bool may_fold = loose || mesh::above_girths(mesh.fit) > 0.0;
  return {garment.bending.value_or(may_fold && mesh.order == 2), garment.weight.value_or(loose)};
}

void add_loose_cloth(const Model& model, int g, const mesh::GarmentMesh& mesh, Scene& scene) {
  const LooseCloth cloth = loose_cloth(model.garments[g].spec, mesh);
  std::vector<materials::BendingStiffness> bending;
  std::vector<double> areal_density, in_plane;
  for (const materials::Fabric& fabric : model.garments[g].fabrics()) {
    const materials::Fabric sheet = materials::with_usual_sheet(fabric);
    bending.push_back(sheet.bending), areal_density.push_back(sheet.areal_density), in_plane.push_back(sheet.stiffness());
  }
  const Field& position = scene.layout()[mesh.name];
  if (cloth.bending) scene.add(std::make_unique<FabricBending>(mesh.name, position, mesh, bending, std::move(in_plane)));
  if (!cloth.weight) return;
  const auto& load = model.asked.load;
  const bool given = load && load->gravity != std::array<double, 3>{0, 0, 0};
  NodalForces forces(mesh.pattern.size(), Eigen::Vector3d::Zero());
  add_weight(mesh, areal_density, vector(given ? load->gravity : upright_gravity), forces);
  scene.add(std::make_unique<DeadLoad>("weight of " + mesh.name, position, forces));
}

std::vector<mesh::FacetNodeNumbers> contact_facets(const mesh::BodyMesh& body, const std::string& name, const input::Location& where) {
  const auto& facets = named_surface(body, name, where).facets;
  if (facets.empty())
    throw input::InputError(where, fmt::format("\"{}\" has no facets: it is a curve, a point, or not on the boundary", name),
                            "name two surfaces that face each other");
  return facets;
}

std::vector<mesh::FacetNodeNumbers> slave_facets(const mesh::BodyMesh& body, const ContactModel& contact) {
  if (mesh::facet_kind(body.kind) != mesh::FacetKind::tri6)
    throw input::InputError(contact.where, fmt::format("the slave \"{}\" is made of hexahedra", contact.slave),
                            "contact of two surfaces takes quadratic tetrahedra: mesh both solids with them");
  return contact_facets(body, contact.slave, contact.where);
}

void add_loads(const Model& model, const mesh::BodyMesh& body, Scene& scene) {
  const input::LoadSpec load = model.asked.load.value_or(input::LoadSpec{});
  const Field& position = scene.layout()["body"];
  const auto press = [&](const std::string& name, const std::vector<mesh::FacetNodeNumbers>& facets, double pressure) {
    auto term = std::make_unique<PressureLoad>(position, body, name, facets, pressure);
    term->hold_border(scene.numbering());
    scene.add(std::move(term));
  };
  for (const mesh::FacetPressure& p : body.pressures) press("faces of the file", p.facets, p.value);
  if (load.skin_pressure != 0.0) press("skin", body.skin_facets, load.skin_pressure);
  for (const auto& p : load.pressure) press(p.on, facets_of(body, p.on, p.where), p.value);
  auto dead = std::make_unique<DeadLoad>("dead load", position, dead_forces(model, body));
  if (!dead->empty()) scene.add(std::move(dead));
}

}  // namespace snug::solver
