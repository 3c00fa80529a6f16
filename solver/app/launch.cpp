#include "solver/app/launch.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "solver/app/command.hpp"

namespace snug::app {

std::vector<std::string> own_arguments() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  const std::string all((std::istreambuf_iterator<char>(file)), {});
  std::vector<std::string> arguments;
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t end = all.find('\0', begin);
    arguments.push_back(all.substr(begin, end - begin));
    begin = end == std::string::npos ? all.size() : end + 1;
  }
  return arguments;
}

namespace {

// More ranks than cores are the user's choice; a container's only user is often root, which Open MPI has to be told.
std::vector<std::string> mpirun_line(int ranks) {
  std::vector<std::string> line = {"mpirun", "-q", "-n", std::to_string(ranks), "--oversubscribe", "--bind-to", "none"};
  if (::geteuid() == 0) line.push_back("--allow-run-as-root");
  line.push_back(std::filesystem::read_symlink("/proc/self/exe").string());
  const auto own = own_arguments();
  line.insert(line.end(), own.begin() + 1, own.end());
  return line;
}

}  // namespace

int launched_ranks() {
  const char* size = std::getenv("OMPI_COMM_WORLD_SIZE");
  return size ? std::max(1, std::atoi(size)) : 1;
}

int launch_ranks(int ranks) {
  const auto line = mpirun_line(ranks);
  std::vector<char*> arguments;
  for (const std::string& word : line) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  constexpr int no_mpirun = 127;
  const pid_t child = ::fork();
  if (child == 0) {
    ::execvp(arguments[0], arguments.data());
    ::_exit(no_mpirun);
  }
  int state = 0;
  if (child < 0 || ::waitpid(child, &state, 0) < 0) return internal_fault;
  if (WIFEXITED(state) && WEXITSTATUS(state) == no_mpirun)
    throw input::InputError({"--ranks", 0, 0}, "mpirun is not there",
                            "install openmpi-bin (scripts/setup does), or leave --ranks out");
  return WIFEXITED(state) ? WEXITSTATUS(state) : internal_fault;
}

}  // namespace snug::app
