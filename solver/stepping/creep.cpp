#include "solver/stepping/creep.hpp"

#include <algorithm>

#include "solver/terms/drag.hpp"

namespace snug::solver {

namespace {

// Drag over the stiffness of the cloth between neighbouring nodes: the first step moves cloth that hangs on by its own tension by about a
// hundredth of an edge. Strong enough, it holds everything.
constexpr double first_drag = 1e-2, largest_drag = 10.0, least_drag = 1e-9;
constexpr double stronger = 4.0;
// How exactly a step is solved: a tenth of what it leaves to be done, and at least so.
constexpr double loosest = 1e-4, share_of_rest = 0.1;
// Residual without the drag from which on the answer is tried, and by how much nearer it has to be after it was not found.
constexpr double at_rest = 1e-3, nearer = 0.1;

/// Drag of the next step: what was easy to solve may be longer.
double weaker(int iterations) { return iterations <= 5 ? 0.2 : iterations <= 10 ? 0.4 : iterations <= 20 ? 0.8 : 1.5; }

NewtonSettings settings_of_step(const NewtonSettings& on_the_way) {
  NewtonSettings settings = on_the_way;
  settings.residual = loosest, settings.complementarity = 1e-2, settings.penetration = 1e-5, settings.volume = 1e-3;
  settings.recut = settings.minimum = false;
  settings.cuts = true;
  return settings;
}

}  // namespace

Outcome creep(Scene& scene, State& state, const NewtonSettings& on_the_way, const NewtonSettings& answer, int most, const IterationSink& sink) {
  NewtonSettings settings = settings_of_step(on_the_way);
  double drag = first_drag, rest = at_rest;
  Outcome outcome = Outcome::no_progress;
  for (int spent = 0; spent < most && drag <= largest_drag;) {
    State trial = state;
    Drag::hold_back(trial, drag);
    int iterations = 0;
    outcome = newton(scene, trial, settings, [&](const postproc::Iteration& row) { iterations = row.iteration, sink(row); });
    spent += iterations + 1;
    if (outcome == Outcome::stopped) return outcome;
    if (outcome != Outcome::converged) {
      drag *= stronger;
      continue;
    }
    scene.commit(trial);
    Drag::hold_back(trial, 0.0);
    state = std::move(trial);
    scene.update(state);
    if (!scene.assemble(state, Tangent::full)) return Outcome::inadmissible;
    const double left = check(scene, state, answer).residual;
    settings.residual = std::min(loosest, share_of_rest * left);
    drag = std::max(least_drag, drag * weaker(iterations));
    if (left >= rest) continue;
    State there = state;
    outcome = newton(scene, there, answer, [&](const postproc::Iteration& row) { spent += row.iteration > 0, sink(row); });
    if (outcome == Outcome::converged || outcome == Outcome::stopped) {
      state = std::move(there);
      return outcome;
    }
    rest = nearer * left;
  }
  return outcome == Outcome::converged ? Outcome::no_progress : outcome;
}

}  // namespace snug::solver
