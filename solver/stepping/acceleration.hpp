// Steps of an iteration that converges linearly, mixed so that it converges faster.
#pragma once

#include <Eigen/Core>

#include <deque>

namespace snug::solver {

/// Anderson's acceleration (J. ACM 12 (1965) 547-560; type II of Fang & Saad, Numer. Linear Algebra Appl. 16 (2009) 197-221, with the whole step):
/// of an iteration x <- x + s(x) whose steps hardly shrink, the step
///   s_k - (dX + dS) c,  c = argmin | s_k - dS c |,   dX, dS: differences of the last x and s,
/// is that of a secant method with the last few pairs; of a linear iteration it is that of GMRES (Walker & Ni, SIAM J. Numer. Anal. 49
/// (2011) 1715-1735), which also ends where the iteration itself would swing or grow in a few directions.
class Acceleration {
 public:
  /// The norm is that of the first `measured` entries of a step: positions, m.
  explicit Acceleration(Eigen::Index measured) : measured_(measured) {}

  /// The iteration would take `step` from `values`.
  void see(const Eigen::VectorXd& values, const Eigen::VectorXd& step);
  /// What to take instead of `step`, the last one seen. Without an earlier one: the step itself.
  Eigen::VectorXd mixed(const Eigen::VectorXd& step) const;
  /// What was seen belongs to another iteration.
  void forget() { seen_.clear(); }

 private:
  struct Pair {
    Eigen::VectorXd values, step;
  };
  Eigen::Index measured_;
  std::deque<Pair> seen_;  ///< the oldest first
};

}  // namespace snug::solver
