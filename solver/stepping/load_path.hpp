// A path of increments t = 0 ... 1 with step control and recovery.
#pragma once

#include "solver/stepping/newton.hpp"

namespace snug::solver {

class Journal;

/// Of the last state where cloth rubs: Newton's method converges linearly there, and its last step overshoots less than elsewhere.
constexpr double rubbing_residual = 1e-10;

struct PathSettings {
  double first_step = 1.0;      ///< the whole path; what fails is halved
  double intermediate_residual = 1e-3;
  bool leads_on = false;        ///< another stage goes on from the end, which then need not be better than any other state
  int failures = 8;             ///< halvings in a row before giving up
  int lost_iterations = 1000;   ///< of increments that failed, before giving up
  bool exact = false;           ///< states on the way are solved as the last one: each of them is an answer
  bool minimum = false;         ///< the answer must be a minimum on its constraints, by the inertia of the tangent
  bool creeps = false;          ///< where no step leads on cloth creeps (creep.hpp)
  double smallest_step = 2e-3;  ///< shorter steps than this are no progress
  double longest_step = 1.0;
  NewtonSettings newton;        ///< of the final increment
  std::function<void(const Scene&, const State&, double t)> accepted;  ///< called with every converged state; may be empty
  /// Brings a state's positions along to the place on the path that the other state has; may be empty. Predictions begin from what it makes of the last state.
  std::function<void(State& state, const State& to)> carry;
  Journal* journal = nullptr;   ///< keeps the path and knows what of it has been walked before; may be null
};

/// What changes along the path: puts the state at t in [0, 1].
using Homotopy = std::function<void(State& state, double t)>;
/// The garment tightens: s goes from `from` to `to`.
Homotopy tightening(double from = 0.0, double to = 1.0);
/// The same at once, on a skin that yields under the garment and hardens.
Homotopy hardening();
/// The body gives way under the tightened garment: its stiffness falls from `factor` times its own to its own.
Homotopy releasing(double factor);

/// The garment that stuck where it was placed is let go: friction's bound comes down to mu p.
Homotopy letting_go();
/// The coefficient of friction falls a hundredfold.
Homotopy fading();
/// The bones go from posture k - 1 to posture k.
Homotopy posing(int k);
/// Nothing changes but that friction is gone: the state is brought to full load.
Homotopy without_friction();

struct PathResult {
  State state = {};             ///< the last converged one
  double reached = 0.0;         ///< t of that state
  bool complete = false;        ///< t = 1 reached
  int increments = 0;
  int lost = 0;                 ///< iterations of increments that failed
  int crept = 0;                ///< iterations on which cloth crept
  double slid = 0.0;            ///< largest way of a node while it did, m
  std::string message = {};     ///< why not
};

/// Secant prediction, Newton, longer steps after success, shorter steps and a stronger proximal term after failure.
/// Always returns the last converged state. What a journal knows of the path is not solved again.
PathResult follow_path(Scene& scene, State start, const Homotopy& homotopy, const PathSettings& settings,
                       const IterationSink& sink);

}  // namespace snug::solver
