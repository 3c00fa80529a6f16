#include "solver/scene/friction_result.hpp"

#include "solver/scene/contact_rows.hpp"
#include "solver/scene/result.hpp"

namespace snug::solver {

namespace field = postproc::field;

namespace {

using Vertices = std::vector<Friction::VertexTraction>;
using Forces = std::vector<Friction::PointForce>;

// Point forces come in the order of the samples that face the skin.
void fill_samples(const Forces& forces, const Contact& contact, const Vertices& vertices, std::vector<postproc::ContactSample>& samples) {
  auto sample = samples.begin();
  for (const auto& point : forces) {
    if (!on_skin(contact.master(), point.facet)) continue;
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
void fill_balance(const Forces& forces, const Contact& contact, bool deformable, postproc::Balance& balance) {
  for (const auto& point : forces) {
    if (on_skin(contact.master(), point.facet)) add_action(point.force, point.x, deformable, balance);
    balance.friction_force += point.force.norm();
  }
}

void fill_numbers(postproc::RunResult& result) {
  double slipping = 0.0, area = 0.0, largest = 0.0;
  for (const auto& sample : result.samples)
    if (sample.touching) area += sample.area, slipping += sample.slips ? sample.area : 0.0;
  for (const Eigen::Vector3d& t : result.body.fields[field::shear_traction]) largest = std::max(largest, t.norm());
  result.numbers["max_shear_traction_Pa"] = largest;
  result.numbers["slipping_share_of_contact"] = area > 0.0 ? slipping / area : 0.0;
}

}  // namespace

void add_friction(const Friction& friction, const Contact& contact, const State& state, bool deformable,
                  std::vector<postproc::ContactSample>& samples, postproc::Balance& balance) {
  const Forces forces = friction.point_forces(state);
  fill_samples(forces, contact, friction.vertex_tractions(state), samples);
  fill_balance(forces, contact, deformable, balance);
}

void fill_skin_friction(const postproc::SkinPressure& normal, postproc::RunResult& result) {
  auto skin = postproc::transfer_shear(result.body.skin_facets, normal, result.samples);
  result.body.fields.set(field::shear_traction, std::move(skin.traction));
  result.body.fields.set(field::slip, std::move(skin.slip));
  fill_numbers(result);
}

}  // namespace snug::solver
