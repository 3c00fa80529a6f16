#include "mesh/curves/tensor_bezier.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <stdexcept>

#include "mesh/curves/binomial.hpp"

namespace snug::mesh::curves {

namespace {

double count_of(const std::vector<int>& degrees) {
  double count = 1.0;
  for (const int degree : degrees) count *= degree + 1.0;
  return count;
}

}  // namespace

TensorBezier::TensorBezier(std::vector<int> degrees, Eigen::MatrixXd coefficients)
    : degrees_(std::move(degrees)), coefficients_(std::move(coefficients)) {
  const bool negative = std::any_of(degrees_.begin(), degrees_.end(), [](int degree) { return degree < 0; });
  if (degrees_.empty() || negative || coefficients_.cols() != count_of(degrees_) || coefficients_.rows() < 1)
    throw std::invalid_argument(fmt::format("{} coefficients for {} variables", coefficients_.cols(), degrees_.size()));
}

std::vector<int> TensorBezier::index(int position) const {
  std::vector<int> index(degrees_.size());
  for (int j = variables() - 1; j >= 0; --j) {
    index[j] = position % (degrees_[j] + 1);
    position /= degrees_[j] + 1;
  }
  return index;
}

int TensorBezier::position(const std::vector<int>& index) const {
  int position = 0;
  for (int j = 0; j < variables(); ++j) position = position * (degrees_[j] + 1) + index[j];
  return position;
}

double TensorBezier::multinomial(int position) const {
  const std::vector<int> k = index(position);
  double value = 1.0;
  for (int j = 0; j < variables(); ++j) value *= binomial(degrees_[j], k[j]);
  return value;
}

Eigen::VectorXd TensorBezier::value(const Eigen::VectorXd& t) const {
  if (t.size() != variables())
    throw std::invalid_argument(fmt::format("{} parameters for {} variables", t.size(), variables()));
  Eigen::MatrixXd c = coefficients_;
  for (int j = variables() - 1; j >= 0; --j) {  // the fastest index first
    const int order = degrees_[j] + 1;
    for (int l = 1; l < order; ++l)
      for (Eigen::Index row = 0; row < c.cols(); row += order)
        for (int k = 0; k < order - l; ++k) c.col(row + k) = (1.0 - t[j]) * c.col(row + k) + t[j] * c.col(row + k + 1);
    for (Eigen::Index row = 0; row < c.cols(); row += order) c.col(row / order) = c.col(row);
    c.conservativeResize(Eigen::NoChange, c.cols() / order);
  }
  return c.col(0);
}

TensorBezier TensorBezier::raised(const std::vector<int>& degrees) const {
  if (degrees.size() != degrees_.size()) throw std::invalid_argument("a degree for every variable");
  TensorBezier now = *this;
  for (int j = 0; j < variables(); ++j) {
    if (degrees[j] < degrees_[j]) throw std::invalid_argument("a degree cannot be lowered");
    while (now.degrees_[j] < degrees[j]) {  // R_k = k/(n+1) R_{k-1} + (1 - k/(n+1)) R_k
      TensorBezier next = now;
      const int n = next.degrees_[j]++;
      next.coefficients_ = Eigen::MatrixXd::Zero(dimension(), static_cast<Eigen::Index>(count_of(next.degrees_)));
      for (int p = 0; p < next.count(); ++p) {
        std::vector<int> k = next.index(p);
        const double share = k[j] / (n + 1.0);
        if (k[j] <= n) next.coefficients_.col(p) += (1.0 - share) * now.coefficients_.col(now.position(k));
        if (--k[j] >= 0) next.coefficients_.col(p) += share * now.coefficients_.col(now.position(k));
      }
      now = std::move(next);
    }
  }
  return now;
}

Eigen::VectorXd tensor_coordinates(const Eigen::VectorXd& t) {
  const int variables = static_cast<int>(t.size());
  Eigen::VectorXd xi = Eigen::VectorXd::Ones(1 << variables);
  for (int corner = 0; corner < xi.size(); ++corner)
    for (int j = 0; j < variables; ++j) xi[corner] *= corner >> (variables - 1 - j) & 1 ? 1.0 - t[j] : t[j];
  return xi;
}

std::vector<int> tensor_index(std::span<const int> index) {
  const int variables = std::bit_width(index.size()) - 1;
  std::vector<int> k(variables, 0);
  for (std::size_t corner = 0; corner < index.size(); ++corner)
    for (int j = 0; j < variables; ++j)
      if (!(corner >> (variables - 1 - j) & 1)) k[j] += index[corner];
  return k;
}

BForm b_form_of(const TensorBezier& bezier) {
  const int degree = *std::max_element(bezier.degrees().begin(), bezier.degrees().end());
  const TensorBezier equal = bezier.raised(std::vector<int>(bezier.variables(), degree));
  const MultiIndices indices(1 << bezier.variables(), degree);
  Eigen::MatrixXd coefficients(bezier.dimension(), indices.count());
  for (int i = 0; i < indices.count(); ++i)
    coefficients.col(i) = equal.coefficients().col(equal.position(tensor_index(indices[i])));
  return {indices.corners(), degree, std::move(coefficients)};
}

TensorBezier tensor_of(const BForm& form) {
  if (form.corners() < 2 || !std::has_single_bit(static_cast<unsigned>(form.corners())))
    throw std::invalid_argument(fmt::format("{} corners; a tensor product has 2, 4, 8, …", form.corners()));
  const std::vector<int> degrees(std::bit_width(static_cast<unsigned>(form.corners())) - 1, form.degree());
  const auto count = static_cast<Eigen::Index>(count_of(degrees));
  TensorBezier bezier(degrees, Eigen::MatrixXd::Zero(form.dimension(), count));
  Eigen::MatrixXd sums = bezier.coefficients();
  for (int i = 0; i < form.indices().count(); ++i)
    sums.col(bezier.position(tensor_index(form.indices()[i]))) +=
        form.indices().multinomial(i) * form.coefficients().col(i);
  for (int k = 0; k < bezier.count(); ++k) sums.col(k) /= bezier.multinomial(k);
  return {degrees, std::move(sums)};
}

}  // namespace snug::mesh::curves
