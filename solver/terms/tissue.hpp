// Soft tissue and bone: one kernel for all kinds of cell, pressure split off where the law allows it.
#pragma once

#include <memory>
#include <vector>

#include "materials/laws/solid_law.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Hexahedra: energy  sum_cells int W_iso(F) + U(J~) dV  with J~ the L2 projection of J = det F on {1, X, Y, Z} of the
/// cell (Q2/P1) or on {1} (Q1/P0). This is the three-field form of Simo, Taylor & Pister (1985), deal.II step-44, with
/// pressure and dilatation eliminated:
///   residual  int (P_iso + p cof F) : grad dv,   p = projection of U'(J~);
///   tangent   int grad : (A_iso + p dcof F/dF) : grad  +  D^T M^-1 Hm M^-1 D,
///   D_m = int phi_m cof F : grad,  M_mn = int phi_m phi_n,  Hm_mn = int U''(J~) phi_m phi_n.
///
/// Tetrahedra: Taylor & Hood's P2/P1 with the pressure at the vertices as an unknown, continuous inside a layer and not
/// from one layer to the next (a continuous pressure across a contrast of stiffness is wrong). Stationary point of
///   int W_iso(F) + p (J - J~) + U(J~) dV,   J~(p): U'(J~) = p,
/// the complementary energy of the volume taken point by point; rows of p: int L (J - J~), their tangent -int L L / U''.
///
/// Laws without a split (bone) take the plain displacement form in the same cells.
class Tissue : public Term {
 public:
  /// `laws[l]` belongs to layer l of the mesh.
  Tissue(const Layout& layout, const mesh::BodyMesh& mesh, std::vector<materials::SolidLaw> laws);
  ~Tissue() override;

  std::string name() const override { return "tissue"; }
  const ElementEntries& entries() const override;
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;
  void measure(const State& state, Measure& measure) const override;

  /// Cauchy stress (Pa; rows xx yy zz xy yz xz) at the nodes of a cell, extrapolated from the quadrature points.
  Eigen::Matrix<double, 6, Eigen::Dynamic> nodal_stress(const State& state, int cell) const;

  class Kernel;  ///< the cells of one kind

 private:
  std::vector<materials::SolidLaw> laws_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace snug::solver
