#include "solver/stepping/load_path.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/stepping/creep.hpp"
#include "solver/stepping/journal.hpp"
#include "solver/stepping/minimise.hpp"
#include "solver/terms/drag.hpp"

namespace snug::solver {

namespace {

NewtonSettings increment_settings(const PathSettings& path, bool last, int failures) {
  NewtonSettings settings = path.newton;
  settings.recut = last || path.exact;
  settings.minimum = (last || path.exact) && path.minimum;
  if (!last && !path.exact) {
    settings.residual = path.intermediate_residual;
    settings.complementarity = 1e-2;
    settings.penetration = 1e-5;
    settings.volume = 1e-3;
  }
  for (int f = 0; f < failures; ++f) settings.proximal *= 10.0;
  return settings;
}

// Of contact that yields, where it begins to harden. Half of the way on it is a third as stiff as the cloth of one vertex.
constexpr double softest = 3.0;

// Attempts in a row that fail before cloth creeps.
constexpr int before_creeping = 2;
// Iterations on which it may, over a path: loose cloth that comes to rest took up to 200, what slides off a limb never does.
constexpr int most_crept = 300;

void keep_non_negative(const Layout& layout, Eigen::VectorXd& values) {
  for (const Field& field : layout.fields())
    if (field.non_negative) values.segment(field.first, field.size()) = values.segment(field.first, field.size()).cwiseMax(0.0);
}

// Straight extrapolation of the last increment, but for one on which contact has yielded; pressures stay non-negative.
State predict(const PathRecord& at, double step, const Layout& layout) {
  State guess = at.state;
  if (at.span <= 0.0 || at.state.yielding > 0.0) return guess;
  guess.values += std::min(step / at.span, 2.0) * (at.state.values - at.before);
  keep_non_negative(layout, guess.values);
  return guess;
}

/// One walk along a path: what has been reached is in the record, which a journal keeps.
class Walk {
 public:
  Walk(Scene& scene, State start, const Homotopy& homotopy, const PathSettings& settings, const IterationSink& sink)
      : scene_(scene), homotopy_(homotopy), settings_(settings), sink_(sink) {
    if (settings.journal)
      if (std::optional<PathRecord> known = settings.journal->begin()) {
        recall(std::move(*known));
        return;
      }
    at_.before = start.values, at_.state = std::move(start);
    at_.step = std::min(settings.first_step, settings.longest_step);
  }

  PathResult follow() {
    while (!at_.ended) {
      const double t = std::min(1.0, at_.reached + at_.step);
      State trial = settings_.carry ? carried(t) : failures_ == 0 ? predict(at_, t - at_.reached, scene_.layout()) : at_.state;
      homotopy_(trial, t);
      const Outcome outcome = creeps_ && trial.yielding == 0.0 ? creeping(trial, t) : increment(trial, t);
      if (outcome == Outcome::stopped) return stop();
      outcome == Outcome::converged ? accept(std::move(trial), t) : fail(outcome);
      if (settings_.journal && (at_.ended || outcome == Outcome::converged)) settings_.journal->note(at_);
    }
    return result();
  }

 private:
  void recall(PathRecord known) {
    at_ = std::move(known);
    for (const postproc::Iteration& row : at_.rows) sink_(row);
    scene_.restore(at_.state);
    scene_.update(at_.state);
  }


  /// Where everything goes along: what the last increment has changed besides is extrapolated, and what is prescribed stands where it should.
  State carried(double t) const {
    State to = at_.state, guess = at_.state;
    homotopy_(to, t);
    if (failures_ == 0 && at_.span > 0.0) {
      State before = at_.state;
      homotopy_(before, at_.reached - at_.span);
      before.values = at_.before;
      settings_.carry(before, at_.state);
      guess.values += std::min((t - at_.reached) / at_.span, 2.0) * (at_.state.values - before.values);
      keep_non_negative(scene_.layout(), guess.values);
    }
    settings_.carry(guess, to);
    if (const Eigen::VectorXd gap = scene_.supports().gap(to); gap.size() > 0)
      for (Eigen::Index i = 0; i < gap.size(); ++i)
        if (gap[i] != 0.0) guess.values[i] = to.values[i] + gap[i];
    return guess;
  }

  bool last(double t) const { return t > 1.0 - 1e-12 && !settings_.leads_on; }

  void note(postproc::Iteration row) {
    row.increment = at_.increments + 1;
    row.attempt = failures_ + 1;
    if (settings_.journal) at_.rows.push_back(row);
    sink_(row);
  }

  Outcome increment(State& trial, double t) {
    iterations_ = 0;
    const auto solve = trial.yielding > 0.0 ? minimise : newton;
    return solve(scene_, trial, increment_settings(settings_, last(t), failures_), [&](const postproc::Iteration& row) {
      iterations_ = row.iteration;
      note(row);
    });
  }

  /// From the last state to the one at t where no step leads; what was lost on the way there counts no more.
  Outcome creeping(State& trial, double t) {
    iterations_ = 0;
    const NewtonSettings loose = increment_settings(settings_, false, 0), answer = increment_settings(settings_, last(t), 0);
    const Outcome outcome = creep(scene_, trial, loose, answer, most_crept - at_.crept, [&](postproc::Iteration row) {
      if (row.iteration > 0) ++at_.crept;
      row.event = "creeps";
      note(row);
    });
    if (outcome == Outcome::converged) at_.lost = 0;
    if (const Drag* drag = scene_.find<Drag>()) at_.slid = std::max(at_.slid, drag->way(at_.state.values, trial.values));
    return outcome;
  }

  void accept(State trial, double t) {
    scene_.commit(trial);
    at_.before = std::exchange(at_.state, std::move(trial)).values;
    at_.span = creeps_ ? 0.0 : t - at_.reached;  // what crept is no direction to go on in
    at_.reached = t;
    ++at_.increments;
    failures_ = 0, creeps_ = in_vain_ = false;
    if (settings_.accepted) settings_.accepted(scene_, at_.state, t);
    at_.step = std::min(1.5 * at_.step, settings_.longest_step);
    if (t + 1.3 * at_.step > 1.0) at_.step = 1.0 - t;
    if (at_.reached < 1.0) return;
    at_.ended = at_.complete = true;
    at_.message.clear();
  }

  /// Shorter steps; cloth creeps once in a stretch of attempts that fail, and where that is in vain steps go on as before.
  void fail(Outcome outcome) {
    at_.message = to_string(outcome);
    at_.lost += iterations_;
    const bool crept = std::exchange(creeps_, false);
    in_vain_ = in_vain_ || crept;
    const bool given_up = ++failures_ > settings_.failures || at_.step < settings_.smallest_step || at_.lost > settings_.lost_iterations;
    creeps_ = settings_.creeps && !in_vain_ && at_.crept < most_crept && (given_up || failures_ >= before_creeping);
    at_.ended = given_up && !creeps_;
    if (!given_up && !crept) at_.step *= 0.5;
  }

  PathResult stop() {
    at_.message = to_string(Outcome::stopped);
    at_.lost += iterations_;
    if (settings_.journal) settings_.journal->stop();
    return result();
  }

  PathResult result() const {
    PathResult path{at_.state, at_.reached, at_.complete, at_.increments, at_.lost, at_.crept, at_.slid, at_.message};
    scene_.look(path.state);
    return path;
  }

  Scene& scene_;
  const Homotopy& homotopy_;
  const PathSettings& settings_;
  const IterationSink& sink_;
  PathRecord at_;
  int failures_ = 0;    ///< in a row
  bool creeps_ = false; ///< the next attempt does
  bool in_vain_ = false;  ///< it did, since the last state
  int iterations_ = 0;  ///< of the last attempt
};

}  // namespace

Homotopy tightening(double from, double to) {
  return [=](State& state, double t) { state.load = from + t * (to - from); };
}

Homotopy hardening() {
  return [](State& state, double t) {
    state.load = 1.0;
    state.yielding = t < 1.0 ? softest * std::pow(1e-2, t) : 0.0;
  };
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

Homotopy posing(int k) {
  return [=](State& state, double t) { state.posture = t < 1.0 ? k - 1 + t : k; };
}

Homotopy without_friction() {
  return [](State& state, double) { state.load = state.release = 1.0; };
}

PathResult follow_path(Scene& scene, State start, const Homotopy& homotopy, const PathSettings& settings,
                       const IterationSink& sink) {
  return Walk(scene, std::move(start), homotopy, settings, sink).follow();
}

}  // namespace snug::solver
