// A folder of the run's own for what libraries put into temporary places.
#pragma once

#include <filesystem>

#include "solver/app/cleaner.hpp"

namespace snug::app {

/// Made under `base`, removed with the object, or by the cleaner when this process is killed.
class Scratch {
 public:
  /// Throws input::InputError naming TMPDIR when it cannot be made.
  Scratch(const std::filesystem::path& base, const Cleaner& cleaner);
  ~Scratch();
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What TMPDIR names, or /tmp.
std::filesystem::path temporary_place();

}  // namespace snug::app
