#include "solver/app/output_directory.hpp"

#include <unistd.h>

#include <string>

#include "cases/input/diagnostics.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

/// Only directories that snug wrote may be replaced: an --out that names something else is a slip of the user.
bool may_be_replaced(const fs::path& target) {
  if (!fs::exists(target)) return true;
  if (!fs::is_directory(target)) return false;
  if (fs::exists(target / "case.toml")) return false;
  if (fs::exists(target / "summary.json") || fs::exists(target / "body.vtu") || fs::exists(target / "study.csv"))
    return true;
  for (const auto& entry : fs::directory_iterator(target))
    if (entry.path().filename() != "mesh") return false;
  return true;
}

fs::path without_trailing_slash(const fs::path& path) {
  const fs::path normal = path.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

}  // namespace

OutputDirectory::OutputDirectory(fs::path target) : target_(without_trailing_slash(target)) {
  aside_ = target_;
  aside_ += ".tmp-" + std::to_string(::getpid());
  if (!may_be_replaced(target_))
    throw input::InputError({target_.string(), 0, 0}, "this is there already and holds no result of snug",
                            "name another directory with --out");
}

OutputDirectory::~OutputDirectory() {
  std::error_code ignored;
  if (made_) fs::remove_all(aside_, ignored);
}

const fs::path& OutputDirectory::aside() {
  if (!made_) {
    fs::remove_all(aside_);
    fs::create_directories(aside_);
    made_ = true;
  }
  return aside_;
}

void OutputDirectory::commit() {
  fs::path earlier = target_;
  earlier += ".old-" + std::to_string(::getpid());
  const bool replaces = fs::exists(target_);
  if (replaces) fs::rename(target_, earlier);
  fs::rename(aside(), target_);
  made_ = false;
  if (replaces) fs::remove_all(earlier);
}

}  // namespace snug::app
