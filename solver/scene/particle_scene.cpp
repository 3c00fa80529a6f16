#include "solver/scene/particle_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "mesh/placement/closed_skin.hpp"
#include "mesh/placement/skin_nearness.hpp"
#include "solver/scene/bands.hpp"
#include "solver/scene/laplace.hpp"

namespace snug::solver {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// A strip by its curve of second Piola-Kirchhoff forces: T = s S(E), E = (s^2 - 1)/2. Shortened it goes on as it begins.
mesh::TensileCurve strip(const materials::TensionCurve& curve) {
  const double first = curve.at(0.0).stiffness;
  return [curve, first](double s) {
    const double strain = 0.5 * (s * s - 1.0);
    const materials::TensionCurve::Value at =
        strain < 0.0 ? materials::TensionCurve::Value{0.5 * first * strain * strain, first * strain, first} : curve.at(strain);
    return mesh::Tensile{at.energy, s * at.force, at.force + s * s * at.stiffness};
  };
}

mesh::ClothLaws laws_of(const materials::Fabric& given) {
  const materials::Fabric fabric = materials::with_usual_sheet(given);
  return {.warp = strip(fabric.warp), .weft = strip(fabric.weft), .shear = fabric.shear, .bending_warp = fabric.bending.warp,
          .bending_weft = fabric.bending.weft, .density = fabric.areal_density};
}

/// Vertices become particles, in the order of the triangles; nodes of a seam one.
std::vector<int> number_particles(const mesh::GarmentMesh& garment) {
  std::vector<int> of_merged(garment.pattern.size(), -1), of(garment.pattern.size(), -1);
  int count = 0;
  for (const auto& triangle : garment.triangles)
    for (int a = 0; a < 3; ++a) {
      int& number = of_merged[garment.merged[triangle[a]]];
      if (number < 0) number = count++;
      of[triangle[a]] = number;
    }
  for (std::size_t n = 0; n < of.size(); ++n)  // a node that an edge names stands for those it is merged with
    if (of[n] < 0) of[n] = of_merged[garment.merged[n]];
  return of;
}

std::vector<mesh::FlatTriangle> flat_triangles(const mesh::GarmentMesh& garment, const std::vector<int>& particle_of) {
  std::vector<mesh::FlatTriangle> triangles;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    mesh::FlatTriangle& flat = triangles.emplace_back();
    const double course = garment.course_of(t).head<3>().mean();  // along x; of a graduated tube
    const Vector2d warp = garment.warp[t], weft(-warp.y(), warp.x());
    for (int a = 0; a < 3; ++a) {
      const Vector2d x = garment.pattern[garment.triangles[t][a]].cwiseProduct(Vector2d(course, 1.0));
      flat.particles[a] = particle_of[garment.triangles[t][a]];
      flat.flat[a] = {warp.dot(x), weft.dot(x)};
    }
  }
  return triangles;
}

const std::vector<int>& edge_nodes(const mesh::GarmentMesh& garment, const std::string& edge, const input::Location& where) {
  if (const auto found = garment.edges.find(edge); found != garment.edges.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, nodes] : garment.edges) names.push_back("\"" + name + "\"");
  throw input::InputError(where, fmt::format("{} has no edge \"{}\"", garment.name, edge), fmt::format("its edges are: {}", fmt::join(names, ", ")));
}

void hold_edges(const input::GarmentSpec& spec, const mesh::GarmentMesh& garment, ParticleScene& scene) {
  for (const input::HeldEdge& edge : spec.held)
    for (const int node : edge_nodes(garment, edge.edge, edge.where))
      if (const int particle = scene.particle_of[node]; particle >= 0) {
        scene.held[particle] |= edge.held == input::HeldDirection::all ? mesh::held_all : mesh::held_height;
        if (scene.holder[particle].empty()) scene.holder[particle] = edge.edge;
      }
}

/// The sides of triangles along an edge, each with its share of the band.
std::vector<mesh::ElasticLine> lines_along(const input::BandSpec& band, const mesh::GarmentMesh& garment, const std::vector<int>& particle_of) {
  const BandModel as = band_model(band, garment);
  const std::vector<int>& nodes = garment.edges.at(band.edge);
  const std::set<int> on_edge(nodes.begin(), nodes.end());
  std::vector<mesh::ElasticLine> lines;
  for (const auto& t : garment.triangles)
    for (int k = 0; k < 3; ++k)
      if (on_edge.contains(garment.merged[t[3 + k]])) {
        const int a = t[k], b = t[(k + 1) % 3];
        const double cut = (garment.pattern[b] - garment.pattern[a]).norm();
        lines.push_back({particle_of[a], particle_of[b], cut * as.rest_length / as.edge_length, as.stiffness});
      }
  return lines;
}

/// Cloth that lies by its weight sinks in by a thousandth of the reach, tight cloth by a quarter of it in the mean (by the law of Laplace); where a
/// whole garment hangs on a line it is tenths of a millimetre.
double pressing_stiffness(double areal_density, double expected_pressure) {
  constexpr double gravity = 9.80665, times_its_weight = 1000.0, times_its_pressure = 4.0;
  return std::max(times_its_weight * areal_density * gravity, times_its_pressure * expected_pressure) / skin_reach;
}

mesh::BodyContact skin_contact(const Model& model, const Meshes& meshes, double density) {
  constexpr double cell = 0.006;  // m, of the grid of distances
  const mesh::BodySurface body = meshes.form ? meshes.form->body : mesh::body_of_skin(meshes.body, model.asked.body->where);
  return {.body = mesh::SkinNearness(body, cell), .stiffness = pressing_stiffness(density, laplace_pressure(model.garments, meshes).mean), .reach = skin_reach,
          .friction = model.contact_of(0)->friction.coefficient};
}

}  // namespace

int count_particles(const mesh::GarmentMesh& garment) {
  int count = 0;
  for (const int particle : number_particles(garment)) count = std::max(count, particle + 1);
  return count;
}

ParticleScene make_particle_scene(const Model& model, const Meshes& meshes) {
  const mesh::GarmentMesh& garment = meshes.garments.front();
  const GarmentModel& of = model.garments.front();
  ParticleScene scene{.particle_of = number_particles(garment)};
  const auto count = static_cast<std::size_t>(count_particles(garment));
  scene.held.assign(count, 0), scene.holder.resize(count);
  hold_edges(of.spec, garment, scene);
  mesh::ClothSheet sheet{.triangles = flat_triangles(garment, scene.particle_of), .drag = air_drag};
  for (const materials::Fabric& fabric : of.fabrics()) sheet.laws.push_back(laws_of(fabric));
  double area = 0.0;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    sheet.triangle_laws.push_back(1 + garment.zone_of(t));
    const double own = sheet.triangles[t].area();
    area += own, scene.weight += own * sheet.laws[1 + garment.zone_of(t)].density * sheet.gravity;
  }
  for (const input::BandSpec& band : of.spec.band)
    for (const mesh::ElasticLine& line : lines_along(band, garment, scene.particle_of)) sheet.bands.push_back(line);
  if (model.contact_of(0)) sheet.body = skin_contact(model, meshes, scene.weight / (area * sheet.gravity));
  mesh::Places places(count);
  for (std::size_t n = 0; n < garment.placed.size(); ++n)
    if (scene.particle_of[n] >= 0) places[scene.particle_of[n]] = garment.placed[n];
  scene.cloth = std::make_unique<mesh::ParticleCloth>(std::move(sheet), std::move(places), scene.held);
  return scene;
}

}  // namespace snug::solver
