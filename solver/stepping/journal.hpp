// How far a run has come, kept so that it can go on from there when it was stopped or killed.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "postproc/result.hpp"
#include "solver/algebra/state.hpp"

namespace snug::solver {

/// A path (load_path.hpp) as far as it has come: its last accepted state and the values of the one before, the next step and the rows of its iterations.
struct PathRecord {
  State state = {};
  Eigen::VectorXd before = {};  ///< values of the accepted state before
  double reached = 0.0, span = 0.0, step = 1.0;
  int increments = 0;
  int lost = 0;                 ///< iterations of increments that failed
  int crept = 0;                ///< iterations on which cloth crept (creep.hpp)
  double slid = 0.0;            ///< largest way of a node while it did, m
  bool ended = false, complete = false;
  std::string message = {};
  std::vector<postproc::Iteration> rows = {};
};

/// The paths of a run in the order in which it walks them. Nothing in a run depends on chance or time, so a run that goes on
/// walks the same paths again: what is recorded is taken from here, the rest is solved.
class Journal {
 public:
  /// Called whenever more is recorded.
  void on_change(std::function<void(const Journal&)> change) { change_ = std::move(change); }
  /// Begins the next path; what is recorded of it, if anything.
  std::optional<PathRecord> begin();
  /// What has become of the path that began last.
  void note(const PathRecord& record);
  /// The run is stopped: nothing that comes after is recorded.
  void stop();
  const std::vector<PathRecord>& paths() const { return paths_; }

  /// To the last bit, for the same machine.
  std::string bytes() const;
  /// Throws std::runtime_error when the bytes end too soon or go on.
  static Journal of_bytes(std::string_view bytes);

 private:
  std::vector<PathRecord> paths_;
  std::size_t begun_ = 0;
  bool stopped_ = false;
  std::function<void(const Journal&)> change_;
};

}  // namespace snug::solver
