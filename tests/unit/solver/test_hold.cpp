// A held edge holds along the meridian of the skin, exactly and with its whole reaction, and presses on nothing.
#include <gtest/gtest.h>

#include "solver/scene/result.hpp"
#include "solver/stepping/load_path.hpp"
#include "tests/unit/solver/terms.hpp"

namespace snug::tests {
namespace {

constexpr double taper = 0.15;  // radius over height

/// A sleeve of 80 mm in the middle of a cone of 120 mm, held at its wider end, on the rigid skin.
input::Case on_cone(double slope, int around = 16) {
  TubeCase tube;
  tube.around = around, tube.along = around / 2, tube.through = 1, tube.length = 0.120, tube.tier = input::Tier::L1;
  input::Case c = describe_tube(tube);
  c.body->stations = std::filesystem::temp_directory_path() / ("snug-hold-" + std::to_string(::getpid()) + ".csv");
  std::ofstream out(c.body->stations);
  out.precision(17);
  out << "height [m], girth [m], bone_girth [m]\n";
  for (const double z : {0.0, 0.06, 0.12}) out << z << ", " << 2.0 * std::numbers::pi * (0.055 + slope * (z - 0.06)) << ", 0.1\n";
  c.garments.front().position = 0.020, c.garments.front().pattern.length = 0.080;
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}};
  c.contacts.front().friction = 0.0;
  return c;
}

struct HeldSleeve {
  solver::Meshes meshes;
  solver::Scene scene;
  solver::State placed, state;
  postproc::RunResult result;
};

HeldSleeve wear(const input::Case& c) {
  solver::Meshes meshes = make_meshes(c);
  solver::Scene scene = tests::make_scene(c, meshes, solver::Skin::rigid);
  solver::State placed = solver::placed_state(scene.layout(), meshes);
  solver::PathSettings settings;
  settings.newton.penetration = 1e-6 * meshes.garments.front().mean_edge;
  const auto path = solver::follow_path(scene, placed, solver::tightening(), settings, [](const postproc::Iteration&) {});
  EXPECT_TRUE(path.complete) << path.message;
  postproc::RunResult result;
  result.body = solver::body_result(meshes.body, false);
  tests::fill_result(scene, path.state, meshes, result);
  return {std::move(meshes), std::move(scene), placed, path.state, std::move(result)};
}

Eigen::Vector3d radial(const Eigen::Vector3d& x) { return Eigen::Vector3d(x.x(), x.y(), 0.0).normalized(); }

// No node of the edge moves along the generator of the cone, though they do move (the lift off the skin closes), and each
// one's reaction, read from the residual, lies along the generator.
TEST(HeldEdge, HoldsAlongTheGeneratorOfACone) {
  HeldSleeve worn = wear(on_cone(taper));
  const Eigen::VectorXd residual = worn.scene.full_residual(worn.state);
  double moved = 0.0, force = 0.0;
  for (const int node : worn.meshes.garments.front().edges.at("upper")) {
    const int entry = worn.scene.layout()["garment"](node);
    const Eigen::Vector3d x = worn.placed.values.segment<3>(entry), u = worn.state.values.segment<3>(entry) - x;
    const Eigen::Vector3d m = (Eigen::Vector3d::UnitZ() + taper * radial(x)).normalized(), r = residual.segment<3>(entry);
    const Eigen::Vector3d n = (radial(x) - taper * Eigen::Vector3d::UnitZ()).normalized();
    EXPECT_LE(std::abs(u.dot(m)), 2e-3 * u.norm());  // the facets' generators are those of the cone to their own error
    EXPECT_LE(std::abs(r.dot(n)), 2e-3 * r.norm());
    moved = std::max(moved, u.norm()), force += r.dot(m);
  }
  EXPECT_GT(moved, 1e-4);
  EXPECT_GT(force, 1.0);
}

// Forces and moments balance to round-off of the contact force, so that the reaction is all that holds the edge; statics of a
// frictionless cone: the reaction's axial part is the contact forces' own, tan of the half angle over its cosine.
TEST(HeldEdge, TheReactionBalancesTheContactForces) {
  const HeldSleeve worn = wear(on_cone(taper));
  const auto& balance = worn.result.balance;
  EXPECT_LE(balance.force_error.norm(), 1e-8 * balance.contact_force);
  EXPECT_LE(balance.moment_error.norm(), 1e-9 * balance.contact_force);
  const double sine = taper / std::hypot(1.0, taper);
  EXPECT_NEAR(balance.reactions.at("upper edge").z(), sine * balance.contact_force, 2e-3 * balance.contact_force * sine);
}

// Held along the meridian, the edge adds no line load: less than a tenth of what a hold along the axis would press with, tension
// times taper.
TEST(HeldEdge, PressesNoLineIntoTheSkin) {
  const HeldSleeve worn = wear(on_cone(taper, 24));
  const auto hem = std::find_if(worn.result.hems.begin(), worn.result.hems.end(), [](const auto& h) { return h.edge == "upper"; });
  ASSERT_NE(hem, worn.result.hems.end());
  const double tension = worn.result.balance.reactions.at("upper edge").z() / hem->length;  // N/m
  EXPECT_GT(tension, 10.0);
  EXPECT_LE(std::abs(hem->line_load), 0.1 * taper * tension);
}

// On a cylinder the meridian is the axis: the entry along it is prescribed and nothing is bound.
TEST(HeldEdge, OnACylinderTheAxisIsPrescribed) {
  const input::Case c = on_cone(0.0);
  const solver::Meshes meshes = make_meshes(c);
  const solver::Scene scene = tests::make_scene(c, meshes, solver::Skin::rigid);
  EXPECT_TRUE(scene.numbering().bound().empty());
  for (const int node : meshes.garments.front().edges.at("upper")) EXPECT_EQ(scene.numbering().unknown(scene.layout()["garment"](node, 2)), -1);
}

}  // namespace
}  // namespace snug::tests
