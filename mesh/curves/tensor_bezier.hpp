// Tensor-product Bézier curves, surfaces and volumes, and the B-forms that equal them.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mesh/curves/b_form.hpp"

namespace snug::mesh::curves {

/// R(t) = sum R_k prod_j C(n_j, k_j) t_j^k_j (1 - t_j)^(n_j - k_j) on [0, 1]^mu.
class TensorBezier {
 public:
  /// `coefficients`: one column an index k, the last part of k running fastest. Throws std::invalid_argument otherwise.
  TensorBezier(std::vector<int> degrees, Eigen::MatrixXd coefficients);

  int variables() const { return static_cast<int>(degrees_.size()); }
  const std::vector<int>& degrees() const { return degrees_; }
  int dimension() const { return static_cast<int>(coefficients_.rows()); }
  const Eigen::MatrixXd& coefficients() const { return coefficients_; }
  int count() const { return static_cast<int>(coefficients_.cols()); }
  /// The index k of a column, and its column.
  std::vector<int> index(int position) const;
  int position(const std::vector<int>& index) const;
  /// prod C(n_j, k_j)
  double multinomial(int position) const;

  Eigen::VectorXd value(const Eigen::VectorXd& t) const;
  /// The same by degrees none of which is smaller.
  TensorBezier raised(const std::vector<int>& degrees) const;

 private:
  std::vector<int> degrees_;
  Eigen::MatrixXd coefficients_;
};

/// The barycentric coordinates in the simplex of 2^mu corners at which the B-form of a tensor-product Bézier equals it
/// at t: corner c has the product of t_j where bit j of c, counted from the highest, is 0 and of 1 - t_j where it is 1.
/// mu = 2: (st, s(1-t), (1-s)t, (1-s)(1-t)), the manifold xi_1 xi_4 = xi_2 xi_3 of the tetrahedron.
Eigen::VectorXd tensor_coordinates(const Eigen::VectorXd& t);
/// The index k that a multi-index of 2^mu parts belongs to: k_j is the sum of the parts whose corner has t_j (3.21),
/// mended.
std::vector<int> tensor_index(std::span<const int> index);

/// P_i = R_k with k = tensor_index(i) (theorems 3.10, 3.11). Unequal degrees are raised to the greatest first.
BForm b_form_of(const TensorBezier& bezier);
/// R_k = sum of P_i (n!/i!) over the i that belong to k, over prod C(n, k_j) (3.22): the tensor-product Bézier that any
/// B-form on 2^mu corners is on the manifold of tensor_coordinates. Throws std::invalid_argument unless the corners are
/// a power of two.
TensorBezier tensor_of(const BForm& form);

}  // namespace snug::mesh::curves
