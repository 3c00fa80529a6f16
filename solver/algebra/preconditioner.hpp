// What stands in for the inverse of a matrix: a factor of it, or of an earlier one. FGMRES (linear_solver.hpp) makes up for the rest.
#pragma once

#include <petscpc.h>

#include <memory>
#include <string>

#include "solver/algebra/own_rows.hpp"

namespace snug::solver {

/// What of a matrix is inverted: all of one that is symmetric, (A + A^T) / 2 of one that is not, or all of that.
enum class Operand { symmetric, symmetric_part, whole };

class Preconditioner {
 public:
  virtual ~Preconditioner() = default;
  /// Made anew of the matrix as it is now; one of another pattern or operand than last time is `fresh`. False: there is none, and
  /// nothing of an earlier one is left.
  virtual bool renew(const OwnRows& rows, Operand operand, bool fresh) = 0;
  virtual PetscErrorCode apply(Vec in, Vec out) = 0;
  /// Of the matrix that it was made of: negative eigenvalues by Sylvester's law of inertia; -1 where it cannot tell.
  virtual int negative_pivots() const { return -1; }
  /// How it was made, in a few words; empty before.
  virtual std::string description() const { return {}; }
  /// Gives its memory back.
  virtual void clear() = 0;
};

/// How exact a factor is. In single precision it takes half the memory and little more than half the time; FGMRES in double
/// precision then needs a few iterations more. `low_rank`: what is far apart is compressed (block low-rank, 1e-4), which pays where
/// fronts are large.
enum class FactorKind { double_precision, single_precision, low_rank };

/// MUMPS, multifrontal: LDL^T for a symmetric matrix, LU for others, in the order of `nested_dissection`.
/// Sources: Amestoy, Duff, L'Excellent & Koster, SIAM J. Matrix Anal. Appl. 23 (2001) 15-41; Amestoy, Buttari, L'Excellent & Mary,
/// ACM Trans. Math. Software 45 (2019) 2 (low rank).
///
/// `memory`: bytes that this program may take on all ranks together. A factor that would take it over that is written to the folder for temporary files as
/// it is made, and read again at every application: the fronts alone are in memory then, and no block is compressed. 0: there is no bound.
std::unique_ptr<Preconditioner> mumps_factor(FactorKind kind, double memory = 0.0);

}  // namespace snug::solver
