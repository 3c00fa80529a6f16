#include "solver/stepping/load_path.hpp"

#include <algorithm>

namespace snug::solver {

namespace {

NewtonSettings increment_settings(const PathSettings& path, bool last, int failures) {
  NewtonSettings settings = path.newton;
  if (!last) {
    settings.residual = path.intermediate_residual;
    settings.complementarity = 1e-2;
    settings.penetration = 1e-5;
  }
  for (int f = 0; f < failures; ++f) settings.proximal *= 10.0;
  return settings;
}

// Straight extrapolation of the last increment; pressures stay non-negative.
State predict(const State& last, const State& before, double load, const Layout& layout) {
  State guess = last;
  guess.load = load;
  const double span = last.load - before.load;
  if (span <= 0.0) return guess;
  guess.values += std::min((load - last.load) / span, 2.0) * (last.values - before.values);
  guess.values.tail(layout.multipliers) = guess.values.tail(layout.multipliers).cwiseMax(0.0);
  return guess;
}

}  // namespace

PathResult follow_path(Scene& scene, State start, const PathSettings& path, const IterationSink& sink) {
  PathResult result;
  result.state = start;
  State before = start;
  double step = path.first_step;
  int failures = 0;
  while (result.state.load < 1.0) {
    const double load = std::min(1.0, result.state.load + step);
    const bool last = load > 1.0 - 1e-12;
    State trial = failures == 0 ? predict(result.state, before, load, scene.layout()) : result.state;
    trial.load = load;
    const int increment = result.increments + 1;
    const Outcome outcome =
        newton(scene, trial, increment_settings(path, last, failures), [&](postproc::Iteration row) {
          row.increment = increment;
          sink(row);
        });
    if (outcome == Outcome::converged) {
      before = result.state;
      result.state = trial;
      result.increments = increment;
      failures = 0;
      step *= 1.5;
      if (result.state.load + 1.3 * step > 1.0) step = 1.0 - result.state.load;
    } else {
      result.message = to_string(outcome);
      if (++failures > path.failures || step < path.smallest_step) return result;
      step *= 0.5;
    }
  }
  result.complete = true;
  result.message.clear();
  return result;
}

}  // namespace snug::solver
