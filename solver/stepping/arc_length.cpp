#include "solver/stepping/arc_length.hpp"

#include <algorithm>
#include <cmath>

namespace snug::solver {

namespace {

constexpr double usual_iterations = 5.0;  // at which the length stays as it is

/// The walk along one curve: where it stands, where it came from and how long the next increment is.
class Curve {
 public:
  Curve(Scene& scene, const State& start, const State& origin, const ArcSettings& settings, const IterationSink& sink)
      : scene_(scene), settings_(settings), sink_(sink), at_(start) {
    came_ = positions(start.values - origin.values);
    length_ = 0.1 * came_.norm();
  }

  ArcResult follow() {
    ArcResult result{{at_, at_.load, false, 0, ""}, at_};
    int failures = 0;
    while (result.path.increments < settings_.increments) {
      const State before = at_;
      const Outcome outcome = increment(result.path.increments + 1);
      if (outcome != Outcome::converged) {
        result.path.message = to_string(outcome);
        if (++failures > settings_.failures) break;
        length_ *= 0.5;
        continue;
      }
      failures = 0, ++result.path.increments;
      result.turned = result.turned || at_.load < before.load;
      if (at_.load > result.strongest.load) result.strongest = at_;
      if (settings_.accepted) settings_.accepted(scene_, at_, result.path.increments);
      const bool full = at_.load >= 1.0;
      if (full && before.load < 1.0) at_ = between(before, at_);
      if ((full && finish(result)) || (settings_.stop && settings_.stop(at_))) {
        result.path.complete = true, result.path.message.clear();
        break;
      }
    }
    if (!result.path.complete && result.path.message.empty()) result.path.message = "too many increments";
    result.path.state = at_, result.path.reached = at_.load;
    if (at_.load > result.strongest.load) result.strongest = at_;
    scene_.update(at_);
    return result;
  }

 private:
  Eigen::VectorXd positions(const Eigen::VectorXd& values) const { return values.head(scene_.layout().pressure(0)); }

  /// a and b of the system above at a state that is assembled.
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
    if (!started_ && length_ == 0.0) length_ = 0.05 * along.norm();
    const double forwards = !started_ || along.dot(came_) >= 0.0 ? 1.0 : -1.0, ds = forwards * length_ / along.norm();
    if (started_ && forwards * along.dot(came_) < std::cos(settings_.longest_turn) * along.norm() * came_.norm() && number > turned_at_) {
      turned_at_ = number;  // once an increment: a kink is none the less
      return Outcome::no_progress;
    }
    state.values += ds * b, state.load += ds;
    int taken = 0;
    const Outcome outcome = correct(state, number, taken);
    if (outcome != Outcome::converged) return outcome;
    scene_.commit(state);
    came_ = positions(state.values - at_.values);
    at_ = state, started_ = true;
    length_ *= std::clamp(std::sqrt(usual_iterations / std::max(1, taken)), 0.5, 1.5);
    return outcome;
  }

  Outcome correct(State& state, int number, int& taken) {
    postproc::Iteration row;
    row.increment = number, row.step = 1.0;
    for (taken = 0; taken <= settings_.iterations; ++taken) {
      scene_.update(state);
      if (!scene_.assemble(state, Tangent::full)) return Outcome::inadmissible;
      const Check now = check(scene_, state, settings_.newton);
      row.iteration = taken, row.load = state.load, row.residual = now.residual;
      sink_(row);
      const Eigen::VectorXd gone = positions(state.values - at_.values);
      const double off = 0.5 * (gone.squaredNorm() - length_ * length_);
      if (now.done && std::abs(off) <= 1e-6 * length_ * length_) return Outcome::converged;
      if (!(now.residual < 1e6)) return Outcome::no_progress;
      Eigen::VectorXd a, b;
      if (!solve(state, a, b)) return Outcome::linear_solver_failed;
      const double ds = -(off + gone.dot(positions(a))) / gone.dot(positions(b));
      const Eigen::VectorXd step = a + ds * b;
      row.step = scene_.step_bound(state, step);
      state.values += row.step * step, state.load += row.step * ds;
    }
    return Outcome::too_many_iterations;
  }

  /// Where the chord of two states crosses full load.
  static State between(const State& before, const State& after) {
    State state = after;
    state.values = before.values + (1.0 - before.load) / (after.load - before.load) * (after.values - before.values);
    state.load = 1.0;
    return state;
  }

  /// The answer at full load, from near it.
  bool finish(ArcResult& result) {
    State state = at_;
    const Outcome outcome = newton(scene_, state, settings_.newton, [&](postproc::Iteration row) {
      row.increment = result.path.increments + 1;
      sink_(row);
    });
    ++result.path.increments;
    if (outcome != Outcome::converged) {
      result.path.message = to_string(outcome);
      return false;
    }
    scene_.commit(state);
    at_ = state;
    return true;
  }

  Scene& scene_;
  const ArcSettings& settings_;
  const IterationSink& sink_;
  State at_;
  Eigen::VectorXd came_;   ///< of the positions in the last increment
  double length_ = 0.0;    ///< m, over all positions
  int turned_at_ = 0;
  bool started_ = false;
};

}  // namespace

ArcResult follow_arc(Scene& scene, const State& start, const State& origin, const ArcSettings& settings, const IterationSink& sink) {
  return Curve(scene, start, origin, settings, sink).follow();
}

}  // namespace snug::solver
