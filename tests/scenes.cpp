#include "tests/scenes.hpp"

namespace snug::tests {

solver::Meshes meshes_of(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment) {
  solver::Meshes meshes;
  meshes.body = body;
  if (!garment.pattern.empty()) meshes.garments = {garment};
  return meshes;
}

solver::Scene make_scene(const input::Case& c, const solver::Meshes& meshes, solver::Skin skin, std::optional<double> prestretch) {
  return solver::make_scene(solver::make_model(c, meshes.body), meshes, skin, prestretch);
}

solver::Scene make_scene(const input::Case& c, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, solver::Skin skin,
                         std::optional<double> prestretch) {
  return make_scene(c, meshes_of(body, garment), skin, prestretch);
}

solver::Layout make_layout(const mesh::BodyMesh& body, const mesh::GarmentMesh& garment, bool deformable, bool contact) {
  solver::Layout layout;
  if (deformable) solver::add_positions(layout, "body", body);
  if (!garment.pattern.empty()) layout.add({.name = "garment", .count = static_cast<int>(garment.pattern.size()), .components = 3});
  if (deformable) solver::add_pressures(layout, "body", body);
  if (contact) solver::add_multipliers(layout, "contact", static_cast<int>(solver::garment_slave(layout["garment"], garment).vertices()));
  return layout;
}

solver::State placed_state(const solver::Layout& layout, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment) {
  return solver::placed_state(layout, meshes_of(body, garment));
}

void fill_result(const solver::Scene& scene, const solver::State& state, const solver::Meshes& meshes, postproc::RunResult& result) {
  solver::fill_result(scene, state, {}, meshes, result);
}

void fill_result(const solver::Scene& scene, const solver::State& state, const mesh::BodyMesh& body, const mesh::GarmentMesh& garment,
                 postproc::RunResult& result) {
  fill_result(scene, state, meshes_of(body, garment), result);
}

postproc::RunResult solve(const input::Case& c, const solver::Meshes& meshes) {
  return solver::solve(solver::make_model(c, meshes.body), meshes);
}

solver::Plan plan(const input::Case& c, const solver::Meshes& meshes) {
  return solver::plan(solver::make_model(c, meshes.body), meshes);
}

}  // namespace snug::tests
