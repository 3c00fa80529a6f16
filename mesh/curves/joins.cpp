#include "mesh/curves/joins.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

namespace snug::mesh::curves {

namespace {

void check_beyond(const Eigen::Vector3d& alpha) {
  if (!alpha.allFinite() || std::abs(alpha.sum() - 1.0) > 1e-12 || !(alpha[2] < 0.0))
    throw std::invalid_argument(
        fmt::format("({}, {}, {}) is no place beyond the edge: the sum must be 1 and the third negative", alpha[0],
                    alpha[1], alpha[2]));
}

using Weights = std::map<int, double>;  // column of the first patch, weight

JoinCondition condition(int target, const Weights& weights) { return {target, {weights.begin(), weights.end()}}; }

/// Direction of the edge's derivative and across it, from one patch.
struct Slopes {
  Eigen::Vector3d place, along, across;
};

Slopes slopes_of(const BForm& triangle, double t) {
  const Eigen::Vector3d at(1.0 - t, t, 0.0);
  return {triangle.value(at), triangle.along(Eigen::Vector3d(-1, 1, 0)).value(at),
          triangle.along(Eigen::Vector3d(-1, 0, 1)).value(at)};
}

/// Bézier curve of the edge j = 0, and of the differences to j = 1.
Slopes slopes_of(const TensorBezier& rectangle, double t) {
  const int n = rectangle.degrees()[0], m = rectangle.degrees()[1];
  Eigen::MatrixXd edge(3, n + 1), across(3, n + 1);
  for (int i = 0; i <= n; ++i) {
    edge.col(i) = rectangle.coefficients().col(rectangle.position({i, 0}));
    across.col(i) = m * (rectangle.coefficients().col(rectangle.position({i, 1})) - edge.col(i));
  }
  const Eigen::MatrixXd along = n * (edge.rightCols(n) - edge.leftCols(n));
  const Eigen::VectorXd at = Eigen::VectorXd::Constant(1, t);
  return {TensorBezier({n}, edge).value(at), TensorBezier({n - 1}, along).value(at),
          TensorBezier({n}, across).value(at)};
}

template <class Second>
JoinGap gap_between(const BForm& first, const Second& second, int points) {
  if (first.corners() != 3 || first.dimension() != 3 || second.dimension() != 3 || first.degree() < 1)
    throw std::invalid_argument("joins are measured between patches in space, the first a triangle");
  JoinGap gap;
  for (int k = 0; k < points; ++k) {
    const double t = k / (points - 1.0);
    const Slopes a = slopes_of(first, t), b = slopes_of(second, t);
    gap.position = std::max(gap.position, (a.place - b.place).norm());
    Eigen::Matrix3d frame;
    frame << a.along.normalized(), a.across.normalized(), b.across.normalized();
    gap.tangent = std::max(gap.tangent, std::abs(frame.determinant()));
  }
  return gap;
}

}  // namespace

std::vector<JoinCondition> triangle_join(int degree, const Eigen::Vector3d& alpha, int order) {
  check_beyond(alpha);
  if (order < 0 || order > degree)
    throw std::invalid_argument(fmt::format("order {} of a join of degree {}", order, degree));
  const MultiIndices indices(3, degree);
  std::vector<JoinCondition> conditions;
  for (int r = 0; r <= order; ++r) {
    const MultiIndices parts(3, r);
    for (int a1 = degree - r; a1 >= 0; --a1) {
      const int a2 = degree - r - a1;
      Weights weights;
      for (int c = 0; c < parts.count(); ++c) {
        const std::array index = {a1 + parts[c][0], a2 + parts[c][1], parts[c][2]};
        double weight = parts.multinomial(c);
        for (int j = 0; j < 3; ++j) weight *= std::pow(alpha[j], parts[c][j]);
        weights[indices.position(index)] += weight;
      }
      conditions.push_back(condition(indices.position(std::array{a1, a2, r}), weights));
    }
  }
  return conditions;
}

std::vector<JoinCondition> rectangle_join(int degree, const Eigen::Vector3d& alpha, const Eigen::Vector3d& beta) {
  check_beyond(alpha), check_beyond(beta);
  if (degree < 1) throw std::invalid_argument("a join is of degree one at least");
  const int n = degree;
  const MultiIndices indices(3, n);
  const auto b = [&](int i, int j, int k) { return indices.position(std::array{i, j, k}); };
  const double mu0 = alpha[1], lambda0 = alpha[2], mu1 = -(beta[1] + beta[2]), lambda1 = beta[2];
  std::vector<JoinCondition> conditions;
  for (int i = 0; i <= n; ++i) {
    conditions.push_back({i * (n + 1), {{b(n - i, i, 0), 1.0}}});
    Weights weights{{b(n - i, i, 0), 1.0}};
    const auto add = [&](int k, double share, double mu, double lambda) {  // share (mu e_k + lambda f_k)
      weights[b(n - k - 1, k + 1, 0)] += share * mu;
      weights[b(n - k - 1, k, 1)] += share * lambda;
      weights[b(n - k, k, 0)] -= share * (mu + lambda);
    };
    const double share = static_cast<double>(i) / n;
    if (i > 0) add(i - 1, share, mu1, lambda1);
    if (i < n) add(i, 1.0 - share, mu0, lambda0);
    conditions.push_back(condition(i * (n + 1) + 1, weights));
  }
  return conditions;
}

void complete(Eigen::MatrixXd& second, const std::vector<JoinCondition>& conditions, const Eigen::MatrixXd& first) {
  for (const JoinCondition& one : conditions) {
    second.col(one.target).setZero();
    for (const auto& [source, weight] : one.sources) second.col(one.target) += weight * first.col(source);
  }
}

double residual(const Eigen::MatrixXd& second, const std::vector<JoinCondition>& conditions,
                const Eigen::MatrixXd& first) {
  Eigen::MatrixXd wanted = second;
  complete(wanted, conditions, first);
  return (wanted - second).colwise().norm().maxCoeff();
}

Eigen::Vector3d fitted_alpha(const BForm& first, const BForm& second) {
  const int n = first.degree(), rows = first.dimension();
  if (first.corners() != 3 || second.corners() != 3 || second.degree() != n || second.dimension() != rows || n < 1)
    throw std::invalid_argument("a join is that of two triangles of one degree");
  Eigen::MatrixXd matrix(rows * n, 2);
  Eigen::VectorXd right(rows * n);
  for (int a2 = 0; a2 < n; ++a2) {
    const int a1 = n - 1 - a2;
    const Eigen::VectorXd from = first.coefficient(std::array{a1 + 1, a2, 0});
    matrix.col(0).segment(rows * a2, rows) = first.coefficient(std::array{a1, a2 + 1, 0}) - from;
    matrix.col(1).segment(rows * a2, rows) = first.coefficient(std::array{a1, a2, 1}) - from;
    right.segment(rows * a2, rows) =
        second.coefficient(std::array{a1, a2, 1}) - second.coefficient(std::array{a1 + 1, a2, 0});
  }
  const Eigen::Vector2d found = matrix.colPivHouseholderQr().solve(right);
  return {1.0 - found.sum(), found[0], found[1]};
}

JoinGap join_gap(const BForm& first, const BForm& second) {
  if (second.corners() != 3) throw std::invalid_argument("the second patch is no triangle");
  return gap_between(first, second, 3 * std::max(first.degree(), second.degree()) + 1);
}

JoinGap join_gap(const BForm& triangle, const TensorBezier& rectangle) {
  if (rectangle.variables() != 2 || rectangle.degrees()[0] < 1 || rectangle.degrees()[1] < 1)
    throw std::invalid_argument("the second patch is no rectangle");
  return gap_between(triangle, rectangle, 3 * std::max(triangle.degree(), rectangle.degrees()[0]) + 1);
}

}  // namespace snug::mesh::curves
