#include "solver/app/library_file.hpp"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

namespace snug::app {

namespace fs = std::filesystem;

namespace {

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

fs::path library_file() {
  if (const std::string named = variable("SNUG_LIBRARY"); !named.empty()) return named;
  const std::string data = variable("XDG_DATA_HOME"), home = variable("HOME");
  if (!data.empty() && fs::path(data).is_absolute()) return fs::path(data) / "snug" / "library.db";
  return home.empty() ? fs::path() : fs::path(home) / ".local" / "share" / "snug" / "library.db";
}

std::string user_name() {
  const passwd* user = ::getpwuid(::geteuid());
  if (user && user->pw_name && *user->pw_name) return user->pw_name;
  return "user " + std::to_string(::geteuid());
}

}  // namespace snug::app
