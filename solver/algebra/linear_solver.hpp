// The linear system on a PETSc communicator: MUMPS with a lagged factor and FGMRES.
#pragma once

#include <Eigen/Core>

#include <memory>

#include "solver/algebra/sparse_scatter.hpp"

namespace snug::solver {

/// What a solve did.
struct LinearReport {
  bool ok = false;
  bool refactored = false;
  int iterations = 0;         ///< of FGMRES
  int negative_pivots = -1;   ///< of the last factor, -1 when unknown
};

/// Symmetric (possibly indefinite) systems. Rows are distributed over the communicator as the scatter says.
class LinearSolver {
 public:
  LinearSolver();
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// First and end row that this rank owns of `unknowns`.
  static std::pair<int, int> owned_rows(int unknowns);
  /// Takes over a new sparsity pattern; the next solve analyses and factors anew.
  void reset(const SparseScatter& scatter, int unknowns);
  /// Solves matrix * x = right (both over all unknowns; the result is known on every rank). With `may_lag`, the last
  /// factor preconditions FGMRES; when that needs more than 12 iterations the matrix is factored anew.
  LinearReport solve(const SparseScatter& scatter, const Eigen::VectorXd& right, Eigen::VectorXd& x, bool may_lag);

 private:
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace snug::solver
