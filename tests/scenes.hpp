// Scenes of one body and one garment, put together from a case or in code.
#pragma once

#include "solver/scene/result.hpp"
#include "solver/scene/scene.hpp"
#include "solver/stepping/load_path.hpp"

namespace snug::tests {

/// A body, and a garment where it has triangles.
solver::Meshes meshes_of(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment);

solver::Scene make_scene(const input::Case& c, const solver::Meshes& meshes, solver::Skin skin, std::optional<double> prestretch = {});
solver::Scene make_scene(const input::Case& c, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, solver::Skin skin,
                         std::optional<double> prestretch = {});

/// "body" where it is deformable, "garment" where there is one, the body's pressures, "contact".
solver::Layout make_layout(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, bool deformable, bool contact);

solver::State placed_state(const solver::Layout& layout, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment);

void fill_result(const solver::Scene& scene, const solver::State& state, const solver::Meshes& meshes, postproc::RunResult& result);
void fill_result(const solver::Scene& scene, const solver::State& state, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                 postproc::RunResult& result);

postproc::RunResult solve(const input::Case& c, const solver::Meshes& meshes);
solver::Plan plan(const input::Case& c, const solver::Meshes& meshes);

}  // namespace snug::tests
