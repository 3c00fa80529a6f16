// What a state of a movement says.
#pragma once

#include "postproc/result.hpp"
#include "solver/scene/movement.hpp"

namespace snug::solver {

/// The row of a state that is a share of the way to a posture (0: dressed), of its result with fields. `skin_cell`: mean edge of the skin's facets, m.
postproc::MovementState movement_state(const Movement& movement, int posture, double share, const postproc::RunResult& shot, double skin_cell);

/// Warns of postures in which the skin has gone through itself.
void look_at_movement(postproc::RunResult& result);

}  // namespace snug::solver
