#include "solver/scene/reactions.hpp"

#include <algorithm>
#include <cmath>

namespace snug::solver {

Eigen::Vector3d holding_force(const Scene& scene, const Eigen::VectorXd& residual, int first) {
  const Bound& bound = scene.numbering().bound();
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  for (int c = 0; c < 3; ++c) {
    if (scene.numbering().unknown(first + c) >= 0) continue;
    force[c] += residual[first + c];
    const auto follows = bound.find(first + c);
    if (follows == bound.end()) continue;
    for (const Follow& of : follows->second) force[of.entry - first] -= of.weight * residual[first + c];
  }
  return force;
}

Eigen::Vector3d edge_force(const Scene& scene, const Eigen::VectorXd& residual, const mesh::GarmentMesh& garment, const std::string& edge) {
  const Field& position = scene.layout()[garment.name];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const int node : garment.edges.at(edge)) sum += holding_force(scene, residual, position(node));
  return sum;
}

std::optional<double> borne_by_free_motions(const Scene& scene, const State& state) {
  if (scene.supports().free_parts().empty()) return {};
  const Eigen::VectorXd residual = scene.full_residual(state);
  double borne = 0.0;
  for (const int entry : scene.supports().free_entries()) borne += std::abs(residual[entry]);
  const Measure measure = scene.measure(state);
  const double force = std::max(measure.contact_force, measure.smallest_force);
  return force > 0.0 ? borne / force : 0.0;
}

}  // namespace snug::solver
