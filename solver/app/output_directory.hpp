// Results are written aside and put in their place in one stroke, so that nothing is ever half-written.
#pragma once

#include <filesystem>
#include <memory>

#include "solver/app/result_list.hpp"

namespace snug::app {

/// A directory that is filled aside ("out.tmp-PID-…") and takes its name by `commit`. Without commit it disappears. What lies
/// in the earlier directory and is not on snug's list there is kept: it is linked into the new one first. Where the
/// directory is a symbolic link, what it leads to is exchanged and the link stays.
class OutputDirectory {
 public:
  /// Repairs what an earlier run that was killed has left, and looks at what is there. Throws input::InputError when
  /// `target` holds something and does not carry snug's mark.
  explicit OutputDirectory(std::filesystem::path target);
  ~OutputDirectory();
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;

  /// Makes the directory aside (on the first call) and gives its place. Throws input::InputError when it cannot be made or
  /// could not take its place at the end; called before a solve, this does not cost the solve.
  const std::filesystem::path& aside();
  /// As the user named it.
  const std::filesystem::path& target() const { return named_; }
  /// Puts the directory in the place of the earlier one: at every instant one of the two is whole under the name. Throws
  /// std::runtime_error when that fails, and then keeps the directory as "out.kept-PID-…" and names it.
  void commit();

  /// An advisory lock on a directory, gone with the process.
  class Lock;

 private:
  void check_target(const ResultList& files) const;
  void exchange();
  std::filesystem::path keep() const;

  std::filesystem::path named_, target_, aside_;
  std::unique_ptr<Lock> alive_;  ///< on the directory aside, for as long as this process works on it
  bool made_ = false;
};

/// Puts right what a run that was killed has left beside `target`: results that were being put in their place take it or
/// give way to those that have it, a directory that was being filled is removed, and files of the user go back. Directories
/// of runs that are alive are left alone. Says on standard error what cannot be put right.
void repair_results(const std::filesystem::path& target);

}  // namespace snug::app
