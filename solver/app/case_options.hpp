// Options that every command with a case has.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/input/case.hpp"

namespace CLI {
class App;
}

namespace snug::app {

struct CaseOptions {
  std::vector<std::string> overrides;
  std::string tier;
  bool allow_outside = false;

  void declare(CLI::App& app);
  /// Reads the case with the options applied. Throws input::InputError.
  input::Case read(const std::filesystem::path& directory) const;
};

}  // namespace snug::app
