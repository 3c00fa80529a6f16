#include "solver/stepping/acceleration.hpp"

#include <Eigen/Dense>

namespace snug::solver {

namespace {

constexpr std::size_t most_pairs = 6;
// Differences that are combinations of others but for this share tell nothing but round-off.
constexpr double independent = 1e-6;

}  // namespace

void Acceleration::see(const Eigen::VectorXd& values, const Eigen::VectorXd& step) {
  seen_.push_back({values, step});
  if (seen_.size() > most_pairs) seen_.pop_front();
}

Eigen::VectorXd Acceleration::mixed(const Eigen::VectorXd& step) const {
  const auto columns = static_cast<Eigen::Index>(seen_.size()) - 1;
  if (columns < 1) return step;
  Eigen::MatrixXd of_values(step.size(), columns), of_steps(step.size(), columns);
  for (Eigen::Index c = 0; c < columns; ++c) {
    of_values.col(c) = seen_[c + 1].values - seen_[c].values;
    of_steps.col(c) = seen_[c + 1].step - seen_[c].step;
  }
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> least_squares;
  least_squares.setThreshold(independent);
  least_squares.compute(of_steps.topRows(measured_));
  const Eigen::VectorXd share = least_squares.solve(step.head(measured_));
  return step - (of_values + of_steps) * share;
}

}  // namespace snug::solver
