// The linear system on a PETSc communicator: MUMPS with a lagged factor and FGMRES.
#pragma once

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <string>

#include "solver/algebra/sparse_scatter.hpp"

namespace snug::solver {

/// From so many unknowns on a factor in single precision costs less (docs/growth.md); FGMRES makes up for it.
constexpr int single_precision_from = 30000;

/// How a solve may save the factorisation.
struct Lag {
  bool allowed = false;
  double tolerance = 1e-10;  ///< |residual| / |right| in the scaled norm at which a solve with the last factor is done
  bool precise = false;      ///< a factor in double precision, now and from here on: where the count of its negative pivots decides
};

/// What a matrix has beside what is factored of it: adds its product with `x` to `sum`, both over all unknowns.
using OneWay = std::function<void(const Eigen::VectorXd& x, Eigen::VectorXd& sum)>;

/// What a solve did.
struct LinearReport {
  bool ok = false;
  bool refactored = false;
  int iterations = 0;         ///< of FGMRES, those of a lagged factor that gave way included
  bool single_precision = false;  ///< the last factor is
  int negative_pivots = -1;   ///< of the last factor, -1 when unknown and of a matrix that is not symmetric
  double factor_seconds = 0.0, solve_seconds = 0.0;
  std::string factor;         ///< how it was made
};

/// Symmetric (possibly indefinite) systems, and others near to symmetric ones: their symmetric part is factored and FGMRES
/// works on the whole; where that does not get there the whole is factored (LU). Rows are distributed over the communicator as the scatter says.
/// Forces and gaps stand in one system, so its rows are brought to one unit before any norm is taken: D A D with
/// D_ii = A_ii^-1/2 where a row has stiffness of its own, and 1 / max_j |A_ij| D_jj where it has none (a constraint), of
/// the last factored matrix.
class LinearSolver {
 public:
  LinearSolver();
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Bytes that the program may take on all ranks together (mumps_factor); 0: there is no bound. From the next factor of another kind or pattern on.
  void may_take(double memory);

  /// Takes over a new sparsity pattern of a scatter that outlives its use here. The last factor is kept as a
  /// preconditioner where the unknowns are as many as before; the next factorisation analyses anew.
  void reset(SparseScatter& scatter, int unknowns, bool symmetric = true);
  /// Solves matrix * x = right (both over all unknowns; the result is known on every rank). Where a lag is allowed,
  /// the last factor preconditions FGMRES; when that takes too long the matrix is factored anew. The values of the
  /// scatter are scaled in place: assemble again before the next solve.
  /// `one_way` (may be empty) is a part of the matrix that only FGMRES sees; where that does not get there, what it found without it is returned.
  LinearReport solve(SparseScatter& scatter, const Eigen::VectorXd& right, Eigen::VectorXd& x, const Lag& lag = {}, const OneWay& one_way = {});

  /// Another right side with the matrix of the last solve and its factor.
  bool solve_again(const Eigen::VectorXd& right, Eigen::VectorXd& x);

 private:
  struct Petsc;
  std::unique_ptr<Petsc> petsc_;
};

}  // namespace snug::solver
