// Semismooth Newton on one increment.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "postproc/result.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

struct NewtonSettings {
  double residual = 1e-9;         ///< |R| over the sum of contact forces
  double complementarity = 1e-8;  ///< over the mean contact pressure
  double penetration = 1e-9;      ///< m, weighted gap of nodes in contact
  double volume = 1e-10;          ///< relative volume error of a pressure
  int iterations = 30;
  double proximal = 1e-4;         ///< times the relative residual; vanishes at convergence, so it leaves no bias
  double convex_above = 0.02;     ///< relative residual above which only the convex part of the tangent is used
  bool recut = false;             ///< renews the quadrature of contact near the solution, so that it is that of the answer
                                  ///< and not of the state that the increment started from
  bool minimum = false;           ///< what is found must be a minimum on its constraints, by the inertia of the tangent
  std::function<bool()> stop = {};  ///< asked after every iteration; true: the user wants no more
  bool cuts = false;              ///< steps are cut where they lead uphill, also where cloth bends
  bool may_lag = false;           ///< solve with the last factor near the solution: pays where a body is factored
};

enum class Outcome { converged, stopped, no_progress, too_many_iterations, linear_solver_failed, saddle, inadmissible };
std::string to_string(Outcome outcome);

/// How far a state is from an answer.
struct Check {
  Measure measure;
  double residual, complementarity, round_off;
  double condensed;  ///< the residual with volumes and pressures of cells brought in
  bool in_place;     ///< every moved support stands where it should
  bool done;
};
Check check(const Scene& scene, const State& state, const NewtonSettings& settings);

using IterationSink = std::function<void(const postproc::Iteration&)>;

/// Solves at state.load from `state`; the last iterate stays in `state` (the caller keeps a copy to go back to).
Outcome newton(Scene& scene, State& state, const NewtonSettings& settings, const IterationSink& sink);

}  // namespace snug::solver
