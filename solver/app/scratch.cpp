#include "solver/app/scratch.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <cerrno>
#include <random>
#include <system_error>

#include "cases/input/diagnostics.hpp"

namespace snug::app {

namespace fs = std::filesystem;

Scratch::Scratch(const fs::path& base, const Cleaner& cleaner) {
  std::random_device random;
  path_ = base / fmt::format("snug-{:08x}{:08x}", random(), random());
  cleaner.remove(path_);  // told first: a kill between the two leaves nothing
  if (::mkdir(path_.c_str(), 0700) != 0)
    throw input::InputError({base.string(), 0, 0}, "no temporary folder can be made here: " + std::generic_category().message(errno),
                            "set TMPDIR to a folder that can be written to");
}

Scratch::~Scratch() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path temporary_place() {
  std::error_code failed;
  const fs::path place = fs::temp_directory_path(failed);
  if (failed) throw input::InputError({"TMPDIR", 0, 0}, "it names no folder: " + failed.message(), "set it to a folder that can be written to, or leave it unset");
  return place;
}

}  // namespace snug::app
