// What friction adds to the result of a state.
#pragma once

#include "mesh/garment/garment_mesh.hpp"
#include "postproc/result.hpp"
#include "postproc/skin_pressure.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Adds friction to samples and balance, and the fields `shear_traction` and `slip` to garment and skin; `normal` is the
/// skin's pressure from the same samples. Nothing for a scene without friction.
void fill_friction(const Scene& scene, const State& state, const mesh::GarmentMesh& garment,
                   const postproc::SkinPressure& normal, postproc::RunResult& result);

}  // namespace snug::solver
