// The minimum of an energy: for states on the way, on which contact yields.
#pragma once

#include "solver/stepping/newton.hpp"

namespace snug::solver {

/// Finds the state at state.load where the forces vanish, from far away: Newton's method whose tangent is made positive definite by its
/// convex part and, where that does not do, by the proximal term (Levenberg 1944; Marquardt 1963), with steps that end before the slope
/// along them has turned. Where contact yields (State::yielding) pressures follow from the positions and no set of vertices is to be
/// found, so that nothing circles. The last iterate stays in `state`.
Outcome minimise(Scene& scene, State& state, const NewtonSettings& settings, const IterationSink& sink);

}  // namespace snug::solver
