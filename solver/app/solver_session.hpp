// The libraries of the solver, for a command that solves.
#pragma once

#include <memory>

#include "solver/app/cleaner.hpp"
#include "solver/app/scratch.hpp"
#include "solver/scene/run.hpp"

namespace snug::app {

/// PETSc reads the command line for its own options; it gets none of ours.
class SolverSession {
 public:
  SolverSession() : session_(count_, arguments_) {}

 private:
  char name_[5] = "snug";
  char* storage_[2] = {name_, nullptr};
  char** arguments_ = storage_;
  int count_ = 1;
  solver::Session session_;
};

/// Without mpirun MPI makes its folder where it is removed whatever ends the run.
std::unique_ptr<Scratch> prepare_for_mpi(const Cleaner& cleaner);

}  // namespace snug::app
