#include <deal.II/base/mpi.h>
#include <dlfcn.h>
#include <petscsys.h>

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "solver/algebra/communicator.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

namespace {

// Started without mpirun, Open MPI would start a daemon of its own, which takes a second and looks for a remote shell.
char**& alone_unless_launched(char**& argv) {
  if (!getenv("OMPI_COMM_WORLD_SIZE")) setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
  return argv;
}

void share_cores_of_blas(int ranks) {
  if (ranks == 1 || getenv("OPENBLAS_NUM_THREADS")) return;
  using SetThreads = void (*)(int);
  if (const auto set = reinterpret_cast<SetThreads>(dlsym(RTLD_DEFAULT, "openblas_set_num_threads")))
    set(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks));
}

}  // namespace

struct Session::Runtime {
  Runtime(int& argc, char**& argv) : mpi(argc, alone_unless_launched(argv), dealii::numbers::invalid_unsigned_int) {
    PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr);  // a failed factorisation is an event for the recovery
    share_cores_of_blas(ranks());
  }
  dealii::Utilities::MPI::MPI_InitFinalize mpi;
};

Session::Session(int& argc, char**& argv) : runtime_(std::make_unique<Runtime>(argc, argv)) {}
Session::~Session() = default;

Rank this_rank() { return {rank(), ranks()}; }
void end_all_ranks(int status) { abort_all_ranks(status); }

std::string loaded_blas() {
  if (dlsym(RTLD_DEFAULT, "openblas_get_config")) return "openblas";
  if (dlsym(RTLD_DEFAULT, "MKL_Get_Version") || dlsym(RTLD_DEFAULT, "bli_init")) return "tuned";
  return dlsym(RTLD_DEFAULT, "dgemm_") ? "reference" : "unknown";
}

}  // namespace snug::solver
