#include "solver/app/case_copy.hpp"

#include <unistd.h>

#include "cases/input/diagnostics.hpp"

namespace snug::app {

namespace fs = std::filesystem;

namespace {

bool belongs_to_the_copy(const fs::path& name) { return name != "out" && name != "study" && name != "expected.toml"; }

}  // namespace

void copy_case(const fs::path& from, const fs::path& to, const std::function<void(const fs::path& copy)>& change) {
  if (fs::exists(to)) throw input::InputError({to.string(), 0, 0}, "this is there already", "choose another name; nothing is overwritten");
  const fs::path aside = to.string() + ".tmp-" + std::to_string(::getpid());
  fs::create_directories(aside);
  try {
    for (const auto& entry : fs::directory_iterator(from))
      if (belongs_to_the_copy(entry.path().filename())) fs::copy(entry.path(), aside / entry.path().filename(), fs::copy_options::recursive);
    if (change) change(aside);
    fs::rename(aside, to);
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(aside, ignored);
    throw;
  }
}

}  // namespace snug::app
