#include "mesh/curves/b_form.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace snug::mesh::curves {

BForm::BForm(int corners, int degree, Eigen::MatrixXd coefficients)
    : indices_(corners, degree), coefficients_(std::move(coefficients)) {
  if (coefficients_.cols() != indices_.count() || coefficients_.rows() < 1)
    throw std::invalid_argument(fmt::format("a B-form of degree {} on {} corners has {} coefficients, not {}", degree,
                                            corners, indices_.count(), coefficients_.cols()));
}

BForm BForm::step(const Eigen::VectorXd& xi) const {
  if (xi.size() != corners() || degree() < 1)
    throw std::invalid_argument(
        fmt::format("{} barycentric coordinates for {} corners, degree {}", xi.size(), corners(), degree()));
  const MultiIndices lower(corners(), degree() - 1);
  Eigen::MatrixXd next = Eigen::MatrixXd::Zero(dimension(), lower.count());
  std::vector<int> index(corners());
  for (int a = 0; a < lower.count(); ++a)
    for (int j = 0; j < corners(); ++j) {
      index.assign(lower[a].begin(), lower[a].end());
      ++index[j];
      next.col(a) += xi[j] * coefficients_.col(indices_.position(index));
    }
  return {corners(), degree() - 1, std::move(next)};
}

Eigen::VectorXd BForm::value(const Eigen::VectorXd& xi) const {
  BForm form = *this;
  while (form.degree() > 0) form = form.step(xi);
  return form.coefficients_.col(0);
}

BForm BForm::along(const Eigen::VectorXd& direction) const {
  BForm form = step(direction);
  form.coefficients_ *= degree();
  return form;
}

BForm BForm::raised() const {
  const MultiIndices higher(corners(), degree() + 1);
  Eigen::MatrixXd next = Eigen::MatrixXd::Zero(dimension(), higher.count());
  std::vector<int> index(corners());
  for (int a = 0; a < higher.count(); ++a)
    for (int j = 0; j < corners(); ++j) {
      if (higher[a][j] == 0) continue;
      index.assign(higher[a].begin(), higher[a].end());
      --index[j];
      next.col(a) += higher[a][j] / (degree() + 1.0) * coefficients_.col(indices_.position(index));
    }
  return {corners(), degree() + 1, std::move(next)};
}

}  // namespace snug::mesh::curves
