// One driver for every term: derivatives by rate, on small scenes at a deformed state.
#pragma once

#include <random>

#include "solver/scene/scene.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {

/// Residual, dense tangent and condensed right side of one term on all entries of the state.
struct Assembled {
  Eigen::VectorXd residual;
  Eigen::MatrixXd tangent;
  Eigen::VectorXd condensed;
};

class DenseSink : public solver::Sink {
 public:
  DenseSink(const solver::ElementEntries& entries, Assembled& out) : entries_(entries), out_(out) {}
  void add(int element, std::span<const double> residual, std::span<const double> matrix) override {
    const auto entries = entries_.of(element);
    const std::size_t n = entries.size();
    for (std::size_t i = 0; i < n; ++i) out_.residual[entries[i]] += residual[i];
    for (std::size_t k = 0; k < matrix.size(); ++k) out_.tangent(entries[k / n], entries[k % n]) += matrix[k];
  }

  void add_condensed(int element, std::span<const double> values) override {
    const auto entries = entries_.of(element);
    for (std::size_t i = 0; i < values.size(); ++i) out_.condensed[entries[i]] += values[i];
  }

 private:
  const solver::ElementEntries& entries_;
  Assembled& out_;
};

inline Assembled assemble(const solver::Term& term, const solver::State& state, solver::Tangent tangent) {
  const Eigen::Index n = state.values.size(), m = solver::wanted(tangent) ? n : 0;
  Assembled out{Eigen::VectorXd::Zero(n), Eigen::MatrixXd::Zero(m, m), Eigen::VectorXd::Zero(n)};
  DenseSink sink(term.entries(state), out);
  term.assemble(state, tangent, sink);
  return out;
}

/// Puts what the term eliminated where the positions want it: dilatations are linear in their step, pressures then, too.
inline void settle(const solver::Term& term, solver::State& state) {
  for (int k = 0; k < 2; ++k) {
    Eigen::VectorXd step = Eigen::VectorXd::Zero(state.values.size());
    term.recover(state, step);
    state.values += step;
  }
}

/// Error of central differences of the residual along `direction` against the tangent, for steps h, h/2, h/4
/// (relative).
inline std::array<double, 3> tangent_errors(const solver::Term& term, solver::State state,
                                            const Eigen::VectorXd& direction, double h) {
  term.update(state);
  const Eigen::VectorXd exact = assemble(term, state, solver::Tangent::full).tangent * direction;
  const auto residual_at = [&](double s) {
    solver::State moved = state;
    moved.values += s * direction;
    term.update(moved);
    return assemble(term, moved, solver::Tangent::none).residual;
  };
  std::array<double, 3> errors{};
  for (int k = 0; k < 3; ++k, h *= 0.5)
    errors[k] = ((residual_at(h) - residual_at(-h)) / (2.0 * h) - exact).norm() / exact.norm();
  return errors;
}

/// Second order: the tangent is the derivative of the residual.
inline void expect_factor_four(const solver::Term& term, const solver::State& state, const Eigen::VectorXd& direction) {
  const auto errors = tangent_errors(term, state, direction, 4e-6);
  EXPECT_NEAR(errors[0] / errors[1], 4.0, 0.3) << term.name() << ": " << errors[0] << ", " << errors[1];
  EXPECT_NEAR(errors[1] / errors[2], 4.0, 0.3) << term.name() << ": " << errors[1] << ", " << errors[2];
}

inline double asymmetry(const Eigen::MatrixXd& matrix) { return (matrix - matrix.transpose()).norm() / matrix.norm(); }

inline Eigen::VectorXd random_vector(Eigen::Index size, double amplitude, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> uniform(-amplitude, amplitude);
  return Eigen::VectorXd::NullaryExpr(size, [&] { return uniform(generator); });
}

}  // namespace snug::tests
