#include "solver/stepping/arc_length.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace snug::solver {

namespace {

constexpr double usual_iterations = 4.0;  // at which the length stays as it is
constexpr double first_by_load = 0.05;

/// The walk along one curve: where it stands, where it came from and how long the next increment is.
class Curve {
 public:
  Curve(Scene& scene, const State& start, const State& origin, const ArcSettings& settings, const IterationSink& sink)
      : scene_(scene), settings_(settings), sink_(sink), at_(start) {
    came_ = positions(start.values - origin.values);
    length_ = 0.05 * came_.norm();
    longest_ = settings.longest > 0.0 ? settings.longest * length_ : std::numeric_limits<double>::max();
    result_.path.state = result_.strongest = start;
    loads_ = {{0.0, start.load}};
  }

  ArcResult follow() {
    for (int failures = 0; result_.path.increments < settings_.increments;) {
      const State before = at_;
      const Outcome outcome = increment(result_.path.increments + 1);
      if (outcome != Outcome::converged) {
        result_.path.message = to_string(outcome);
        if (++failures > settings_.failures) return leave();
        length_ *= 0.5;
        continue;
      }
      failures = 0, ++result_.path.increments;
      note();
      if (settings_.accepted) settings_.accepted(scene_, at_, result_.path.increments);
      if (settings_.stop && settings_.stop(at_)) result_.path.complete = true;
      if (at_.load >= 1.0 && before.load < 1.0) finish(before);
      if (result_.path.complete) return leave();
    }
    result_.path.message = "too many increments";
    return leave();
  }

 private:
  Eigen::VectorXd positions(const Eigen::VectorXd& values) const { return values.head(scene_.layout().positions()); }

  /// Keeps the load over the arc, and finds where it falls for the first time.
  void note() {
    loads_.emplace_back(loads_.back().first + came_.norm(), at_.load);
    if (result_.limit_load) return;
    const std::size_t n = loads_.size();
    if (loads_[n - 1].second >= loads_[n - 2].second) {
      result_.strongest = at_;
    } else {
      result_.limit_load = top();
    }
  }

  /// The largest value of the polynomial through the last states, up to four, between the last three of them.
  double top() const {
    const std::size_t n = loads_.size();
    const std::size_t first = n > 4 ? n - 4 : n > 3 ? 1 : 0;  // the state that the curve starts from is of another path
    double largest = loads_[n - 2].second;
    for (int k = 1; k < 1000; ++k) {
      const double from = loads_[n > 2 ? n - 3 : 0].first, l = from + 1e-3 * k * (loads_[n - 1].first - from);
      double value = 0.0;
      for (std::size_t i = first; i < n; ++i) {
        double weight = loads_[i].second;
        for (std::size_t j = first; j < n; ++j)
          if (j != i) weight *= (l - loads_[j].first) / (loads_[i].first - loads_[j].first);
        value += weight;
      }
      largest = std::max(largest, value);
    }
    return largest;
  }

  /// a and b of the system in the header at a state that is assembled.
  bool solve(const State& state, Eigen::VectorXd& a, Eigen::VectorXd& b) {
    if (!scene_.solve(state, Tangent::full, 1e-12, {}, a).ok) return false;
    State more = state;
    more.load += 1.0;  // loads are linear in s
    return scene_.respond(state, scene_.load_forces(more) - scene_.load_forces(state), b);
  }

  Outcome increment(int number) {
    State state = at_;
    scene_.renew(state);
    scene_.update(state);
    if (!scene_.assemble(state, Tangent::full)) return Outcome::inadmissible;
    Eigen::VectorXd a, b;
    if (!solve(state, a, b)) return Outcome::linear_solver_failed;
    const Eigen::VectorXd along = positions(b);
    const bool backwards = result_.path.increments > 0 && along.dot(came_) < 0.0;
    const double ds = (backwards ? -1.0 : 1.0) * length_ / along.norm();
    state.values += scene_.step_bound(state, ds * b) * ds * b, state.load += ds;
    int taken = 0;
    const Outcome outcome = correct(state, number, taken);
    if (outcome != Outcome::converged) return outcome;
    scene_.commit(state);
    came_ = positions(state.values - at_.values);
    at_ = state;
    length_ = std::min(length_ * std::clamp(std::sqrt(usual_iterations / std::max(1, taken)), 0.5, 1.5), longest_);
    return outcome;
  }

  Outcome correct(State& state, int number, int& taken) {
    postproc::Iteration row;
    row.increment = number, row.step = 1.0;
    for (taken = 0; taken <= settings_.iterations; ++taken) {
      scene_.update(state);
      if (!scene_.assemble(state, Tangent::full)) return Outcome::inadmissible;
      State full = state;  // the load passes through zero, and is no measure of the residual there
      full.load = 1.0;
      const Check now = check(scene_, full, settings_.newton);
      row.iteration = taken, row.load = state.load, row.residual = now.residual;
      sink_(row);
      const Eigen::VectorXd gone = positions(state.values - at_.values);
      const double off = 0.5 * (gone.squaredNorm() - length_ * length_);
      if (now.done && std::abs(off) <= 1e-6 * length_ * length_) return Outcome::converged;
      Eigen::VectorXd a, b;
      if (!solve(state, a, b)) return Outcome::linear_solver_failed;
      const double ds = -(off + gone.dot(positions(a))) / gone.dot(positions(b));
      const Eigen::VectorXd step = a + ds * b;
      if (!std::isfinite(ds) || !(positions(step).norm() < 2.0 * length_)) return Outcome::no_progress;
      row.step = scene_.step_bound(state, step);
      state.values += row.step * step, state.load += row.step * ds;
    }
    return Outcome::too_many_iterations;
  }

  /// The answer at full load, from where the chord of the last increment crosses it.
  void finish(const State& before) {
    State state = at_;
    state.values = before.values + (1.0 - before.load) / (at_.load - before.load) * (at_.values - before.values);
    state.load = 1.0;
    ++result_.path.increments;
    const Outcome outcome = newton(scene_, state, settings_.newton, [&](postproc::Iteration row) {
      row.increment = result_.path.increments;
      sink_(row);
    });
    if (outcome != Outcome::converged) return;  // the curve goes on, and may cross full load once more
    scene_.commit(state);
    at_ = state;
    result_.path.complete = true;
  }

  ArcResult leave() {
    if (result_.path.complete) result_.path.message.clear();
    if (!result_.limit_load) result_.strongest = at_;
    result_.path.state = at_, result_.path.reached = at_.load;
    return result_;
  }

  Scene& scene_;
  const ArcSettings& settings_;
  const IterationSink& sink_;
  State at_;
  ArcResult result_;
  Eigen::VectorXd came_;   ///< what the positions did in the last increment, m
  double length_, longest_;  ///< m, over all positions
  std::vector<std::pair<double, double>> loads_;  ///< over the arc, m
};

}  // namespace

ArcResult follow_arc(Scene& scene, const State& start, const State& origin, const ArcSettings& settings, const IterationSink& sink) {
  return Curve(scene, start, origin, settings, sink).follow();
}

LoadedPath follow_load(Scene& scene, const State& placed, bool along_curve, const PathSettings& settings, const IterationSink& rows,
                       const IterationSink& curve_rows) {
  const double to = along_curve ? first_by_load : 1.0;
  PathSettings by_load = settings;
  by_load.intermediate_residual = std::min(settings.intermediate_residual, 1e-6);  // looser states creep past the largest load
  by_load.lost_iterations = std::min(settings.lost_iterations, 100);               // there is the curve
  LoadedPath loaded{follow_path(scene, placed, tightening(0.0, to), by_load, rows), {}};
  PathResult& path = loaded.path;
  path.reached *= to;
  const bool loads = std::any_of(scene.terms().begin(), scene.terms().end(), [](const auto& term) { return term->is_load(); });
  if (!loads || path.increments == 0 || scene.supports().move() || (path.complete && !along_curve)) return loaded;
  ArcSettings arc;
  arc.newton = settings.newton;
  arc.increments = along_curve ? 200 : 60;
  if (settings.accepted)
    arc.accepted = [&](const Scene& parts, const State& state, int increment) {
      settings.accepted(parts, state, path.reached + (1.0 - path.reached) * increment / (increment + 1.0));
    };
  const int before = path.increments;
  const ArcResult curve = follow_arc(scene, path.state, placed, arc, [&](postproc::Iteration row) {
    row.increment += before;
    curve_rows(row);
  });
  loaded.limit_load = curve.limit_load;
  path.increments += curve.path.increments;
  path.complete = curve.path.complete;
  path.state = curve.path.complete ? curve.path.state : curve.strongest;
  path.reached = path.state.load;
  if (path.complete) path.message.clear();
  else if (curve.limit_load)
    path.message = fmt::format("the load has a largest value there, {:.5g} of the whole, and falls beyond it", *curve.limit_load);
  else
    path.message = curve.path.message;
  return loaded;
}

}  // namespace snug::solver
