// Work on somebody else's file in a process of its own: it may crash, hang or ask for all memory without harm.
#pragma once

#include <functional>
#include <string>

namespace snug::mesh {

struct Limits {
  double memory = 1024.0 * 1024.0 * 1024.0;  ///< bytes that it may add to what this process has
  double seconds = 300.0;
  bool sandbox = true;  ///< it may start no program and write no file, and stands in an empty directory that is gone
};

/// How such a process ended.
struct Contained {
  enum class End { done, died, out_of_time };
  End end = End::done;
  std::string output;  ///< what `work` returned; empty unless done
  int signal = 0;      ///< that killed it; 0 where it ended itself before its work was done
};

/// Runs `work` in a child process, made by fork alone: it may use what stands in memory, one thread of it. The child ends with
/// this process. Throws std::runtime_error when none can be started.
Contained contained(const std::function<std::string()>& work, const Limits& limits);

}  // namespace snug::mesh
