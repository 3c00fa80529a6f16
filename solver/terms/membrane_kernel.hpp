// The kernel that fabric and skin share: a membrane whose energy depends on the Green strains along two rest directions.
//
// With rest directions m1, m2 (columns of M) and the surface gradient grad N_a of the nodes,
//   f_i = sum_a (grad N_a . m_i) x_a,   E11 = (f1.f1 - 1)/2,  E22 = (f2.f2 - 1)/2,  2 E12 = f1.f2,
// so that dE_I = B_I . dx with B_1a = d1a f1, B_2a = d2a f2, B_3a = d1a f2 + d2a f1 and d_ia = grad N_a . m_i.
#pragma once

#include <Eigen/Core>

#include "materials/fabric/fabric.hpp"

namespace snug::solver {

/// Dense element vector and matrix (row-major) of up to `Nodes` nodes.
template <int Nodes>
struct MembraneElement {
  static constexpr int size = 3 * Nodes;
  Eigen::Matrix<double, size, 1> residual;
  Eigen::Matrix<double, size, size, Eigen::RowMajor> matrix;
  double energy = 0.0;
  void zero() { residual.setZero(), matrix.setZero(), energy = 0.0; }
};

template <int Nodes>
using NodeVectors = Eigen::Matrix<double, 3, Nodes>;
template <int Nodes>
using Derivatives = Eigen::Matrix<double, 2, Nodes>;  ///< d_ia, 1/m

/// (E11, E22, 2 E12) of the nodes' positions x.
template <int Nodes>
Eigen::Vector3d membrane_strain(const NodeVectors<Nodes>& x, const Derivatives<Nodes>& d) {
  const Eigen::Matrix<double, 3, 2> f = x * d.transpose();
  return {0.5 * (f.col(0).squaredNorm() - 1.0), 0.5 * (f.col(1).squaredNorm() - 1.0), f.col(0).dot(f.col(1))};
}

/// Adds one quadrature point of rest area `weight` (m2). `response` is the law at membrane_strain(x, d).
template <int Nodes>
void add_membrane_point(const NodeVectors<Nodes>& x, const Derivatives<Nodes>& d, double weight,
                        const materials::MembraneResponse& response, bool tangent, MembraneElement<Nodes>& element) {
  const Eigen::Matrix<double, 3, 2> f = x * d.transpose();
  const Eigen::Vector3d& n = response.force;
  Eigen::Matrix<double, 3, 3 * Nodes> B;
  for (int a = 0; a < Nodes; ++a) {
    B.template block<1, 3>(0, 3 * a) = d(0, a) * f.col(0).transpose();
    B.template block<1, 3>(1, 3 * a) = d(1, a) * f.col(1).transpose();
    B.template block<1, 3>(2, 3 * a) = (d(0, a) * f.col(1) + d(1, a) * f.col(0)).transpose();
  }
  element.energy += weight * response.energy;
  element.residual.noalias() += weight * (B.transpose() * n);
  if (!tangent) return;
  element.matrix.noalias() += B.transpose() * (weight * response.tangent * B);
  Eigen::Matrix2d N;
  N << n[0], n[2], n[2], n[1];
  const Eigen::Matrix<double, Nodes, Nodes> geometric = weight * (d.transpose() * N * d);
  for (int a = 0; a < Nodes; ++a)
    for (int b = 0; b < Nodes; ++b)
      element.matrix.template block<3, 3>(3 * a, 3 * b).diagonal().array() += geometric(a, b);
}

}  // namespace snug::solver
