#include "solver/terms/dead_load.hpp"

#include <Eigen/Geometry>

#include "solver/terms/facet_kind.hpp"
#include "solver/terms/garment_shape.hpp"
#include "solver/terms/tabulate.hpp"

namespace snug::solver {

void add_traction(const mesh::BodyMesh& mesh, const std::vector<mesh::FacetNodeNumbers>& facets,
                  const Eigen::Vector3d& traction, NodalForces& forces) {
  const mesh::FacetKind kind = facet_kind(mesh.kind);
  for (const auto& facet : facets) {
    const FacetNodes x = facet_positions(mesh, facet);
    for (const FacetRulePoint& q : facet_rule(kind)) {
      const double dA = q.weight * facet_point(x, q.shape).area;
      for (int a = 0; a < node_count(kind); ++a) forces[facet[a]] += dA * q.shape.N[a] * traction;
    }
  }
}

void add_weight(const mesh::BodyMesh& mesh, const std::vector<double>& density, const Eigen::Vector3d& gravity,
                NodalForces& forces) {
  const auto& rule = mesh::gauss_points(mesh.kind);
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Eigen::VectorXd weight = tabulate(mesh, static_cast<int>(c)).weight;
    for (std::size_t q = 0; q < rule.size(); ++q) {
      for (int a = 0; a < node_count(mesh.kind); ++a)
        forces[mesh.cells[c][a]] += weight[q] * density[mesh.cell_layer[c]] * rule[q].values[a] * gravity;
    }
  }
}

void add_weight(const mesh::GarmentMesh& mesh, const std::vector<double>& areal_density, const Eigen::Vector3d& gravity, NodalForces& forces) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& triangle = mesh.triangles[t];
    const double density = areal_density[1 + mesh.zone_of(t)];
    const Eigen::Matrix<double, 1, 6> course = mesh.course_of(t);
    Eigen::Matrix<double, 2, 6> pattern;
    for (int a = 0; a < 6; ++a) pattern.col(a) = mesh.pattern[triangle[a]];
    for (const TrianglePoint& q : triangle_rule()) {
      const auto N = garment_values(mesh.order, q.L);
      const double dm = q.weight * pattern_point(mesh.order, pattern, q.L).area * density * course_value(course, N);
      for (int a = 0; a < 6; ++a) forces[mesh.merged[triangle[a]]] += dm * N[a] * gravity;
    }
  }
}

double area(const mesh::BodyMesh& mesh, const std::vector<mesh::FacetNodeNumbers>& facets) {
  const mesh::FacetKind kind = facet_kind(mesh.kind);
  double sum = 0.0;
  for (const auto& facet : facets)
    for (const FacetRulePoint& q : facet_rule(kind))
      sum += q.weight * facet_point(facet_positions(mesh, facet), q.shape).area;
  return sum;
}

DeadLoad::DeadLoad(std::string name, const Field& positions, const NodalForces& forces) : name_(std::move(name)) {
  for (std::size_t node = 0; node < forces.size(); ++node) {
    if (forces[node].isZero(0.0)) continue;
    const int entry = positions(static_cast<int>(node));
    forces_.push_back(forces[node]);
    entries_.push(std::array{entry, entry + 1, entry + 2});
  }
}

double DeadLoad::energy(const State& state) const {
  double sum = 0.0;
  for (std::size_t i = 0; i < forces_.size(); ++i)
    sum -= forces_[i].dot(state.values.segment<3>(entries_.of(static_cast<int>(i))[0]));
  return state.load * sum;
}

bool DeadLoad::assemble(const State& state, Tangent, Sink& sink) const {
  for (std::size_t i = 0; i < forces_.size(); ++i) {
    const Eigen::Vector3d residual = -state.load * forces_[i];
    sink.add(static_cast<int>(i), {residual.data(), 3}, {});
  }
  return true;
}

void DeadLoad::measure(const State& state, Measure& measure) const {
  for (const Eigen::Vector3d& force : forces_) measure.contact_force += std::abs(state.load) * force.norm();
}

}  // namespace snug::solver
