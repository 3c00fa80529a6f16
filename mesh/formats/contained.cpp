#include "mesh/formats/contained.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "mesh/formats/no_effects.hpp"

namespace snug::mesh {

namespace {

const std::string whole = "whole";  // what the output ends with when the work was done

void limit(int resource, double value) {
  const rlimit both{static_cast<rlim_t>(value), static_cast<rlim_t>(value)};
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

/// Bytes of private memory that this process may write to (pages of text and of libraries do not count).
double data_size() {
  std::ifstream file("/proc/self/statm");
  double total = 0.0, resident = 0.0, shared = 0.0, text = 0.0, unused = 0.0, data = 0.0;
  file >> total >> resident >> shared >> text >> unused >> data;
  return data * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// A directory that is no more: nothing is found in it and nothing can be made in it.
void stand_nowhere() {
  std::string name = (std::filesystem::temp_directory_path() / "snug-XXXXXX").string();
  if (::mkdtemp(name.data()) == nullptr) return;
  if (::chdir(name.c_str()) != 0) return;
  ::rmdir(name.c_str());
}

void write_all(int to, const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t n = ::write(to, text.data() + at, text.size() - at);
    if (n <= 0) ::_exit(1);
    at += static_cast<std::size_t>(n);
  }
}

[[noreturn]] void be_contained(const std::function<std::string()>& work, const Limits& limits, int to, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it was gone before
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGSEGV, SIGABRT, SIGFPE, SIGBUS}) std::signal(signal, SIG_DFL);
  const int nothing = ::open("/dev/null", O_RDWR);
  for (int n = 0; n < 3; ++n) ::dup2(nothing, n);
  limit(RLIMIT_CORE, 0.0);
  limit(RLIMIT_CPU, std::ceil(limits.seconds) + 1.0);
  limit(RLIMIT_DATA, data_size() + limits.memory);
  if (limits.sandbox) {
    stand_nowhere();
    std::signal(SIGXFSZ, SIG_IGN);
    limit(RLIMIT_FSIZE, 0.0);
    refuse_effects();
  }
  try {
    write_all(to, work() + whole);
  } catch (...) {
    ::_exit(1);
  }
  ::_exit(0);
}

/// Reads to the end or to the deadline; false: the deadline came first.
bool read_until(int from, std::chrono::steady_clock::time_point deadline, std::string& text) {
  std::array<char, 1 << 16> block;
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now()).count();
    if (left <= 0) return false;
    pollfd ready{from, POLLIN, 0};
    if (::poll(&ready, 1, static_cast<int>(std::min<long long>(left, 60'000))) <= 0) continue;
    const ssize_t n = ::read(from, block.data(), block.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return true;
    text.append(block.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

Contained contained(const std::function<std::string()>& work, const Limits& limits) {
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("no pipe to a child process can be made");
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) throw std::runtime_error("no child process can be started");
  if (child == 0) be_contained(work, limits, ends[1], parent);
  ::close(ends[1]);
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::milliseconds(static_cast<long long>(1e3 * limits.seconds));
  Contained result;
  const bool in_time = read_until(ends[0], deadline, result.output);
  ::close(ends[0]);
  if (!in_time) ::kill(child, SIGKILL);
  int state = 0;
  while (::waitpid(child, &state, 0) < 0 && errno == EINTR) continue;
  result.signal = WIFSIGNALED(state) ? WTERMSIG(state) : 0;
  if (!in_time || result.signal == SIGXCPU)
    result.end = Contained::End::out_of_time;
  else if (!result.output.ends_with(whole))
    result.end = Contained::End::died;
  result.output.resize(result.end == Contained::End::done ? result.output.size() - whole.size() : 0);
  return result;
}

}  // namespace snug::mesh
