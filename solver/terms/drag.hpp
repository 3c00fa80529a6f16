// Cloth that creeps: what holds a garment while it is let go by and by.
#pragma once

#include <string>
#include <vector>

#include "mesh/garment/garment_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// What the drag remembers: where the garment stands in the accepted state, one entry a component of its nodes.
struct DragHistory : public History {
  void write(ByteWriter& writer) const override { writer(anchor); }
  Eigen::VectorXd anchor;  ///< m
};

/// Force  -c k/h^2 A/6 (x_a - x_a^old)  of each triangle on its six nodes: c = State::drag, k the fabric's stiffness (N/m), h the mean
/// edge, A the triangle's area in the pattern, x^old of the last accepted state. These are implicit Euler steps of cloth in a thick
/// fluid, longer as c falls (pseudo-transient continuation: Kelley & Keyes, SIAM J. Numer. Anal. 35 (1998) 508): of the shapes
/// that cloth without stiffness of its own may take they find one downhill from where it stood. At c = 0, as in every answer,
/// the term is nothing.
class Drag : public Term {
 public:
  Drag(const std::string& garment, const Field& positions, const mesh::GarmentMesh& mesh, double stiffness);

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State&) const override { return entries_; }
  double energy(const State& state) const override;
  double stored_energy(const State&) const override { return 0.0; }
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  void renew(State& state) const override;
  void commit(State& state) const override;
  void restore(State& state) const override;

 private:
  double weight(const State& state, std::size_t triangle) const { return state.drag * weights_[triangle]; }
  /// m, since the accepted state; 18 entries.
  Eigen::Matrix<double, 18, 1> moved(const State& state, std::size_t triangle) const;

  std::string name_;
  Field field_;
  std::vector<double> weights_;  ///< N/m, of a node of each triangle at c = 1
  ElementEntries entries_;       ///< a triangle an element
};

}  // namespace snug::solver
