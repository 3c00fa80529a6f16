#include "solver/stepping/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/stepping/acceleration.hpp"

namespace snug::solver {

std::string to_string(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged: return "converged";
    case Outcome::stopped: return "the user wants no more";
    case Outcome::no_progress: return "the iteration makes no progress";
    case Outcome::too_many_iterations: return "too many iterations";
    case Outcome::linear_solver_failed: return "the linear solver failed";
    case Outcome::saddle: return "the equilibrium found is no minimum of the energy: it would buckle, or skin and garment swing between each other's nodes";
    case Outcome::inadmissible: return "an inverted cell could not be avoided";
  }
  return "";
}

namespace {

// Takes as much of the step as is admissible; every trial is a copy of the state. False: nothing is.
bool move(Scene& scene, State& state, const Eigen::VectorXd& step, double& fraction) {
  const State start = state;
  for (int halving = 0; halving < 10; ++halving, fraction *= 0.5) {
    state = start;
    state.values += fraction * step;
    scene.update(state);
    if (scene.assemble(state, Tangent::full)) return true;
  }
  state = start;
  return false;
}

// Along a step that leads downhill, how far the positions go; pressures and multipliers take their whole step. With those as
// they will be, the forces along the step are the slope of an energy, and a step may end where that slope has turned upwards by
// at most half of what it was at the start (unless that was `round_off`, N, of the balance). A membrane without tension has no stiffness across itself, and one that is much stiffer in
// shear than in tension wrinkles and unfolds at every iterate, so that whole steps are far too long. Not for what bends: the
// strip of the heavy elastica turns far in whole steps, which first go uphill, and hardly in cut ones. False: nothing but
// inadmissible states.
bool descend(Scene& scene, State& state, const Eigen::VectorXd& step, double round_off, double& fraction) {
  const State start = state;
  const Eigen::Index dual = step.size() - scene.layout().positions();
  Eigen::VectorXd positions = step;
  positions.tail(dual).setZero();
  state.values.tail(dual) += step.tail(dual);
  const State ahead = state;
  if (scene.saddle_rows() > 0) scene.assemble(ahead, Tangent::none);
  const double slope = scene.slope(positions);
  const bool downhill = slope < -round_off * positions.norm();
  bool admissible = false, there = false;
  for (int cut = 0; cut < 20 && !there; ++cut) {
    const Tangent tangent = cut == 0 ? Tangent::full : Tangent::none;  // the whole step is good most times
    state = ahead;
    state.values += fraction * positions;
    scene.update(state);
    admissible = scene.assemble(state, tangent);
    if (!admissible) {
      fraction *= 0.5;
      continue;
    }
    const double end = scene.slope(positions);
    there = !downhill || end <= -0.5 * slope;
    if (there && cut == 0) return true;
    if (!there) fraction *= std::clamp(-slope / (end - slope), 0.2, 0.7);
  }
  if (admissible && scene.assemble(state, Tangent::full)) return true;
  state = start;
  return false;
}

// Residual below which the answer is near enough for the quadrature to be cut for good.
constexpr double near = 1e-3;
// Residual above which the tangent changes too much from step to step for the inertia of an earlier one to count.
constexpr double far = 0.1;
// Vertices that come or go while the last factor still does for the others: each costs FGMRES an iteration or two.
constexpr int few_vertices = 200;  // one in so many
// Tolerance of the solves of an increment that others go on from. Its end is not solved to the last digit, and friction remembers
// where it was: what such a solve leaves is left in the answer.
constexpr double on_the_way = 1e-6;
// Tolerance of a solve that takes a lagged factor more than half of the iterations it is allowed.
constexpr double long_solve = 1e-5;
// Reduction of the residual by a step of Newton's method that converges quadratically.
constexpr double fast = 0.1;
// Steps in a row that bring the residual down by less, near the answer, are worth mixing: frames of friction are followed, not solved for,
// and the convex part of a tangent is not the tangent (a knee bent by 45 degrees: 0.79 an iteration along one motion). One slow step
// alone is mostly a corner that sticks or slips.
constexpr double slow = 0.5;
constexpr int worth_mixing = 3;
// Reduction by a step of an iteration that is let go on for as long as it does.
constexpr double comes_to_rest = 0.5;

// How exactly a step is worth solving for: the square of what the last step brought, with a factor of safety (Eisenstat &
// Walker, SIAM J. Sci. Comput. 17 (1996), choice 2: gamma = 0.3, alpha = 2), which keeps quadratic convergence and spends
// little where friction's is linear; of the order of the residual (choice 1's limit) where convergence is fast anyway; tighter
// while vertices still come and go, so that they do not follow its errors, and far from the answer (at 2e-2 a fabric 100 times too
// stiff on a thigh takes 115 iterations instead of 54).
// The last factor is tried wherever its inertia speaks for the present tangent: it was of a minimum, and since then the residual
// has come down and few vertices have come or gone. Whether it still does is for the linear solver to see by its contraction. The
// residual that counts here is the condensed one: forces balance under carried pressures while volumes are still wrong.
Lag forcing(const NewtonSettings& settings, double residual, double reduction, bool settled, int changed) {
  const double loosest = !settings.recut ? on_the_way : changed > 0 || residual > near ? 1e-4 : 2e-2;
  const double wanted = reduction < fast ? 0.1 * residual : 0.3 * reduction * reduction;
  return {settings.may_lag && settled && residual < far, std::clamp(wanted, 1e-10, loosest)};
}

// A step towards lower energy: where the full tangent is not positive definite on the constraints (more negative pivots
// than pressures and multipliers), its convex part takes over; `full` tells which it was.
LinearReport descent(Scene& scene, const State& state, const NewtonSettings& settings, double residual, const Lag& lag,
                     double proximal, Eigen::VectorXd& step, bool& full) {
  const Tangent tangent = residual > settings.convex_above ? Tangent::convex : Tangent::full;
  full = tangent == Tangent::full;
  if (tangent == Tangent::convex) scene.assemble(state, tangent);
  LinearReport report = scene.solve(state, tangent, proximal, lag, step, full && residual < near && !settings.cuts);
  const bool indefinite = report.ok && report.negative_pivots > scene.saddle_rows();
  if (!indefinite || !full) return report;
  full = false;
  scene.assemble(state, Tangent::convex);
  return scene.solve(state, Tangent::convex, proximal, {}, step);
}

// What is known of the inertia of the full tangent near the answer. A minimum on its constraints has as many negative pivots
// as pressures and multipliers (Gould, Math. Programming 32 (1985)); more of them, and the energy falls along some motion.
enum class Stationary { unknown, minimum, saddle };

Stationary kind(const LinearReport& report, const Scene& scene) {
  return report.negative_pivots > scene.saddle_rows() ? Stationary::saddle : Stationary::minimum;
}

// The last factor near the answer tells; where there is none, one more is made. A saddle is one only by a factor in double
// precision: a tangent that is nearly singular may have one negative pivot too many in single.
Stationary kind_at_end(Scene& scene, const State& state, Stationary known) {
  if (known == Stationary::minimum) return known;
  Eigen::VectorXd none;
  LinearReport report = scene.solve(state, Tangent::full, 1e-12, {}, none);
  if (report.ok && report.single_precision && kind(report, scene) == Stationary::saddle) {
    scene.assemble(state, Tangent::full);
    report = scene.solve(state, Tangent::full, 1e-12, {.precise = true}, none);
  }
  return report.ok ? kind(report, scene) : Stationary::unknown;
}

// Globalisation: a step after which the residual is this many times larger, and larger than all contact forces (a vertex
// that comes or goes explains less), is taken back and repeated with a stronger proximal term (Levenberg's damping on the
// garment, whose slack parts have no stiffness of their own).
constexpr double too_much_growth = 10.0, largest_boost = 1e6;

// Far from the solution for long: eight iterations without a residual a fifth lower than the best one before; sixteen where
// it was near and is so no more. Iterations that
// `stride` down an energy do not count, for the residual may well rise on the way: a sheet that wrinkles takes twenty so. Steps that are cut
// get on by less: they may take some `more`.
class Patience {
 public:
  bool lost(const Check& now, int iteration, bool stride, int more = 0) {
    if (iteration == 0 || !now.in_place) return false;  // what the load or a support will ask for is not in the balance yet
    const double residual = now.residual;
    if (residual < 0.8 * best_) best_ = residual, waited_ = 0;
    if (!stride) ++waited_;
    return waited_ > (best_ > near ? 8 : 16) + more && std::max(best_, residual) > near;
  }

 private:
  double best_ = std::numeric_limits<double>::max();
  int waited_ = 0;
};
constexpr double long_stride = 0.2;  // of a Newton step
constexpr int cut_steps_more = 12;

}  // namespace

Check check(const Scene& scene, const State& state, const NewtonSettings& settings) {
  Check c;
  c.measure = scene.measure(state);
  const double force = std::max(c.measure.contact_force, c.measure.smallest_force), pressure = c.measure.pressure_scale;
  const double residual = scene.force_residual();
  c.residual = force > 0.0 ? residual / force : (residual != 0.0 ? 1.0 : 0.0);  // NaN stays an error: it is not 0
  c.condensed = force > 0.0 ? scene.condensed_residual() / force : c.residual;
  c.complementarity = pressure > 0.0 ? c.measure.complementarity / pressure : 0.0;
  const Eigen::VectorXd gap = scene.supports().gap(state);  // that a prescribed entry has yet to go, m
  c.in_place = gap.size() == 0 || gap.cwiseAbs().maxCoeff() <= 1e-15 * scene.farthest(state);
  c.round_off = scene.round_off(state);
  const bool balanced = c.residual <= settings.residual || residual <= c.round_off;
  c.done = c.in_place && balanced && c.complementarity <= settings.complementarity &&
           c.measure.volume_error <= settings.volume && c.measure.penetration <= settings.penetration && c.measure.changed == 0;
  return c;
}

Outcome newton(Scene& scene, State& state, const NewtonSettings& settings, const IterationSink& sink) {
  scene.renew(state);
  scene.update(state);
  if (!scene.assemble(state, Tangent::full)) return Outcome::inadmissible;
  postproc::Iteration row;
  row.load = state.load;
  row.step = 1.0;
  Patience patience;
  State last = state;
  double before = std::numeric_limits<double>::max(), condensed_before = before, boost = 1.0;
  Stationary known = Stationary::unknown;
  bool convex_factor = false;  // the last factor was of this increment's convex tangent, and of a minimum; a run that is resumed has none of an increment before
  bool in_place = true, cut = !settings.recut || !scene.renews_near_answer();
  const bool downhill = !scene.bends() || settings.cuts, constrained = scene.saddle_rows() > 0;
  Acceleration acceleration(scene.layout().positions());
  bool mixed = false;  // the last step was
  int slow_steps = 0;
  const bool damped = (scene.bends() || constrained) && scene.damped();  // without a proximal term a step would be the same again
  for (int iteration = 0;; ++iteration) {
    Check now = check(scene, state, settings);
    if (!cut && now.residual < near && now.measure.changed == 0) {
      cut = true;
      acceleration.forget();
      scene.renew(state);
      scene.update(state);
      if (!scene.assemble(state, Tangent::full)) return Outcome::inadmissible;
      now = check(scene, state, settings);
    }
    row.iteration = iteration;
    row.residual = now.residual, row.complementarity = now.complementarity;
    row.contact_nodes = now.measure.active, row.changed = now.measure.changed;
    row.energy = now.done ? scene.energy(state) : std::numeric_limits<double>::quiet_NaN();
    sink(row);
    if (now.done)
      return settings.minimum && kind_at_end(scene, state, known) == Stationary::saddle ? Outcome::saddle : Outcome::converged;
    if (settings.stop && settings.stop()) return Outcome::stopped;
    if (patience.lost(now, iteration, downhill && !constrained && row.step >= long_stride, settings.cuts ? cut_steps_more : 0)) return Outcome::no_progress;
    const int most = now.residual < near ? 3 * settings.iterations / 2 : settings.iterations;  // what is near is not given up for a few
    const bool comes = now.measure.changed == 0 && now.condensed < comes_to_rest * condensed_before;
    if (iteration >= most && !comes) return Outcome::too_many_iterations;
    const bool settled = now.measure.changed <= now.measure.active / few_vertices && now.condensed < 0.9 * condensed_before &&
                         (scene.factor_is_of_minimum() || convex_factor);
    const double reduction = now.condensed / condensed_before;
    const bool too_far = damped && in_place && now.residual > std::max(1.0, too_much_growth * before);
    if (too_far && boost < largest_boost) {  // hold back and repeat; what contact has seen on the way is kept (a taper: 44 iterations, not 188)
      state.values = last.values;
      scene.update(state);
      if (!scene.assemble(state, Tangent::full)) return Outcome::inadmissible;
      boost *= 30.0;
    } else {
      last = state;
      before = now.residual, condensed_before = now.condensed;
      in_place = now.in_place;  // the step that moves supports is the load: its residual is no growth
      boost = std::max(1.0, boost / 5.0);
    }
    Eigen::VectorXd step;
    const double proximal = settings.proximal * boost * std::min(1.0, before) + 1e-12;
    Lag lag = forcing(settings, now.condensed, reduction, settled, now.measure.changed);
    // The end will ask for a factor near the answer: made where solves begin to be long, it serves both.
    if (settings.minimum && known == Stationary::unknown && now.condensed < near && lag.tolerance < long_solve) lag.allowed = false;
    bool full = false;
    const LinearReport report = descent(scene, state, settings, before, lag, proximal, step, full);
    if (!report.ok) return Outcome::linear_solver_failed;
    if (report.refactored) convex_factor = !full && kind(report, scene) == Stationary::minimum;
    if (report.refactored) known = condensed_before < near && full ? kind(report, scene) : Stationary::unknown;
    row.event = report.refactored ? "" : "lagged";
    const bool steady = in_place && now.measure.changed == 0 && now.condensed < near && row.step == 1.0;
    if (!steady || (mixed && reduction > 1.0)) acceleration.forget();
    if (steady) acceleration.see(state.values, step);
    slow_steps = steady && reduction > slow ? slow_steps + 1 : 0;
    mixed = steady && (mixed ? reduction > fast : slow_steps >= worth_mixing);
    if (mixed) step = acceleration.mixed(step);
    row.step = scene.step_bound(state, step);
    const bool moved = downhill && in_place ? descend(scene, state, step, now.round_off, row.step) : move(scene, state, step, row.step);
    if (!moved) return Outcome::inadmissible;
  }
}

}  // namespace snug::solver
