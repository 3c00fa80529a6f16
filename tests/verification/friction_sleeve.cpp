#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "solver/scene/result.hpp"
#include "solver/stepping/load_path.hpp"
#include "tests/verification/book.hpp"
#include "tests/verification/tube.hpp"

namespace {

using namespace snug;
using testing::HasSubstr;

using std::numbers::pi;

/// A sleeve whose fabric keeps hoop tension and length apart (no Poisson ratio), without held edges.
input::Case sleeve(double lower_radius, double upper_radius, double limb, double length, double position, double k,
                   double rest_radius) {
  tests::TubeCase tube;
  tube.length = limb, tube.sleeve = rest_radius, tube.tier = input::Tier::L1, tube.along = 6;
  tube.fabric = fmt::format("law = 'linear'\nwarp = '{0} N/m'\nweft = '{0} N/m'\nshear = '{1} N/m'\npoisson = 0", k, 0.3 * k);
  input::Case c = tests::describe_tube(tube);
  c.body->stations = std::filesystem::temp_directory_path() /
                     fmt::format("snug-sleeve-{}-{:.6f}-{:.6f}.csv", ::getpid(), lower_radius, upper_radius);
  std::ofstream out(c.body->stations);
  out.precision(17);
  out << "height [m], girth [m], bone_girth [m]\n";
  for (const double s : {0.0, 0.5, 1.0})
    out << s * limb << ", " << 2.0 * pi * (lower_radius + s * (upper_radius - lower_radius)) << ", 0.12\n";
  c.garments.front().held.clear();
  c.garments.front().position = position;
  c.garments.front().pattern.length = length;
  return c;
}

/// A sleeve of 100 mm that presses on a rigid cylinder (R = 55 mm) with 50 N/m / R = 0.909 kPa is pulled off by one edge: the force is mu times
/// the sum of the normal forces, 9.42478 N (reference book 3), on facets of
/// every kind.
class PullOff : public testing::TestWithParam<input::Elements> {};

TEST_P(PullOff, ASleeveIsPulledOffWithFrictionTimesItsNormalForce) {
  const double stretch = 1.25, k = 50.0 / (stretch * 0.5 * (stretch * stretch - 1.0));
  input::Case c = sleeve(0.055, 0.055, 0.16, 0.10, 0.02, k, 0.055 / stretch);
  c.body->elements = GetParam();
  c.garments.front().held = {{.edge = "upper", .held = input::HeldDirection::axis}};
  c.contacts.front().friction = 0.3;
  const solver::Meshes meshes = tests::make_meshes(c);
  input::Case without = c;
  without.contacts.front().friction = 0.0;
  without.garments.front().held.push_back({.edge = "lower", .held = input::HeldDirection::axis});
  solver::Scene smooth = tests::make_scene(without, meshes, solver::Skin::rigid);
  solver::Scene rough = tests::make_scene(c, meshes, solver::Skin::rigid);
  solver::PathSettings settings;
  settings.newton.penetration = 1e-6 * meshes.garments.front().mean_edge;
  int iterations = 0;
  const auto count = [&](const postproc::Iteration&) { ++iterations; };
  const auto tight = solver::follow_path(smooth, solver::placed_state(smooth.layout(), meshes),
                                         solver::tightening(), settings, count);
  ASSERT_TRUE(tight.complete) << tight.message << " at " << tight.reached;
  iterations = 0;
  const auto& edge = meshes.garments.front().edges.at("upper");
  const auto pull = [&](solver::State& state, double t) {
    for (const int node : edge)
      state.values[rough.layout()["garment"](node, 2)] = tight.state.values[rough.layout()["garment"](node, 2)] + 0.02 * t;
  };
  settings.first_step = 0.1;
  const auto path = solver::follow_path(rough, tight.state, pull, settings, count);
  EXPECT_TRUE(path.complete) << path.message;
  postproc::RunResult result;
  result.body = solver::body_result(meshes.body, false);
  tests::fill_result(rough, path.state, meshes, result);
  const double force = std::abs(result.balance.reactions.at("upper edge").z());
  fmt::print("pull-off: {} increments, {} iterations, normal force {:.5f} N, friction {:.5f} N, force error {:.1e} N, moment error {:.1e} N m\n",
             path.increments, iterations, result.balance.contact_force, result.balance.friction_force,
             result.balance.force_error.norm(), result.balance.moment_error.norm());
  EXPECT_NEAR(force, 0.3 * result.balance.contact_force, 1e-3 * force);
  if (GetParam() != input::Elements::Q1P0)  // the 16 straight facets are a shorter way round, and so are the tension and the force
      tests::book("sleeve pulled off a cylinder, " + text_of(GetParam()), "axial force, N", force, 9.4247779608, 1e-2, "mu p 2 pi R L, reference book 3");
  EXPECT_LE(result.balance.force_error.norm(), 1e-8 * result.balance.contact_force);
  EXPECT_LE(result.balance.moment_error.norm(), 1e-8 * result.balance.contact_force * 0.055);
}

INSTANTIATE_TEST_SUITE_P(Friction, PullOff, testing::Values(input::Elements::Q2P1, input::Elements::P2P1, input::Elements::Q1P0), [](const auto& info) {
  std::string name = text_of(info.param);
  name.erase(name.find('/'), 1);
  return name;
});

/// A sleeve that nothing holds stays on a cone if mu > tan(half angle) and slips off otherwise (reference book 3).
class Cone : public testing::TestWithParam<double> {};

postproc::RunResult on_cone(double angle, double mu) {
  const double slope = std::tan(angle * pi / 180.0), middle = 0.055, half = 0.03;
  input::Case c = sleeve(middle - half * slope, middle + half * slope, 2.0 * half, 0.030, 0.015, 500.0, 0.042);
  c.contacts.front().friction = mu;
  return tests::solve(c, tests::make_meshes(c));
}

TEST_P(Cone, HoldsTheSleeveIfFrictionExceedsTheTangentOfItsHalfAngle) {
  const double limit = std::tan(GetParam() * pi / 180.0);
  const auto holds = on_cone(GetParam(), 1.03 * limit);
  fmt::print("cone {:2.0f} deg, mu = 1.03 tan: {} {} ({} iterations; mean pressure {:.1f} Pa)\n", GetParam(), name_of(holds.status), holds.message,
             holds.iterations, holds.numbers.at("mean_contact_pressure_Pa"));
  EXPECT_EQ(holds.status, postproc::Status::converged) << holds.message;
  const auto slips = on_cone(GetParam(), 0.97 * limit);
  fmt::print("cone {:2.0f} deg, mu = 0.97 tan: {} {} ({} iterations)\n", GetParam(), name_of(slips.status), slips.message, slips.iterations);
  EXPECT_EQ(slips.status, postproc::Status::failed);
  EXPECT_THAT(slips.message, HasSubstr("no equilibrium"));
  EXPECT_THAT(slips.message, HasSubstr("pushes it down"));
}

INSTANTIATE_TEST_SUITE_P(Friction, Cone, testing::Values(5.0, 10.0, 15.0, 20.0),
                         [](const auto& info) { return fmt::format("{:.0f}Degrees", info.param); });

}  // namespace
