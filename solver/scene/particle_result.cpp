#include <cmath>

#include "solver/scene/hem_folds.hpp"
#include "solver/scene/particle_scene.hpp"
#include "solver/scene/result.hpp"

namespace snug::solver {

namespace {

namespace field = postproc::field;
using Eigen::Vector2d;
using Eigen::Vector3d;
using mesh::ClothForce;

/// Values of the particles at every pattern node; on a mid-edge node the mean of its side's ends.
template <class Value>
std::vector<Value> at_nodes(const mesh::GarmentMesh& garment, const ParticleScene& scene, const std::vector<Value>& of_particles, const Value& zero) {
  std::vector<Value> values(garment.pattern.size(), zero);
  for (std::size_t n = 0; n < values.size(); ++n)
    if (scene.particle_of[n] >= 0) values[n] = of_particles[scene.particle_of[n]];
  for (const auto& t : garment.triangles)
    for (int k = 0; k < 3; ++k) values[t[3 + k]] = 0.5 * (values[t[k]] + values[t[(k + 1) % 3]]);
  return values;
}

const char* meaning(ClothForce kind) {
  switch (kind) {
    case ClothForce::stretch: return "force of the stretched cloth about a particle over its flat area";
    case ClothForce::shear: return "force of the sheared cloth about a particle over its flat area";
    case ClothForce::bending: return "force of the bent cloth about a particle over its flat area, twist with it";
    case ClothForce::band: return "force of bands on a particle over its flat area";
    case ClothForce::pressing: return "force of the skin on a particle over its flat area, off the skin: an estimate, no pressure";
    case ClothForce::friction: return "friction of the skin on a particle over its flat area: an estimate, no traction";
    case ClothForce::drag: return "force of the air against the velocity of a particle over its flat area";
    case ClothForce::weight: return "weight of a particle over its flat area";
  }
  return "";
}

void add_forces(const ParticleScene& scene, const mesh::GarmentMesh& garment, postproc::Fields& fields) {
  for (const ClothForce kind : scene.cloth->kinds()) {
    mesh::Places forces = scene.cloth->forces(kind);
    for (std::size_t n = 0; n < forces.size(); ++n) forces[n] /= scene.cloth->area(static_cast<int>(n));
    postproc::NamedField named{std::string(mesh::texts_of(kind)[static_cast<int>(kind)]) + "_force", "N/m2", meaning(kind), postproc::Place::node,
                               at_nodes<Vector3d>(garment, scene, forces, Vector3d::Zero()), {}, true};
    named.components = postproc::usual_components(named.values);
    fields.add(std::move(named));
  }
}

/// Cauchy forces per current length: a strip along warp is as wide as the weft is stretched.
void add_strains(const ParticleScene& scene, const mesh::GarmentMesh& garment, postproc::Fields& fields, std::map<std::string, double>& numbers) {
  std::vector<double> warp, weft, shear;
  std::vector<Vector2d> stretch;
  double largest = 0.0;
  for (std::size_t t = 0; t < garment.triangles.size(); ++t) {
    const mesh::ParticleCloth::Strained strained = scene.cloth->strained(static_cast<int>(t));
    const double narrower = std::cos(strained.angle);
    stretch.push_back(strained.stretch);
    warp.push_back(strained.tension.x() / (strained.stretch.y() * narrower));
    weft.push_back(strained.tension.y() / (strained.stretch.x() * narrower));
    largest = std::max(largest, strained.stretch.maxCoeff() - 1.0);
  }
  fields.set(field::tension_warp, std::move(warp));
  fields.set(field::tension_weft, std::move(weft));
  fields.set(field::stretch, std::move(stretch));
  numbers["fabric_largest_strain"] = largest;
}

Vector3d sum(const mesh::Places& forces) {
  Vector3d total = Vector3d::Zero();
  for (const Vector3d& one : forces) total += one;
  return total;
}

double sum_of_amounts(const mesh::Places& forces) {
  double total = 0.0;
  for (const Vector3d& one : forces) total += one.norm();
  return total;
}

/// What the skin and the held edges bear, and what is left of the weight: the cloth is in balance as far as that is small.
void fill_balance(const ParticleScene& scene, postproc::Balance& balance) {
  const mesh::Places pressing = scene.cloth->forces(ClothForce::pressing), friction = scene.cloth->forces(ClothForce::friction);
  balance.contact_force = sum_of_amounts(pressing), balance.friction_force = sum_of_amounts(friction);
  balance.garment_force = sum(pressing) + sum(friction), balance.skin_force = -balance.garment_force;
  balance.garment_weight = sum(scene.cloth->forces(ClothForce::weight));
  const mesh::Places total = scene.cloth->total_forces();
  for (std::size_t n = 0; n < total.size(); ++n) {
    const Vector3d left = scene.cloth->free_part(static_cast<int>(n), total[n]);
    balance.force_error += left;
    balance.moment_error += scene.cloth->places()[n].cross(left);
    if (!scene.holder[n].empty())
      balance.reactions.try_emplace(scene.holder[n] + " edge", Vector3d::Zero()).first->second -= total[n] - left;
  }
}

void fill_numbers(const ParticleScene& scene, const mesh::GarmentMesh& garment, postproc::RunResult& result) {
  const auto& current = result.garment.current;
  double touching = 0.0, area = 0.0, fallen = 0.0;
  for (std::size_t n = 0; n < scene.held.size(); ++n) {
    const double own = scene.cloth->area(static_cast<int>(n));
    area += own, touching += scene.cloth->touches(static_cast<int>(n)) ? own : 0.0;
  }
  for (std::size_t n = 0; n < current.size(); ++n) fallen += (garment.placed[n].z() - current[n].z()) / static_cast<double>(current.size());
  const HemFolds hem = hem_folds(garment, current);
  result.numbers["cloth_weight_N"] = scene.weight;
  result.numbers["contact_force_estimate_N"] = result.balance.contact_force;
  result.numbers["balance_error_over_weight"] = result.balance.force_error.norm() / scene.weight;
  result.numbers["touching_share_of_cloth"] = area > 0.0 ? touching / area : 0.0;
  result.numbers["mean_fall_m"] = fallen;
  result.numbers["hem_folds"] = hem.count;
  result.numbers["hem_least_radius_m"] = hem.least, result.numbers["hem_mean_radius_m"] = hem.mean, result.numbers["hem_largest_radius_m"] = hem.largest;
  result.numbers["hem_height_m"] = hem.height;
}

}  // namespace

void fill_particle_result(const ParticleScene& scene, const Model& model, const Meshes& meshes, postproc::RunResult& result) {
  const mesh::GarmentMesh& garment = meshes.garments.front();
  for (const auto* unknown : {&field::contact_pressure, &field::coverage}) result.body.fields.remove(*unknown);
  append(garment, result.garment);
  result.garment.current = at_nodes<Vector3d>(garment, scene, scene.cloth->places(), Vector3d::Zero());
  add_named_edges(garment, true, 0, 0, result.garment.edges);
  add_strains(scene, garment, result.garment.fields, result.numbers);
  add_forces(scene, garment, result.garment.fields);
  fill_balance(scene, result.balance);
  result.max_penetration = scene.cloth->penetration();
  if (model.contact_of(0) == nullptr) result.balance.contact_force = 0.0;
  fill_numbers(scene, garment, result);
}

}  // namespace snug::solver
