// Bodies of tetrahedra from scans, as the branching ones are made, against exact answers and balance.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/body/branching_body.hpp"
#include "mesh/body/scan.hpp"
#include "tests/unit/mesh/scanned_shapes.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

/// The tube of `TubeCase` as two scanned surfaces, skin and bone, cut out of longer ones.
struct ScannedTube {
  explicit ScannedTube(const TubeCase& tube, double cell_size)
      : skin(tests::tube({.radius = tube.radius, .length = tube.length + 2.0 * beyond, .around = 240, .along = 100}), "tube-skin"),
        bone(tests::tube({.radius = tube.bone, .length = tube.length + 2.0 * beyond, .around = 160, .along = 80}), "tube-bone") {
    description = describe_tube(tube);
    input::BodySpec& body = *description.body;
    body.kind = input::BodyKind::scan;
    body.scan.emplace();
    body.scan->surface = skin.path, body.scan->unit = 1.0, body.scan->cell_size = cell_size;
    body.scan->core.emplace().surface = bone.path;
    body.scan->cuts = {{"lower", {0, 0, beyond}, {0, 0, -1}, {}}, {"upper", {0, 0, beyond + tube.length}, {0, 0, 1}, {}}};
    description.garments.front().position = beyond;
    meshes.body = mesh::body_from_scan(body).mesh;
    meshes.limb = mesh::limb_from_skin(meshes.body, beyond, beyond + tube.length, {});
    const solver::Model model = solver::make_model(description, meshes.body);
    const auto fit = mesh::tube_fit(description.garments.front());
    meshes.garments.push_back(mesh::make_tube_mesh(description.garments.front(), meshes.limb, solver::worn_cell_size(model, 0, fit, meshes.limb, meshes.body),
                                                   solver::placing_lift(model, meshes.garments, fit)));
  }
  static constexpr double beyond = 0.04;
  ObjFile skin, bone;
  input::Case description;
  solver::Meshes meshes;
};

// Reference book 1.6 C, the row of TubeSleeve: radius 55 mm, bone 20 mm, neo-Hooke of 10 kPa and 0.49, sleeve of 1 kN/m from 44 mm.
TEST(ScannedBodies, ASleeveOnAScannedTubeOfTetrahedraHasTheExactPressure) {
  const ScannedTube scanned({.length = 0.020}, 0.009);
  const postproc::RunResult result = tests::solve(scanned.description, scanned.meshes);
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  const std::string source = "reference book 1.6 C, collocation";
  book("1.6 C sleeve, scanned tube of tetrahedra", "contact pressure, Pa", result.numbers.at("mean_contact_pressure_Pa"), 6202.61651745, 1e-3, source);
  book("1.6 C sleeve, scanned tube of tetrahedra", "displacement of the skin, m", result.numbers.at("mean_skin_radial_displacement_m"), (54.70582574868 - 55.0) * 1e-3, 2e-3, source);
}

input::Case pressed_trousers(const ObjFile& file) {
  input::Case c;
  c.title = "trunk and two legs under pressure";
  c.body.emplace();
  c.body->kind = input::BodyKind::scan;
  input::LayerSpec bone, tissue;
  bone.name = "bone", bone.material.name = "rigid", bone.form = input::LayerForm::rigid;
  tissue.name = "tissue", tissue.material.table = input::table_of("law = 'neo-Hooke'\nshear_modulus = '10 kPa'\npoisson_ratio = 0.49");
  c.body->layers = {bone, tissue};
  c.body->scan.emplace();
  c.body->scan->surface = file.path, c.body->scan->unit = 1.0, c.body->scan->cell_size = 0.024;
  c.body->scan->core.emplace().thickness = 0.03;
  c.body->scan->cuts = {{"waist", {0, 0, 0.6}, {0, 0, 1}, {}}, {"left", {0.08, 0, 0.15}, {0, 0, -1}, {}}, {"right", {-0.08, 0, 0.15}, {0, 0.2, -1}, {}}};
  c.load.emplace().skin_pressure = 1000.0;
  return c;
}

TEST(ScannedBodies, TrunkAndTwoLegsUnderPressureAreInBalanceThoughOneCutIsTilted) {
  const ObjFile file(trousers({}), "pressed-legs");
  const input::Case c = pressed_trousers(file);
  solver::Meshes meshes;
  meshes.body = mesh::body_from_scan(*c.body).mesh;
  const postproc::RunResult result = tests::solve(c, meshes);
  EXPECT_EQ(result.status, postproc::Status::converged) << result.message;
  double most = 0.0;
  for (const auto& [name, force] : result.balance.reactions) most = std::max(most, force.norm());
  EXPECT_LE(result.balance.force_error.norm(), 1e-8 * most);
  EXPECT_LE(result.balance.moment_error.norm(), 1e-8 * most);
  // The tilted cut slides in its plane: it answers along its normal alone.
  const Eigen::Vector3d normal = Eigen::Vector3d(0, 0.2, -1).normalized(), answer = result.balance.reactions.at("cut \"right\"");
  EXPECT_GT(answer.norm(), 1.0);
  EXPECT_LE((answer - normal.dot(answer) * normal).norm(), 1e-6 * answer.norm());
}

}  // namespace
}  // namespace snug::tests
