// What stands in for the inverse of a matrix: a factor of it, or of an earlier one. FGMRES (linear_solver.hpp) makes up for the rest.
#pragma once

#include <petscpc.h>

#include <memory>

namespace snug::solver {

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// Made anew of the matrix as it is now; one of another pattern than last time, or of a matrix that is now taken as not symmetric,
  /// is `fresh`. False: there is none, and nothing of an earlier one is left.
  virtual bool renew(Mat matrix, bool symmetric, bool fresh) = 0;
  virtual PetscErrorCode apply(Vec in, Vec out) = 0;
  /// Of the matrix that it was made of: negative eigenvalues by Sylvester's law of inertia; -1 where it cannot tell.
  virtual int negative_pivots() const { return -1; }
  /// Gives its memory back.
  virtual void clear() = 0;
};

/// MUMPS, multifrontal, in double precision: Cholesky-like (LDL^T) for a symmetric matrix, LU for others.
std::unique_ptr<Preconditioner> mumps_factor();

}  // namespace snug::solver
