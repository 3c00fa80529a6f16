#include "solver/algebra/communicator.hpp"

#include <petscsys.h>

#include <cstdlib>
#include <vector>

namespace snug::solver {

namespace {

bool started() {
  int yes = 0;
  MPI_Initialized(&yes);
  return yes != 0;
}

}  // namespace

void return_petsc_errors() { PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr); }

int rank() {
  int rank = 0;
  if (started()) MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}

int ranks() {
  int ranks = 1;
  if (started()) MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

double sum_over_ranks(double value) {
  if (ranks() == 1) return value;
  double sum = 0.0;  // an all-reduce may add in another order on each rank
  MPI_Reduce(&value, &sum, 1, MPI_DOUBLE, MPI_SUM, 0, MPI_COMM_WORLD);
  MPI_Bcast(&sum, 1, MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return sum;
}

double largest_over_ranks(double value) {
  double largest = value;
  if (ranks() > 1) MPI_Allreduce(&value, &largest, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD);
  return largest;
}

bool on_all_ranks(bool value) {
  if (ranks() == 1) return value;
  int mine = value ? 1 : 0, all = 0;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
  return all != 0;
}

void gather_ranges(Eigen::VectorXd& values, int first, int end) {
  const int n = ranks();
  if (n == 1) return;
  std::vector<int> count(n), offset(n);
  const int mine = end - first;
  MPI_Allgather(&mine, 1, MPI_INT, count.data(), 1, MPI_INT, MPI_COMM_WORLD);
  MPI_Allgather(&first, 1, MPI_INT, offset.data(), 1, MPI_INT, MPI_COMM_WORLD);
  MPI_Allgatherv(MPI_IN_PLACE, 0, MPI_DATATYPE_NULL, values.data(), count.data(), offset.data(), MPI_DOUBLE,
                 MPI_COMM_WORLD);
}

void abort_all_ranks(int status) {
  if (started()) MPI_Abort(MPI_COMM_WORLD, status);
  std::exit(status);
}

}  // namespace snug::solver
