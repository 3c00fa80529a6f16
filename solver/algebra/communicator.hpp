// The few things that ranks say to one another beside the linear solver. Every rank holds the whole state; what is
// decided from these numbers is decided alike on all.
#pragma once

#include <Eigen/Core>

#include <string>
#include <utility>

namespace snug::solver {

/// PETSc's failures come back as values and print nothing: a failed factorisation is an event for the recovery.
void return_petsc_errors();

int rank();
int ranks();

/// Sum over the ranks, the same to the last bit on every rank.
double sum_over_ranks(double value);
double largest_over_ranks(double value);
/// True where it is true on every rank.
bool on_all_ranks(bool value);
/// Every rank fills its own range [first, end) of `values`; afterwards all have all.
void gather_ranges(Eigen::VectorXd& values, int first, int end);

/// Ends all ranks at once with an exit status.
[[noreturn]] void abort_all_ranks(int status);

}  // namespace snug::solver
