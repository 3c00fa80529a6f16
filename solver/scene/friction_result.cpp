#include "solver/scene/friction_result.hpp"

#include "solver/scene/result.hpp"

namespace snug::solver {

namespace {

using Vertices = std::vector<Friction::VertexTraction>;

// Point forces come in the order of the samples that face the skin.
void fill_samples(const Friction& friction, const Contact& contact, const State& state, const Vertices& vertices,
                  std::vector<postproc::ContactSample>& samples) {
  auto sample = samples.begin();
  for (const auto& point : friction.point_forces(state)) {
    while (sample->facet < 0) ++sample;
    sample->shear = -point.force;
    double slipping = 0.0;
    for (int v = 0; v < 3; ++v)
      if (vertices[contact.vertices_of(point.triangle)[v]].slip == Friction::Slip::slip) slipping += point.L[v];
    sample->slips = slipping > 0.5;
    ++sample;
  }
}

// The forces act on the garment where it is: friction feels the gap's lever arm, a normal force does not.
void fill_balance(const Friction& friction, const State& state, bool deformable, postproc::Balance& balance) {
  for (const auto& point : friction.point_forces(state)) {
    add_action(point.force, point.x, deformable, balance);
    balance.friction_force += point.force.norm();
  }
}

// Tractions of the vertices, per current area as the pressure is; mid-edge nodes get the mean of their edge.
void fill_garment(const Contact& contact, const State& state, const Vertices& vertices, const mesh::GarmentMesh& mesh, int first,
                  postproc::GarmentResult& garment) {
  garment.shear_traction.resize(garment.pattern.size(), Eigen::Vector3d::Zero());
  garment.slip.resize(garment.pattern.size(), 0.0);
  for (const auto& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const int node = first + triangle[k], i = contact.multiplier_of(mesh.merged[triangle[k]]);
      const double p = contact.pressure(state, i);
      const double per_current_area = p != 0.0 ? garment.contact_pressure[node] / p : 0.0;
      garment.shear_traction[node] = per_current_area * vertices[i].traction;
      garment.slip[node] = static_cast<double>(vertices[i].slip);
    }
    for (int k = 0; k < 3; ++k) {
      const int a = first + triangle[k], b = first + triangle[(k + 1) % 3], middle = first + triangle[3 + k];
      garment.shear_traction[middle] = 0.5 * (garment.shear_traction[a] + garment.shear_traction[b]);
      garment.slip[middle] = std::max(garment.slip[a], garment.slip[b]);
    }
  }
}

void fill_numbers(postproc::RunResult& result) {
  double slipping = 0.0, area = 0.0, largest = 0.0;
  for (const auto& sample : result.samples)
    if (sample.touching) area += sample.area, slipping += sample.slips ? sample.area : 0.0;
  for (const Eigen::Vector3d& t : result.body.shear_traction) largest = std::max(largest, t.norm());
  result.numbers["max_shear_traction_Pa"] = largest;
  result.numbers["slipping_share_of_contact"] = area > 0.0 ? slipping / area : 0.0;
}

}  // namespace

void add_friction(const Friction& friction, const Contact& contact, const State& state, bool deformable, const mesh::GarmentMesh& garment,
                  int first, std::vector<postproc::ContactSample>& samples, postproc::RunResult& result) {
  const Vertices vertices = friction.vertex_tractions(state);
  fill_samples(friction, contact, state, vertices, samples);
  fill_balance(friction, state, deformable, result.balance);
  fill_garment(contact, state, vertices, garment, first, result.garment);
}

void fill_skin_friction(const postproc::SkinPressure& normal, postproc::RunResult& result) {
  const std::size_t nodes = result.garment.pattern.size();  // garments that do not rub have none
  result.garment.shear_traction.resize(nodes, Eigen::Vector3d::Zero()), result.garment.slip.resize(nodes, 0.0);
  auto skin = postproc::transfer_shear(result.body.skin_facets, normal, result.samples);
  result.body.shear_traction = std::move(skin.traction);
  result.body.slip = std::move(skin.slip);
  fill_numbers(result);
}

}  // namespace snug::solver
