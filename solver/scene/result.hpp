// From a state to plain result data.
#pragma once

#include "mesh/body/body_mesh.hpp"
#include "mesh/garment/garment_mesh.hpp"
#include "postproc/result.hpp"
#include "solver/scene/scene.hpp"

namespace snug::solver {

/// Reference geometry, names and zero fields of the body (skin only when `cells` is false).
postproc::BodyResult body_result(const mesh::BodyMesh& mesh, bool cells);

/// Fills displacement, stress, contact samples, skin pressure, garment fields, balance and `numbers` from the state.
void fill_result(const Scene& scene, const State& state, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                 postproc::RunResult& result);

/// Counts a force that acts on the garment at `at` and, opposite, on the skin. On a rigid skin its support answers.
void add_action(const Eigen::Vector3d& force, const Eigen::Vector3d& at, bool deformable, postproc::Balance& balance);

}  // namespace snug::solver
