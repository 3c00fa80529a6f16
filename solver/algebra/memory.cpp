#include "solver/algebra/memory.hpp"

#include <unistd.h>

#include <fstream>

namespace snug::solver {

double resident_memory() {
  double pages = 0.0, resident = 0.0;
  std::ifstream("/proc/self/statm") >> pages >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

}  // namespace snug::solver
