// Soft tissue and bone: one kernel for all kinds of cell, pressure split off where the law allows it.
#pragma once

#include <memory>
#include <vector>

#include "materials/laws/solid_law.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Hexahedra: the three-field form of Simo, Taylor & Pister (1985), deal.II step-44, with dilatation t and pressure p of a
/// cell in the modes {1, X, Y, Z} (Q2/P1) or {1} (Q1/P0). Stationary point of
///   sum_cells int W_iso(F) + U(t) + p (J - t) dV,   J = det F.
/// t and p are entries of the state without unknowns. Newton's method takes them along: their equations, linear in the step,
/// are solved cell by cell, so that the count of iterations does not grow with the bulk modulus, as it does where p follows
/// U'(J) of every iterate.
///   residual   int (P_iso + p cof F) : grad dv,   r_t = int phi (U'(t) - p),   r_p = int phi (J - t);
///   condensed  D^T M^-1 (r_t + H M^-1 r_p), added to the residual on the right side;
///   tangent    int grad : (A_iso + p dcof F/dF) : grad  +  D^T M^-1 H M^-1 D;
///   recovered  dt = M^-1 (r_p + D du),   dp = M^-1 (r_t + H dt),
///   D_m = int phi_m cof F : grad,  M_mn = int phi_m phi_n,  H_mn = int U''(t) phi_m phi_n.
///
/// Tetrahedra: Taylor & Hood's P2/P1 with the pressure at the vertices as an unknown, continuous inside a layer and not
/// from one layer to the next (a continuous pressure across a contrast of stiffness is wrong). Stationary point of
///   int W_iso(F) + p (J - J~) + U(J~) dV,   J~(p): U'(J~) = p,
/// the complementary energy of the volume taken point by point; rows of p: int L (J - J~), their tangent -int L L / U''.
///
/// Laws without a split (bone) take the plain displacement form in the same cells.
class Tissue : public Term {
 public:
  /// Of the body's nodes; of its pressure unknowns (tetrahedra); dilatations and pressures of its cells (hexahedra).
  struct Fields {
    Field positions, pressures, cells;
  };
  /// `laws[l]` belongs to layer l of the mesh.
  Tissue(std::string name, const Fields& fields, const mesh::BodyMesh& mesh, std::vector<materials::SolidLaw> laws);
  ~Tissue() override;

  std::string name() const override { return name_; }
  const ElementEntries& entries(const State& state) const override;
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;
  void recover(const State& state, Eigen::VectorXd& step) const override;
  void measure(const State& state, Measure& measure) const override;
  void publish(const State& state, PublishedFields& fields) const override;  ///< the stress: averages over the cells of a node
  bool bends() const override { return true; }

  /// Cauchy stress (Pa; rows xx yy zz xy yz xz) at the nodes of a cell, extrapolated from the quadrature points.
  Eigen::Matrix<double, 6, Eigen::Dynamic> nodal_stress(const State& state, int cell) const;

  class Kernel;  ///< the cells of one kind

 private:
  std::string name_;
  Field positions_;
  std::vector<materials::SolidLaw> laws_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace snug::solver
