#include "solver/app/cleaner.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string>

#include "solver/app/output_directory.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// Everything that the connection has brought when its other end is closed: records "d/path\0".
std::string listen(int from) {
  std::string heard;
  std::array<char, 4096> block;
  for (ssize_t n; (n = ::read(from, block.data(), block.size())) > 0;) heard.append(block.data(), static_cast<std::size_t>(n));
  return heard;
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
[[noreturn]] void watch(int from) {
  ::setsid();
  ::prctl(PR_SET_NAME, "cleaner");
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) std::signal(signal, SIG_IGN);
  ::close_range(0, static_cast<unsigned>(from) - 1, 0);
  ::close_range(static_cast<unsigned>(from) + 1, ~0U, 0);
  for (int n = 0; n < 3; ++n) ::open("/dev/null", O_RDWR);
  try {
    clean(listen(from));
  } catch (...) {  // there is nobody left to tell; the next run says what it finds
  }
  ::_exit(0);
}

}  // namespace

Cleaner::Cleaner() {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return;
  if (ends[0] < 3) {  // standard input or output is closed: its number is needed for something else
    ::close(ends[0]), ::close(ends[1]);
    return;
  }
  child_ = ::fork();
  if (child_ == 0) watch(ends[0]);
  ::close(ends[0]);
  to_ = ends[1];
}

Cleaner::~Cleaner() {
  if (to_ >= 0) ::close(to_);
  if (child_ > 0) ::waitpid(child_, nullptr, 0);
}

void Cleaner::tell(char what, const fs::path& path) const {
  std::error_code ignored;
  const std::string record = what + fs::absolute(path, ignored).string() + '\0';
  if (to_ >= 0) ::send(to_, record.data(), record.size(), MSG_NOSIGNAL);
}

}  // namespace snug::app
