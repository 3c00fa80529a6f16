#include "solver/app/data_directory.hpp"

#include <system_error>

namespace snug::app {

namespace fs = std::filesystem;

fs::path data_directory() {
  std::error_code ignored;
  const fs::path program = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  const fs::path built = program / "share" / "snug";
  if (fs::is_directory(built, ignored)) return built;
  return (program / SNUG_INSTALLED_DATA).lexically_normal();  // relative, so that the whole can be moved
}

fs::path bodies_folder() { return data_directory() / "bodies"; }

}  // namespace snug::app
