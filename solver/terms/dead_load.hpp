// Loads that keep size and direction: tractions, weight and point forces, scaled by the load parameter.
#pragma once

#include <vector>

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Nodal forces, N, one a node of a part.
using NodalForces = std::vector<Eigen::Vector3d>;

/// Adds  int N_a t dA  over the facets of the reference body; `traction` in Pa.
void add_traction(const mesh::BodyMesh& mesh, const std::vector<mesh::FacetNodeNumbers>& facets,
                  const Eigen::Vector3d& traction, NodalForces& forces);
/// Adds  int N_a rho g dV  ; `density[l]` of layer l in kg/m3, `gravity` in m/s2.
void add_weight(const mesh::BodyMesh& mesh, const std::vector<double>& density, const Eigen::Vector3d& gravity,
                NodalForces& forces);
/// Adds  int N_a rho g dA  of a garment; `areal_density` in kg/m2, of its own fabric and then of those of its zones.
void add_weight(const mesh::GarmentMesh& mesh, const std::vector<double>& areal_density, const Eigen::Vector3d& gravity, NodalForces& forces);
/// Area of facets of the reference body, m2.
double area(const mesh::BodyMesh& mesh, const std::vector<mesh::FacetNodeNumbers>& facets);

/// Energy  -s sum_a f_a . x_a.
class DeadLoad : public Term {
 public:
  /// Forces at the items of a field of positions.
  DeadLoad(std::string name, const Field& positions, const NodalForces& forces);

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void measure(const State& state, Measure& measure) const override;
  bool is_load() const override { return true; }
  bool empty() const { return forces_.empty(); }

 private:
  std::string name_;
  std::vector<Eigen::Vector3d> forces_;  ///< of the loaded nodes, one an element
  ElementEntries entries_;
};

}  // namespace snug::solver
