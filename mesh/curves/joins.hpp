// Smooth joins of Bézier patches along an edge: conditions that give control points, and checks of patches that are
// there.
#pragma once

#include <Eigen/Core>

#include <utility>
#include <vector>

#include "mesh/curves/b_form.hpp"
#include "mesh/curves/tensor_bezier.hpp"

namespace snug::mesh::curves {

/// One control point of the second patch as a combination of control points of the first, by their columns.
struct JoinCondition {
  int target = 0;
  std::vector<std::pair<int, double>> sources;
};

/// Two triangles of one degree with the common edge u1 u2; `alpha` are the coordinates of the second one's third corner
/// in the first: sum 1, the third negative (the second lies beyond the edge). Derivatives up to `order` agree along the
/// edge: b*(a + r e3) = sum over |c| = r of (r!/c!) alpha^c b(a + c), |a| = n - r, a3 = 0, r = 0…order (3.24), (3.26);
/// (3.26) with any other weights of sum 1 does not give this from the second order on. Throws std::invalid_argument for
/// another alpha or an order above the degree.
std::vector<JoinCondition> triangle_join(int degree, const Eigen::Vector3d& alpha, int order);

/// The triangle b with the edge u1 u2 and the n × n rectangle r whose edge j = 0 it is: r_i0 = b_{n-i,i,0} and one
/// tangent plane along it by r_i1 - r_i0 = (i/n) (mu1 e_{i-1} + lambda1 f_{i-1}) + (1 - i/n) (mu0 e_i + lambda0 f_i),
/// e_i = b_{n-i-1,i+1,0} - b_{n-i,i,0}, f_i = b_{n-i-1,i,1} - b_{n-i,i,0} (3.28, mended), mu0 = alpha_2, lambda0 =
/// alpha_3, mu1 = -(beta_2 + beta_3), lambda1 = beta_3. `alpha` and `beta` place r_01 and r_n1 (3.27): sum 1, third
/// negative, with weights of b_{n,0,0}, b_{n-1,1,0}, b_{n-1,0,1} and of b_{0,n,0}, b_{1,n-1,0}, b_{0,n-1,1}. Throws
/// std::invalid_argument otherwise.
std::vector<JoinCondition> rectangle_join(int degree, const Eigen::Vector3d& alpha, const Eigen::Vector3d& beta);

/// Sets the control points that the conditions give; the other columns of `second` stay.
void complete(Eigen::MatrixXd& second, const std::vector<JoinCondition>& conditions, const Eigen::MatrixXd& first);
/// Largest distance of a control point from where the conditions want it.
double residual(const Eigen::MatrixXd& second, const std::vector<JoinCondition>& conditions,
                const Eigen::MatrixXd& first);

/// The alpha by which two triangles come nearest to (3.25), by least squares. Their residual says whether they join.
Eigen::Vector3d fitted_alpha(const BForm& first, const BForm& second);

/// What two patches in space leave open along their edge, at more points than the polynomials have zeros.
struct JoinGap {
  double position = 0.0;  ///< largest distance of the two edges
  double tangent =
      0.0;  ///< largest |det(edge, across one, across the other)| of unit vectors: the planes' angle, small
};
JoinGap join_gap(const BForm& first, const BForm& second);
JoinGap join_gap(const BForm& triangle, const TensorBezier& rectangle);

}  // namespace snug::mesh::curves
