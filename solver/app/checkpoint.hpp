// The file that an unfinished run can go on from.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "postproc/csv_writer.hpp"
#include "solver/app/prepared_case.hpp"
#include "solver/stepping/journal.hpp"

namespace snug::app {

/// What a run goes on with: its states, and how its tables are written.
struct Unfinished {
  solver::Journal journal;
  postproc::CsvStyle csv = postproc::CsvStyle::comma;
};

/// "out.checkpoint" beside the results "out": there until its run has ended. It is replaced in one stroke, so that it is whole at
/// every instant.
class Checkpoint {
 public:
  /// Of results in `target`. `interval`: seconds from one writing to the next, and to the first.
  Checkpoint(const std::filesystem::path& target, double interval);

  bool there() const;
  const std::filesystem::path& file() const { return file_; }
  /// Throws input::InputError when the file is not whole, or another case's or program's.
  Unfinished read(const PreparedCase& prepared) const;
  /// Once the interval has passed, by way of the folder `aside`. What cannot be written costs nothing else and is said once.
  void keep(const solver::Journal& journal, postproc::CsvStyle csv, const PreparedCase& prepared, const std::filesystem::path& aside);
  void remove() const;

 private:
  using Clock = std::chrono::steady_clock;
  std::filesystem::path file_;
  double interval_;
  Clock::time_point last_ = Clock::now();
  bool said_ = false;
};

}  // namespace snug::app
