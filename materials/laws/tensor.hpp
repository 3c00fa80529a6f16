// Small tensor algebra that several laws share. Components F_iJ of a tensor stand at 3 i + J in a vector of nine.
#pragma once

#include <Eigen/Core>

namespace snug::materials {

/// Matrix of cofactors J F^-T.
inline Eigen::Matrix3d cofactor(const Eigen::Matrix3d& F) {
  Eigen::Matrix3d c;
  c << F(1, 1) * F(2, 2) - F(1, 2) * F(2, 1), F(1, 2) * F(2, 0) - F(1, 0) * F(2, 2),
      F(1, 0) * F(2, 1) - F(1, 1) * F(2, 0), F(2, 1) * F(0, 2) - F(2, 2) * F(0, 1),
      F(2, 2) * F(0, 0) - F(2, 0) * F(0, 2), F(2, 0) * F(0, 1) - F(2, 1) * F(0, 0),
      F(0, 1) * F(1, 2) - F(0, 2) * F(1, 1), F(0, 2) * F(1, 0) - F(0, 0) * F(1, 2),
      F(0, 0) * F(1, 1) - F(0, 1) * F(1, 0);
  return c;
}

/// det F from its cofactors, without a second expansion.
inline double determinant(const Eigen::Matrix3d& F, const Eigen::Matrix3d& cofactor) {
  return F.row(0).dot(cofactor.row(0));
}

/// The nine components in the order of a tangent's rows.
inline Eigen::Matrix<double, 9, 1> components(const Eigen::Matrix3d& T) {
  Eigen::Matrix<double, 9, 1> v;
  v << T(0, 0), T(0, 1), T(0, 2), T(1, 0), T(1, 1), T(1, 2), T(2, 0), T(2, 1), T(2, 2);
  return v;
}

/// Adds f A_iL A_kJ to the tangent (derivative of a transposed inverse; A = F gives F dF^T F).
inline void add_swapped(Eigen::Matrix<double, 9, 9>& tangent, double f, const Eigen::Matrix3d& A) {
  for (int i = 0; i < 3; ++i)
    for (int J = 0; J < 3; ++J)
      for (int k = 0; k < 3; ++k)
        for (int L = 0; L < 3; ++L) tangent(3 * i + J, 3 * k + L) += f * A(i, L) * A(k, J);
}

/// Adds delta_ik S_JL, the part of a tangent that the stress itself makes.
inline void add_geometric(Eigen::Matrix<double, 9, 9>& tangent, const Eigen::Matrix3d& S) {
  for (int i = 0; i < 3; ++i) tangent.block<3, 3>(3 * i, 3 * i) += S;
}

}  // namespace snug::materials
