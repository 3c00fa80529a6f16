#include <dlfcn.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <thread>

#include "solver/algebra/blas_threads.hpp"
#include "solver/algebra/communicator.hpp"
#include "solver/fem/session.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

namespace {

int number_of(const char* variable) {
  const char* text = getenv(variable);
  return text ? std::max(1, std::atoi(text)) : 0;
}

// Started without mpirun, Open MPI would start a daemon of its own, which takes a second and looks for a remote shell, and
// look for network hardware, which takes a third of a second: a lone process talks to nobody.
// Left alone, all lone processes share one folder of temporary files, which the first to end takes from under the others:
// each gets its own.
class Alone {
 public:
  Alone() {
    if (const Launcher started = launcher(); number_of("OMPI_COMM_WORLD_SIZE") > 0 || (started.there && started.processes != 1)) return;
    const bool has_folder = getenv("OMPI_MCA_orte_tmpdir_base") != nullptr;  // one that is removed even when this process is killed
    setenv("OMPI_MCA_ess_singleton_isolated", "1", 0);
    setenv("OMPI_MCA_pml", "ob1", 0);
    setenv("OMPI_MCA_btl", "self", 0);
    if (has_folder) return;
    std::string name = (std::filesystem::temp_directory_path() / "snug-XXXXXX").string();
    if (!mkdtemp(name.data())) return;  // as before, then
    folder_ = name;
    setenv("OMPI_MCA_orte_tmpdir_base", folder_.c_str(), 0);
  }
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;
  ~Alone() {
    std::error_code ignored;
    if (!folder_.empty()) std::filesystem::remove_all(folder_, ignored);
  }

 private:
  std::filesystem::path folder_;
};

void share_cores_of_blas(int ranks) {
  if (ranks == 1 || getenv("OPENBLAS_NUM_THREADS")) return;
  set_blas_threads(std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / ranks));
}

}  // namespace

struct Session::Runtime {
  Runtime(int& argc, char**& argv) : mpi(argc, argv) {
    return_petsc_errors();
    share_cores_of_blas(ranks());
  }
  Alone alone;  // before MPI starts, after it ends
  fem::Session mpi;
};

Session::Session(int& argc, char**& argv) : runtime_(std::make_unique<Runtime>(argc, argv)) {}
Session::~Session() = default;

// Open MPI's own variable; PMI's (Hydra, Slurm's pmi2, Flux, Cray PALS); PMIx (Slurm's pmix, PRRTE) tells the number only when asked.
Launcher launcher() {
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
    if (const int processes = number_of(variable); processes > 0) return {true, processes};
  return {getenv("PMIX_NAMESPACE") != nullptr, 0};
}

Rank this_rank() { return {rank(), ranks()}; }
void end_all_ranks(int status) { abort_all_ranks(status); }

std::string loaded_blas() {
  if (dlsym(RTLD_DEFAULT, "openblas_get_config")) return "openblas";
  if (dlsym(RTLD_DEFAULT, "MKL_Get_Version") || dlsym(RTLD_DEFAULT, "bli_init")) return "tuned";
  return dlsym(RTLD_DEFAULT, "dgemm_") ? "reference" : "unknown";
}

}  // namespace snug::solver
