// Ctrl-C and its relatives: the first asks for an end in good order, the second ends at once.
#pragma once

#include <string>

namespace snug::app {

/// For as long as it lives SIGINT, SIGTERM and SIGHUP are noted and do no more; a second one has its usual effect. SIGPIPE is
/// ignored: a reader of standard output that goes away does not cost a solution. One at a time: a signal has no other
/// way to reach the program than through the process.
class StopSignals {
 public:
  /// `rank`: mpirun passes on SIGUSR1 for SIGINT and SIGUSR2 for SIGTERM.
  explicit StopSignals(bool rank);
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Takes the signals again, after a library took them.
  static void take(bool rank);
  /// SIGINT, SIGTERM or SIGHUP; 0: none has come.
  static int received();
  /// "SIGINT".
  static std::string name(int signal);
};

}  // namespace snug::app
