#include "solver/app/cleaner.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <string>
#include <string_view>

#include "solver/app/output_directory.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// Everything that the connection has brought when its other end is closed: records "d/path\0"; "e\0" from a process that
/// ends it itself.
std::string listen(int from) {
  std::string heard;
  std::array<char, 4096> block;
  for (ssize_t n; (n = ::read(from, block.data(), block.size())) > 0;) heard.append(block.data(), static_cast<std::size_t>(n));
  return heard;
}

/// The record "e" alone: a path may end with that letter, too.
bool says_farewell(std::string_view records) {
  const std::string_view last("\0e\0", 3);
  return records.ends_with(last) || records == last.substr(1);
}

/// Until a process is gone with all that it held: its end of the connection may be closed before its locks.
void await_end(int process) {
  pollfd gone{process, POLLIN, 0};
  while (::poll(&gone, 1, -1) < 0 && errno == EINTR) continue;
}

void clean(const std::string& records) {
  for (std::size_t begin = 0, end; (end = records.find('\0', begin)) != std::string::npos; begin = end + 1) {
    const fs::path path = records.substr(begin + 1, end - begin - 1);
    std::error_code ignored;
    if (records[begin] == 'd') fs::remove_all(path, ignored);
    if (records[begin] == 'r') repair_results(path);
  }
}

/// In a session of its own, so that no signal to the group of the run reaches it, and without its files, so that nobody waits
/// for their end.
[[noreturn]] void watch(int from, int process) {
  ::setsid();
  ::prctl(PR_SET_NAME, "cleaner");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_IGN);
  const auto [low, high] = std::minmax({static_cast<unsigned>(from), static_cast<unsigned>(process)});
  ::close_range(0, low - 1, 0);
  if (high - low > 1) ::close_range(low + 1, high - 1, 0);
  ::close_range(high + 1, ~0U, 0);
  for (int n = 0; n < 3; ++n) ::open("/dev/null", O_RDWR);
  try {
    const std::string records = listen(from);
    if (!says_farewell(records)) await_end(process);
    clean(records);
  } catch (...) {  // there is nobody left to tell; the next run says what it finds
  }
  ::_exit(0);
}

}  // namespace

Cleaner::Cleaner() {
  int ends[2];
  const int self = static_cast<int>(::syscall(SYS_pidfd_open, ::getpid(), 0));  // glibc 2.36 declares none for C++
  if (self < 0) return;
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) == 0) {
    const bool free = std::min(ends[0], self) > 2;  // standard input or output is closed: its number is needed for something else
    if (free) child_ = ::fork();
    if (child_ == 0) watch(ends[0], self);
    ::close(ends[0]);
    if (child_ > 0)
      to_ = ends[1];
    else
      ::close(ends[1]);
  }
  ::close(self);
}

Cleaner::~Cleaner() {
  if (to_ < 0) return;
  const bool told = ::send(to_, "e", 2, MSG_NOSIGNAL) == 2;
  ::close(to_);
  if (told) ::waitpid(child_, nullptr, 0);  // otherwise it waits for the end of this process
}

void Cleaner::tell(char what, const fs::path& path) const {
  std::error_code ignored;
  const std::string record = what + fs::absolute(path, ignored).string() + '\0';
  if (to_ >= 0) ::send(to_, record.data(), record.size(), MSG_NOSIGNAL);
}

}  // namespace snug::app
