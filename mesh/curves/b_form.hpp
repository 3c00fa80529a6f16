// Multivariate Bernstein polynomials on a simplex: B-forms.
#pragma once

#include <Eigen/Core>

#include "mesh/curves/multi_index.hpp"

namespace snug::mesh::curves {

/// P(xi) = sum over |a| = n of P_a (n! / a!) xi^a, with as many barycentric coordinates xi as the simplex has corners
/// (definition 3.5). On a curved set of points inside the simplex it is a surface over that set. Rational ones have
/// homogeneous coefficients.
class BForm {
 public:
  /// `coefficients`: one column a multi-index, in the order of MultiIndices. Throws std::invalid_argument otherwise.
  BForm(int corners, int degree, Eigen::MatrixXd coefficients);

  int corners() const { return indices_.corners(); }
  int degree() const { return indices_.degree(); }
  int dimension() const { return static_cast<int>(coefficients_.rows()); }
  const MultiIndices& indices() const { return indices_; }
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  Eigen::VectorXd coefficient(std::span<const int> index) const { return coefficients_.col(indices_.position(index)); }
  void set(std::span<const int> index, const Eigen::VectorXd& value) {
    coefficients_.col(indices_.position(index)) = value;
  }

  /// By de Casteljau's steps. `xi`: one number a corner.
  Eigen::VectorXd value(const Eigen::VectorXd& xi) const;
  /// The derivative along a direction given in barycentric coordinates (its sum is 0), of one degree less; degree >= 1.
  BForm along(const Eigen::VectorXd& direction) const;
  /// The same polynomial, on sum xi = 1, by one degree more.
  BForm raised() const;

 private:
  /// One de Casteljau step: column a is sum_j xi_j P_{a + e_j}, |a| = n - 1.
  BForm step(const Eigen::VectorXd& xi) const;

  MultiIndices indices_;
  Eigen::MatrixXd coefficients_;
};

}  // namespace snug::mesh::curves
