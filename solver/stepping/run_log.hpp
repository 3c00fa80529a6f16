// What a run writes down of itself while it runs: phases with their times and costs, and the rows of its iterations.
#pragma once

#include <chrono>
#include <map>
#include <string>

#include "solver/algebra/costs.hpp"
#include "solver/scene/run.hpp"
#include "solver/stepping/newton.hpp"

namespace snug::solver {

class RunLog {
 public:
  /// Writes into `result`, which outlives it; the observer may be empty.
  RunLog(postproc::RunResult& result, const Observer& observer);

  void expect(double seconds) { expected_ = seconds; }
  double seconds() const;
  /// Adds the time since the last call to the phase `name`.
  void phase(const std::string& name);
  /// Tells where the time of the phase `name` went, from the scene that it was spent in.
  void account(Scene& scene, const std::string& name);
  /// Ends a path: its increments, its time and its costs go to the phase `name`.
  void end_path(Scene& scene, int increments, const std::string& name);
  /// Increments of the paths that have ended.
  int increments() const { return increments_before_; }
  /// Rows of a path that belongs to the history, and of one that does not.
  IterationSink sink(const std::string& name);
  IterationSink quiet(const std::string& name);

 private:
  using Clock = std::chrono::steady_clock;
  void show(const std::string& name, const postproc::Iteration& row) const;

  postproc::RunResult& result_;
  const Observer& observer_;
  Clock::time_point start_;
  double last_phase_ = 0.0, expected_ = 0.0;
  int increments_before_ = 0;
  std::map<std::string, Costs> spent_;  ///< a phase
};

}  // namespace snug::solver
