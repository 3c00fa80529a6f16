#include "solver/app/launch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

#include "cases/input/files.hpp"
#include "solver/app/command.hpp"
#include "solver/app/scratch.hpp"
#include "solver/app/stop_signals.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

const std::string status_option = "--rank-status=", terminal_option = "--rank-terminal=";

std::vector<std::string> words_of_process() {
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

// More ranks than cores are the user's choice; a container's only user is often root, which Open MPI has to be told. Its
// folders and the segments of shared memory, which a killed rank leaves behind, go where they can be removed.
std::vector<std::string> mpirun_line(int ranks, const fs::path& scratch, const fs::path& shared, const fs::path& status, const Console& console) {
  std::vector<std::string> line = {"mpirun", "-q", "-n", std::to_string(ranks), "--oversubscribe", "--bind-to", "none",
                                   "--mca", "orte_tmpdir_base", scratch.string(), "--mca", "btl_vader_backing_directory", shared.string()};
  if (::geteuid() == 0) line.push_back("--allow-run-as-root");
  line.push_back(fs::read_symlink("/proc/self/exe").string());
  const auto own = own_arguments();
  line.insert(line.end(), own.begin() + 1, own.end());
  line.push_back(status_option + status.string());
  // mpirun gives every rank a terminal of its own, wherever this process writes to.
  line.push_back(fmt::format("{}{},{}", terminal_option, console.width(), console.error_width()));
  return line;
}

constexpr int no_mpirun = 127;

/// In a process group of its own, so that the terminal's Ctrl-C reaches the launcher alone, which passes it on.
[[noreturn]] void become_mpirun(char* const* arguments, pid_t launcher) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != launcher) ::_exit(no_mpirun);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDONLY);
  ::dup2(nothing, STDIN_FILENO);
  ::execvp(arguments[0], arguments);
  ::_exit(no_mpirun);
}

/// Waits for mpirun and passes the first signal on as one that mpirun hands to its ranks. A second one ends this process, and
/// mpirun and the ranks with it.
int wait_and_pass_on(pid_t child) {
  int state = 0;
  for (bool passed = false; ::waitpid(child, &state, WNOHANG) == 0; ::usleep(20'000)) {
    if (passed || StopSignals::received() == 0) continue;
    passed = true;
    ::kill(child, StopSignals::received() == SIGINT ? SIGUSR1 : SIGUSR2);
  }
  return state;
}

int written_status(const fs::path& file) {
  int status = -1;
  std::ifstream(file) >> status;
  return status;
}

}  // namespace

std::vector<std::string> own_arguments() {
  std::vector<std::string> words = words_of_process();
  std::erase_if(words, [](const std::string& word) { return word.starts_with(status_option) || word.starts_with(terminal_option); });
  return words;
}

bool mpirun_is_there() {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (::access((fs::path(folder) / "mpirun").c_str(), X_OK) == 0) return true;
  return false;
}

int launch_ranks(int ranks, const Cleaner& cleaner, Console& console) {
  const StopSignals signals(false);
  const Scratch scratch(temporary_place(), cleaner);
  const bool has_shared = ::access("/dev/shm", W_OK) == 0;
  const auto shared = has_shared ? std::make_unique<Scratch>("/dev/shm", cleaner) : nullptr;
  const fs::path status = scratch.path() / "status";
  const auto line = mpirun_line(ranks, scratch.path(), shared ? shared->path() : scratch.path(), status, console);
  std::vector<char*> arguments;
  for (const std::string& word : line) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  ::setenv("TMPDIR", scratch.path().c_str(), 1);  // of the ranks
  const pid_t launcher = ::getpid(), child = ::fork();
  if (child == 0) become_mpirun(arguments.data(), launcher);
  if (child < 0) throw std::runtime_error("no child process can be started");
  const int state = wait_and_pass_on(child);
  const int written = written_status(status);
  if (written >= 0) return console.leave_to_another(), written;  // rank 0 has answered
  if (WIFEXITED(state) && WEXITSTATUS(state) == no_mpirun)
    throw input::InputError({"--ranks", 0, 0}, "mpirun is not there",
                            "install openmpi-bin (scripts/setup does), or leave --ranks out");
  if (const int signal = StopSignals::received(); signal != 0) {
    console.error(fmt::format("snug: error: stopped by you ({}) before the ranks had begun; nothing is written", StopSignals::name(signal)));
    return 128 + signal;
  }
  console.error(fmt::format("snug: error: the ranks ended before they were done (mpirun {} {}); see what is said above, or leave --ranks out",
                            WIFEXITED(state) ? "gave status" : "was ended by signal", WIFEXITED(state) ? WEXITSTATUS(state) : WTERMSIG(state)));
  return internal_fault;
}

void end_with_parent() {
  const pid_t parent = ::getppid();
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(internal_fault);
}

void report_status(const std::string& file, int status) {
  if (!file.empty()) input::write_file(file, std::to_string(status) + "\n");
}

}  // namespace snug::app
