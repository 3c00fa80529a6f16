#include "solver/app/solver_session.hpp"

#include <cstdlib>

namespace snug::app {

std::unique_ptr<Scratch> prepare_for_mpi(const Cleaner& cleaner) {
  auto scratch = std::make_unique<Scratch>(temporary_place(), cleaner);
  for (const char* name : {"TMPDIR", "OMPI_MCA_orte_tmpdir_base"}) ::setenv(name, scratch->path().c_str(), 1);
  return scratch;
}

}  // namespace snug::app
