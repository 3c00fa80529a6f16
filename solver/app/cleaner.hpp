// A small process that outlives this one by a moment and takes away what it could not: a process that is killed (SIGKILL, out
// of memory) cleans nothing up itself.
#pragma once

#include <filesystem>

namespace snug::app {

class Cleaner {
 public:
  /// Starts the process, before there are threads. Where none can be started nothing is watched; the next run repairs.
  Cleaner();
  /// Ends it. What is to be removed is removed now.
  ~Cleaner();
  Cleaner(const Cleaner&) = delete;
  Cleaner& operator=(const Cleaner&) = delete;

  /// At the end of this process `repair_results(target)` is called.
  void repair(const std::filesystem::path& target) const { tell('r', target); }
  /// At the end of this process a file or a directory with all in it is removed.
  void remove(const std::filesystem::path& path) const { tell('d', path); }

 private:
  void tell(char what, const std::filesystem::path& path) const;

  int to_ = -1;  ///< its ear: closed with this process
  int child_ = -1;
};

}  // namespace snug::app
