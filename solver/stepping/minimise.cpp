#include "solver/stepping/minimise.hpp"

#include <algorithm>
#include <limits>

namespace snug::solver {

namespace {

// Of the proximal term, whose weights are of the order of the membrane's own stiffness.
constexpr double first_shift = 1e-3, least_shift = 1e-9, largest_shift = 1e3;
constexpr int most_iterations = 100, most_shifts = 12;
/// A step may end where the slope has turned upwards by this much of what it was.
constexpr double overshoot = 0.5;

struct Stride {
  double fraction = 1.0;  ///< of the step
  double turned = 0.0;    ///< slope at its end over the slope at its start, with the sign turned: -1 is as steep downhill as before
  bool moved = false;
};

/// Positions go down along `step`; pressures follow from them.
Stride go_down(Scene& scene, State& state, const Eigen::VectorXd& step, double longest, double round_off) {
  const State start = state;
  Eigen::VectorXd positions = step;
  positions.tail(step.size() - scene.layout().positions()).setZero();
  const double slope = scene.slope(positions);
  const bool downhill = slope < -round_off * positions.norm();
  Stride stride{.fraction = longest};
  for (int cut = 0; cut < 20; ++cut) {
    state = start;
    state.values += stride.fraction * positions;
    scene.update(state);
    if (!scene.assemble(state, cut == 0 ? Tangent::full : Tangent::none)) {
      stride.fraction *= 0.5;
      continue;
    }
    const double end = scene.slope(positions);
    stride.turned = downhill ? -end / slope : 0.0;
    if (stride.turned <= overshoot) {
      stride.moved = cut == 0 || scene.assemble(state, Tangent::full);
      return stride;
    }
    stride.fraction *= std::clamp(-slope / (end - slope), 0.1, 0.7);
  }
  state = start;
  scene.update(state);
  scene.assemble(state, Tangent::full);
  return stride;
}

/// Raises `shift` until the tangent is positive definite on the constraints. False: the linear solver failed.
bool definite_step(Scene& scene, const State& state, double& shift, Eigen::VectorXd& step) {
  for (int shifts = 0;; ++shifts) {
    const LinearReport report = scene.solve(state, shifts == 0 ? Tangent::full : Tangent::convex, shift, {}, step);
    if (!report.ok) return false;
    if (report.negative_pivots <= scene.saddle_rows() || shifts > most_shifts) return true;
    if (shifts > 0) shift *= 10.0;
    scene.assemble(state, Tangent::convex);
  }
}

}  // namespace

Outcome minimise(Scene& scene, State& state, const NewtonSettings& settings, const IterationSink& sink) {
  scene.renew(state);
  scene.update(state);
  if (!scene.assemble(state, Tangent::full)) return Outcome::inadmissible;
  double shift = first_shift;
  postproc::Iteration row;
  row.load = state.load;
  row.step = 1.0;
  for (int iteration = 0;; ++iteration) {
    const Check now = check(scene, state, settings);
    row.iteration = iteration;
    row.residual = now.residual, row.contact_nodes = now.measure.active;
    row.energy = std::numeric_limits<double>::quiet_NaN();
    sink(row);
    if (now.done) return Outcome::converged;
    if (settings.stop && settings.stop()) return Outcome::stopped;
    if (iteration >= most_iterations) return Outcome::too_many_iterations;
    Eigen::VectorXd step;
    if (!definite_step(scene, state, shift, step)) return Outcome::linear_solver_failed;
    const double longest = scene.step_bound(state, step);
    const Stride stride = go_down(scene, state, step, longest, now.round_off);
    row.step = stride.fraction;
    if (!stride.moved && shift >= largest_shift) return Outcome::no_progress;
    if (!stride.moved || stride.fraction < 0.4 * longest)
      shift = std::min(largest_shift, 4.0 * shift);
    else if (stride.fraction >= 0.9 * longest && stride.turned < 0.25)
      shift = std::max(least_shift, shift / (stride.turned < -0.7 ? 8.0 : 2.5));
  }
}

}  // namespace snug::solver
