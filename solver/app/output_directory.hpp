// Results are written aside and renamed, so that nothing is ever half-written.
#pragma once

#include <filesystem>

namespace snug::app {

/// A directory that is filled aside ("out.tmp-PID") and takes its name by `commit`. Without commit it disappears.
class OutputDirectory {
 public:
  /// Throws input::InputError when `target` holds something that is no earlier result: it would be lost.
  explicit OutputDirectory(std::filesystem::path target);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// Makes the directory aside (on the first call) and gives its place.
  const std::filesystem::path& aside();
  const std::filesystem::path& target() const { return target_; }
  /// Puts the directory in the place of the earlier one.
  void commit();

 private:
  std::filesystem::path target_, aside_;
  bool made_ = false;
};

}  // namespace snug::app
