// A program run aside, with what it took.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace snug::app {

struct ChildOutcome {
  int status = 0;     ///< exit status; 127 when there is no such program, 128 + signal when it was ended by one
  double wall = 0.0;  ///< s, from start to end
  double user = 0.0, system = 0.0;  ///< s of processor time, all threads
  double memory = 0.0;              ///< bytes, peak resident
  std::string output;               ///< standard output and standard error
};

/// Runs `words` (the program first, looked up in PATH) in `directory`; returns when it has ended. Interrupting us
/// interrupts it.
ChildOutcome run_child(const std::vector<std::string>& words, const std::filesystem::path& directory);

}  // namespace snug::app
