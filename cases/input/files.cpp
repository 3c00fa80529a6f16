#include "cases/input/files.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace snug::input {

namespace fs = std::filesystem;

namespace {

/// An open file, closed at the end of its life.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  bool ok() const { return number_ >= 0; }
  int number() const { return number_; }
  /// The first error that only closing tells (some network file systems).
  bool close() { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

std::string reason(int error) { return std::generic_category().message(error); }

[[noreturn]] void cannot_write(const fs::path& path, int error) {
  throw fs::filesystem_error("it cannot be written", path, std::error_code(error, std::generic_category()));
}

Descriptor open_regular(const fs::path& path, const std::string& file, const FileRules& rules) {
  // Without O_NONBLOCK the opening of a pipe waits for a writer.
  Descriptor descriptor(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY));
  if (!descriptor.ok() && (errno == ENOENT || errno == ENOTDIR))
    throw InputError({file, 0, 0}, "there is no such file", rules.missing);
  if (!descriptor.ok())
    throw InputError({file, 0, 0}, "the file cannot be read: " + reason(errno), "see who may read it (ls -l)");
  struct stat status {};
  if (::fstat(descriptor.number(), &status) != 0 || !S_ISREG(status.st_mode))
    throw InputError({file, 0, 0}, S_ISDIR(status.st_mode) ? "this is a directory, not a file" : "this is a pipe or a device, not a file",
                     "name a file");
  if (static_cast<std::uintmax_t>(status.st_size) > rules.most)
    throw InputError({file, 0, 0}, "the file has " + std::to_string(status.st_size) + " bytes, at most " + std::to_string(rules.most) + " are read",
                     "see whether it is the file that was meant");
  return Descriptor(::fcntl(descriptor.number(), F_DUPFD_CLOEXEC, 0));
}

/// Writes all of it and brings it to the disk; 0 or the error.
int fill(Descriptor& descriptor, std::string_view content) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor.number(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return errno;
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (::fsync(descriptor.number()) != 0 && errno != EINVAL && errno != ENOTSUP) return errno;
  return descriptor.close() ? 0 : errno;
}

}  // namespace

std::string read_file(const fs::path& path, const FileRules& rules) {
  const std::string file = rules.shown_as.empty() ? path.string() : rules.shown_as;
  const Descriptor descriptor = open_regular(path, file, rules);
  std::string content;
  for (std::string block(1 << 16, '\0');;) {
    const ssize_t length = ::read(descriptor.number(), block.data(), block.size());
    if (length < 0 && errno == EINTR) continue;
    if (length < 0) throw InputError({file, 0, 0}, "the file cannot be read: " + reason(errno), "see whether its disk is well");
    if (length == 0) return content;
    content.append(block, 0, static_cast<std::size_t>(length));
    if (content.size() > rules.most)
      throw InputError({file, 0, 0}, "the file has more than " + std::to_string(rules.most) + " bytes", "see whether it is the file that was meant");
  }
}

void write_file(const fs::path& path, std::string_view content) {
  fs::path aside = path;
  aside += ".part-" + std::to_string(::getpid());
  Descriptor descriptor(::open(aside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
  if (!descriptor.ok()) cannot_write(path, errno);
  int error = fill(descriptor, content);
  if (error == 0 && ::rename(aside.c_str(), path.c_str()) != 0) error = errno;
  if (error == 0) return;
  ::unlink(aside.c_str());
  cannot_write(path, error);
}

void sync_directory(const fs::path& directory) {
  const Descriptor descriptor(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!descriptor.ok()) cannot_write(directory, errno);
  if (::fsync(descriptor.number()) != 0 && errno != EINVAL && errno != ENOTSUP) cannot_write(directory, errno);
}

}  // namespace snug::input
