// What friction adds to the result of a state.
#pragma once

#include "postproc/result.hpp"
#include "postproc/skin_pressure.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Adds the friction of one garment to its samples and to the balance.
void add_friction(const Friction& friction, const Contact& contact, const State& state, bool deformable,
                  std::vector<postproc::ContactSample>& samples, postproc::Balance& balance);

/// `shear_traction` and `slip` of the skin, of all garments together; `normal` is its pressure from the same samples.
void fill_skin_friction(const postproc::SkinPressure& normal, postproc::RunResult& result);

}  // namespace snug::solver
