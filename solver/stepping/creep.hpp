// Where no step leads on: cloth creeps to where it rests.
#pragma once

#include "solver/stepping/newton.hpp"

namespace snug::solver {

/// From a state that is no equilibrium under what `state` prescribes: steps against a drag (terms/drag.hpp) that falls as the cloth
/// comes to rest, friction following each of them, then Newton's method without it to `answer`. What buckles, or slides to
/// another place, gets there so where no path of equilibria leads on. The last state is in `state`. Gives up after `most` iterations.
Outcome creep(Scene& scene, State& state, const NewtonSettings& on_the_way, const NewtonSettings& answer, int most, const IterationSink& sink);

}  // namespace snug::solver
