#include "solver/app/output_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdio.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <random>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "cases/input/files.hpp"

namespace snug::app {

namespace fs = std::filesystem;

/// Where the file system has no locks, a directory aside is told to be alive by the process in its name.
class OutputDirectory::Lock {
 public:
  enum class Wait { yes, no };
  Lock(const fs::path& directory, Wait wait) : number_(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    const int how = wait == Wait::yes ? LOCK_EX : LOCK_EX | LOCK_NB;
    while (number_ >= 0 && !(held_ = ::flock(number_, how) == 0)) {
      if (errno == EINTR) continue;
      busy_ = errno == EWOULDBLOCK;
      return;
    }
  }
  ~Lock() {
    if (number_ < 0) return;
    ::flock(number_, LOCK_UN);  // whatever becomes of the closing: others wait for it
    ::close(number_);
  }
  Lock(const Lock&) = delete;
  Lock& operator=(const Lock&) = delete;
  /// Another process holds it.
  bool busy() const { return busy_; }
  bool held() const { return held_; }

 private:
  int number_;
  bool busy_ = false, held_ = false;
};

namespace {

using Lock = OutputDirectory::Lock;

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

/// What symbolic links lead to, also when it is not there yet.
fs::path behind_links(fs::path path) {
  for (int hops = 0; hops < 40 && fs::is_symlink(fs::symlink_status(path)); ++hops) {
    const fs::path next = fs::read_symlink(path);
    path = without_trailing_slash(next.is_absolute() ? next : path.parent_path() / next);
  }
  return path;
}

fs::path parent_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : fs::path("."); }

std::string reason(int error) { return std::generic_category().message(error); }

bool is_there(const fs::path& path) { return fs::exists(fs::symlink_status(path)); }

/// Nothing is in it but a mark that was being written: of a run that was killed as it began, or at its very end.
bool is_bare(const fs::path& aside) {
  std::error_code failed;
  for (const auto& entry : fs::directory_iterator(aside, failed))
    if (!entry.path().filename().string().starts_with(result_mark)) return false;
  return !failed && std::isdigit(static_cast<unsigned char>(aside.string()[aside.string().rfind(".tmp-") + 5]));
}

/// Directories aside of `target`, those of live runs too.
std::vector<fs::path> asides_of(const fs::path& target) {
  std::vector<fs::path> found;
  std::error_code ignored;
  const std::string prefix = target.filename().string() + ".tmp-";
  for (const auto& entry : fs::directory_iterator(parent_of(target), ignored))
    if (entry.is_directory() && !entry.is_symlink() && entry.path().filename().string().starts_with(prefix) &&
        (fs::exists(entry.path() / result_mark) || is_bare(entry.path())))
      found.push_back(entry.path());
  std::sort(found.begin(), found.end());
  return found;
}

/// A run works on it; `name`: "out.tmp-PID-…".
bool is_alive(const fs::path& aside) {
  const Lock lock(aside, Lock::Wait::no);
  if (lock.busy() || lock.held()) return lock.busy();
  const std::string name = aside.filename().string();
  const int process = std::atoi(name.c_str() + name.rfind(".tmp-") + 5);
  return process > 0 && (::kill(process, 0) == 0 || errno == EPERM);
}

bool same_file(const fs::path& a, const fs::path& b) {
  struct stat first {}, second {};
  return ::lstat(a.c_str(), &first) == 0 && ::lstat(b.c_str(), &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

/// Files of the user in `from` become files of `to`, too. What cannot be linked is moved later by `give_back`.
void link_foreign(const fs::path& from, const ResultList& ours, const fs::path& to) {
  for (const auto& entry : fs::recursive_directory_iterator(from)) {
    const fs::path relative = entry.path().lexically_relative(from);
    std::error_code ignored;
    if (entry.is_directory() && !entry.is_symlink()) {
      if (fs::is_empty(entry.path(), ignored)) fs::create_directories(to / relative, ignored);
    } else if (relative != result_mark && !ours.count(relative.generic_string())) {
      fs::create_directories((to / relative).parent_path());
      fs::create_hard_link(entry.path(), to / relative, ignored);
    }
  }
}

/// Removes directories that hold nothing, the deepest first.
void remove_empty(const fs::path& directory) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(directory, ignored))
    if (entry.is_directory() && !entry.is_symlink()) remove_empty(entry.path());
  fs::remove(directory, ignored);
}

/// Takes an earlier directory of results away: what snug wrote goes, what is also in `target` goes, anything else of the user
/// moves there.
void give_back(const fs::path& earlier, const fs::path& target) {
  const ResultList ours = read_result_list(earlier).value_or(ResultList{});
  for (const std::string& file : files_below(earlier)) {
    const bool replaced = ours.count(file) != 0 || same_file(earlier / file, target / file);
    std::error_code failed;
    if (replaced || is_there(target / file)) {
      if (replaced) fs::remove(earlier / file, failed);
    } else {
      fs::create_directories((target / file).parent_path(), failed);
      fs::rename(earlier / file, target / file, failed);
    }
    if (failed || (!replaced && is_there(earlier / file)))
      fmt::print(stderr, "snug: warning: {} could not be brought back to {}: it stays where it is\n", (earlier / file).string(), target.string());
  }
  std::error_code ignored;
  if (files_below(earlier).empty()) fs::remove(earlier / result_mark, ignored);
  remove_empty(earlier);
}

/// The place in whose way nothing may stand that is not snug's.
void refuse_foreign(const fs::path& target) {
  if (!fs::is_directory(target))
    throw input::InputError({target.string(), 0, 0}, "this is there already and is no directory", "name another place with --out");
  for (const auto& entry : fs::directory_iterator(target))
    if (!entry.is_directory() || entry.is_symlink() || !read_result_list(entry.path()))
      throw input::InputError({target.string(), 0, 0},
                              fmt::format("this folder holds {} and does not carry snug's mark ({})",
                                          entry.path().filename().string(), result_mark),
                              "name another place with --out, or, where these are results of an earlier version of snug, delete it");
}

/// A file system that is mounted there cannot change places with a directory.
bool is_mounted(const fs::path& directory) {
  struct statx about {};
  return ::statx(AT_FDCWD, directory.c_str(), 0, STATX_TYPE, &about) == 0 &&
         (about.stx_attributes_mask & STATX_ATTR_MOUNT_ROOT) && (about.stx_attributes & STATX_ATTR_MOUNT_ROOT);
}

void rename_or_throw(const fs::path& from, const fs::path& to) {
  if (::rename(from.c_str(), to.c_str()) != 0)
    throw std::runtime_error(fmt::format("{} cannot become {}: {}", from.string(), to.string(), reason(errno)));
}

void remove_aside(const fs::path& aside, const fs::path& target) {
  bool complete = false;
  std::error_code failed;
  if (read_result_list(aside, &complete) && complete) return give_back(aside, target);
  fs::remove_all(aside, failed);
  if (failed) fmt::print(stderr, "snug: warning: {} is left over and cannot be removed: {}\n", aside.string(), failed.message());
}

}  // namespace

void repair_results(const fs::path& named) {
  const fs::path target = behind_links(without_trailing_slash(named));
  if (asides_of(target).empty()) return;
  const Lock lock(parent_of(target), Lock::Wait::yes);
  for (const fs::path& aside : asides_of(target)) {
    if (is_alive(aside)) continue;
    bool complete = false;
    read_result_list(aside, &complete);
    std::error_code failed;
    if (complete && !is_there(target)) {
      fs::rename(aside, target, failed);
      if (!failed) continue;
    }
    remove_aside(aside, target);
  }
}

OutputDirectory::OutputDirectory(fs::path target) : named_(without_trailing_slash(target)) {
  repair_results(named_);
  target_ = behind_links(named_);
  check_target({});
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  if (made_) fs::remove_all(aside_, ignored);
}

void OutputDirectory::check_target(const ResultList& files) const {
  if (!is_there(target_)) return;
  if (!read_result_list(target_)) refuse_foreign(target_);
  check_may_add(target_, files);
}

const fs::path& OutputDirectory::aside() {
  if (made_) return aside_;
  const input::Location where{named_.string(), 0, 0};
  if (is_there(target_) && is_mounted(target_))
    throw input::InputError(where, "another file system is mounted here, so that results cannot take its place in one stroke",
                            "name a folder in it: --out " + (named_ / "out").string());
  std::error_code failed;
  fs::create_directories(parent_of(target_), failed);
  const Lock together(parent_of(target_), Lock::Wait::yes);  // nobody sees the directory before it is locked
  std::random_device random;  // the number of the process alone is not its own where several containers share a disk
  for (bool fresh = false; !fresh && !failed;) {
    aside_ = target_.string() + fmt::format(".tmp-{}-{:06x}", ::getpid(), random() & 0xffffff);
    fresh = fs::create_directory(aside_, failed);
  }
  if (failed)
    throw input::InputError(where, "results cannot be written here: " + failed.message(), "name another place with --out");
  made_ = true;
  alive_ = std::make_unique<Lock>(aside_, Lock::Wait::no);
  try {
    write_result_list(aside_, {}, false);
  } catch (const fs::filesystem_error& error) {
    throw input::InputError(where, "results cannot be written here: " + error.code().message(), "name another place with --out");
  }
  return aside_;
}

/// Exchanges the two names in one stroke where the file system can; otherwise for an instant there is neither, and
/// `repair_results` puts that right.
void OutputDirectory::exchange() {
  if (::renameat2(AT_FDCWD, aside_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) return;
  if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP)
    throw std::runtime_error(fmt::format("{} cannot take the place of {}: {}", aside_.string(), target_.string(), reason(errno)));
  const fs::path earlier = aside_.string() + "-earlier";
  rename_or_throw(target_, earlier);
  try {
    rename_or_throw(aside_, target_);
  } catch (...) {
    ::rename(earlier.c_str(), target_.c_str());
    throw;
  }
  ::rename(earlier.c_str(), aside_.c_str());
}

/// Takes the directory out of the reach of `repair_results`, which would remove it at the end of this process.
fs::path OutputDirectory::keep() const {
  const fs::path kept = target_.string() + ".kept-" + aside_.string().substr(aside_.string().rfind(".tmp-") + 5);
  return ::rename(aside_.c_str(), kept.c_str()) == 0 ? kept : aside_;
}

void OutputDirectory::commit() {
  aside();
  made_ = false;  // from here on the results are whole: whatever fails does not cost them
  const Lock lock(parent_of(target_), Lock::Wait::yes);
  const bool replaces = is_there(target_);
  try {
    const ResultList files = files_below(aside_);
    check_target(files);
    write_result_list(aside_, files, true);
    if (replaces) {
      link_foreign(target_, read_result_list(target_).value_or(ResultList{}), aside_);
      fs::permissions(aside_, fs::status(target_).permissions());
    }
    for (const auto& entry : fs::recursive_directory_iterator(aside_))
      if (entry.is_directory() && !entry.is_symlink()) input::sync_directory(entry.path());
    input::sync_directory(aside_);
    replaces ? exchange() : rename_or_throw(aside_, target_);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("{}; the results are in {}", error.what(), keep().string()));
  }
  if (replaces) give_back(aside_, target_);
  input::sync_directory(parent_of(target_));
  alive_.reset();
}

}  // namespace snug::app
