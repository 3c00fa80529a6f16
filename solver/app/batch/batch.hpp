// Several runs at a time, each a process of its own, and one page about them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/csv_writer.hpp"
#include "solver/app/case_options.hpp"
#include "solver/app/console.hpp"

namespace snug::app {

/// What snug run is asked for beside one case.
struct BatchRequest {
  std::vector<std::string> directories;
  CaseOptions options;
  std::string out;                   ///< where the results go, a directory each; empty: out/ of the cases
  std::vector<std::string> sweeps;   ///< of --sweep
  std::vector<std::string> variants; ///< names of --variant; empty: all
  std::vector<std::string> words;    ///< options that every run gets as they stand
  int ranks = 0;                     ///< of each; 0: one where they run side by side, else as the run chooses
  int jobs = 0;                      ///< at a time; 0: as many as there are cores for them
  bool quiet = false, page = true;
  postproc::CsvStyle csv = postproc::CsvStyle::comma;  ///< of sweep.csv

  /// True where one case is run with other values: variants or a sweep. What is wrong with the case is not said here.
  bool varies() const;
  /// True where it is more than one case run once.
  bool several() const { return directories.size() > 1 || varies(); }
};

/// Runs them and prints a line each; one that fails stops no other. Writes compare.html, of a sweep sweep.csv too. The exit status is the largest of
/// theirs. Throws input::InputError where the request itself is wrong.
int run_batch(const BatchRequest& request, Console& console);

}  // namespace snug::app
