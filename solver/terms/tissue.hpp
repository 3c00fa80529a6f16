// Soft tissue: Q2 displacement with discontinuous P1 pressure and dilatation, condensed inside the cell.
#pragma once

#include <array>
#include <vector>

#include "materials/laws/solid_law.hpp"
#include "mesh/body/body_mesh.hpp"
#include "solver/terms/term.hpp"

namespace snug::solver {

/// Energy  sum_cells int W_iso(F) + U(J~) dV  with J~ the L2 projection of J = det F on {1, X, Y, Z} of the cell.
/// This is the three-field form of Simo, Taylor & Pister (1985), deal.II step-44, with pressure and dilatation eliminated:
///   residual  int (P_iso + p cof F) : grad dv,   p = projection of U'(J~);
///   tangent   int grad : (A_iso + p dcof F/dF) : grad  +  D^T M^-1 Hm M^-1 D,
///   D_m = int phi_m cof F : grad,  M_mn = int phi_m phi_n,  Hm_mn = int U''(J~) phi_m phi_n.
class Tissue : public Term {
 public:
  /// `laws[l]` belongs to layer l of the mesh.
  Tissue(const Layout& layout, const mesh::BodyMesh& mesh, std::vector<materials::SolidLaw> laws);

  std::string name() const override { return "tissue"; }
  const ElementEntries& entries() const override { return entries_; }
  double energy(const State& state) const override;
  bool assemble(const State& state, Tangent tangent, Sink& sink) const override;
  double step_bound(const State& state, const Eigen::VectorXd& direction, double limit) const override;

  /// Cauchy stress (Pa; xx yy zz xy yz xz) at the 27 nodes of a cell, extrapolated from the quadrature points.
  std::array<Eigen::Matrix<double, 6, 1>, 27> nodal_stress(const State& state, int cell) const;
  int cells() const { return static_cast<int>(cells_.size()); }

 private:
  static constexpr int points = 27, nodes = 27, modes = 4;
  using Gradients = Eigen::Matrix<double, 27, 81>;   ///< node a, column 3 q + J
  struct Cell {
    std::array<int, 27> nodes;
    const materials::SolidLaw* law;
    Gradients gradient;                              ///< 1/m
    Eigen::Matrix<double, 27, 1> weight;             ///< m3
    Eigen::Matrix<double, 4, 27> mode;               ///< phi_m at the points
    Eigen::Matrix4d mass_inverse;
  };
  struct Kinematics {
    std::array<Eigen::Matrix3d, 27> F, cofactor;
    Eigen::Matrix<double, 27, 1> J, averaged, pressure, modulus;
    double volumetric_energy = 0.0;
  };
  struct Slot;
  Eigen::Matrix<double, 3, 27> positions(const Eigen::VectorXd& values, const Cell& cell) const;
  bool kinematics(const State& state, const Cell& cell, Kinematics& k) const;
  void residual_and_tangent(const Cell& cell, const Kinematics& k, bool tangent, Slot& slot) const;

  Layout layout_;
  std::vector<materials::SolidLaw> laws_;
  std::vector<Cell> cells_;
  ElementEntries entries_;
};

}  // namespace snug::solver
