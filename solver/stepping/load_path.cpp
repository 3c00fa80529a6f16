#include "solver/stepping/load_path.hpp"

#include <algorithm>
#include <cmath>

namespace snug::solver {

namespace {

NewtonSettings increment_settings(const PathSettings& path, bool last, int failures) {
  NewtonSettings settings = path.newton;
  settings.recut = last;
  settings.minimum = last && path.minimum;
  if (!last) {
    settings.residual = path.intermediate_residual;
    settings.complementarity = 1e-2;
    settings.penetration = 1e-5;
    settings.volume = 1e-3;
  }
  for (int f = 0; f < failures; ++f) settings.proximal *= 10.0;
  return settings;
}

// Straight extrapolation of the last increment; pressures stay non-negative.
State predict(const PathResult& last, const State& before, double span, double step, const Layout& layout) {
  State guess = last.state;
  if (span <= 0.0) return guess;
  guess.values += std::min(step / span, 2.0) * (last.state.values - before.values);
  guess.values.tail(layout.multipliers) = guess.values.tail(layout.multipliers).cwiseMax(0.0);
  return guess;
}

}  // namespace

Homotopy tightening(double from, double to) {
  return [=](State& state, double t) { state.load = from + t * (to - from); };
}

Homotopy releasing(double factor) {
  return [=](State& state, double t) { state.stiffening = std::pow(factor, 1.0 - t); };
}

Homotopy letting_go() {
  return [](State& state, double t) { state.release = t; };
}

Homotopy fading() {
  return [](State& state, double t) { state.release = std::pow(100.0, t); };
}

PathResult follow_path(Scene& scene, State start, const Homotopy& homotopy, const PathSettings& path,
                       const IterationSink& sink) {
  PathResult result;
  scene.begin(start);
  result.state = start;
  State before = start;
  double step = std::min(path.first_step, path.longest_step), span = 0.0;
  int failures = 0;
  while (result.reached < 1.0) {
    const double t = std::min(1.0, result.reached + step);
    const bool last = t > 1.0 - 1e-12 && !path.leads_on;
    State trial = failures == 0 ? predict(result, before, span, t - result.reached, scene.layout()) : result.state;
    homotopy(trial, t);
    const int increment = result.increments + 1;
    int iterations = 0;
    const Outcome outcome =
        newton(scene, trial, increment_settings(path, last, failures), [&](postproc::Iteration row) {
          row.increment = increment;
          iterations = row.iteration;
          row.attempt = failures + 1;
          sink(row);
        });
    if (outcome == Outcome::converged) {
      before = result.state;
      span = t - result.reached;
      scene.commit(trial);
      result.state = trial;
      result.reached = t;
      result.increments = increment;
      failures = 0;
      if (path.accepted) path.accepted(scene, result.state, t);
      step = std::min(1.5 * step, path.longest_step);
      if (t + 1.3 * step > 1.0) step = 1.0 - t;
    } else {
      result.message = to_string(outcome);
      result.lost += iterations;
      if (outcome == Outcome::stopped || ++failures > path.failures || step < path.smallest_step || result.lost > path.lost_iterations) {
        scene.renew(result.state);  // terms look at the state that is returned, not at the failed one
        scene.update(result.state);
        return result;
      }
      step *= 0.5;
    }
  }
  result.complete = true;
  result.message.clear();
  return result;
}

}  // namespace snug::solver
