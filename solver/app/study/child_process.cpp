#include "solver/app/study/child_process.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <stdexcept>

namespace snug::app {

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// It ends with this process, whatever ends that.
[[noreturn]] void become(char* const* words, const char* directory, int output, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  dup2(output, STDOUT_FILENO);
  dup2(output, STDERR_FILENO);
  if (chdir(directory) == 0) execvp(words[0], words);
  _exit(127);
}

std::string read_all(int from) {
  std::string text;
  std::array<char, 4096> block;
  for (ssize_t n; (n = read(from, block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(n));
  return text;
}

}  // namespace

ChildOutcome run_child(const std::vector<std::string>& words, const std::filesystem::path& directory) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to a child process can be made");
  const auto start = std::chrono::steady_clock::now();
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error("no child process can be started");
  if (child == 0) become(arguments.data(), directory.c_str(), ends[1], parent);
  close(ends[1]);
  ChildOutcome outcome;
  outcome.output = read_all(ends[0]);
  close(ends[0]);
  int state = 0;
  rusage usage{};
  wait4(child, &state, 0, &usage);
  outcome.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.status = WIFEXITED(state) ? WEXITSTATUS(state) : 128 + WTERMSIG(state);
  outcome.user = seconds(usage.ru_utime), outcome.system = seconds(usage.ru_stime);
  outcome.memory = 1024.0 * static_cast<double>(usage.ru_maxrss);
  return outcome;
}

}  // namespace snug::app
