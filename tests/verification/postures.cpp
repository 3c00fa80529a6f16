// Bodies that move after the garment is on: what a rigid motion, a way there and back and a bent limb must show.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/verification/tube.hpp"

namespace snug::tests {
namespace {

constexpr double deg = std::numbers::pi / 180.0;

/// A soft limb of 200 mm with a sleeve of 80 mm about its middle, and a bone that begins in the middle.
struct Moved {
  TubeCase tube;
  input::Case c;

  explicit Moved(double friction) {
    tube.length = 0.2, tube.bone = 0.015, tube.radius = 0.045, tube.sleeve = 0.038, tube.around = 8, tube.along = 8, tube.cell_size = 0.02;
    tube.fabric = "law = 'linear'\nwarp = '200 N/m'\nweft = '200 N/m'\nshear = '60 N/m'\npoisson = 0.2";
    tube.bone_offset = 0.004;
    c = describe_tube(tube);
    c.garments.front().pattern.length = 0.08, c.garments.front().position = 0.06;
    if (friction > 0.0) c.garments.front().held.clear();
    c.contacts.front().friction = friction;
    input::MovingBoneSpec bone{.name = "shank", .joint = input::JointSpec{}};
    bone.joint->point = {0.002, 0.001, 0.1}, bone.joint->towards = "lower", bone.joint->axis = {{1, 0, 0}}, bone.joint->blend = 0.1;
    c.bones = {bone};
  }
  void posture(const std::string& name, double turn, const std::string& bone = "shank", const std::array<double, 3>& shift = {0, 0, 0}) {
    input::PostureSpec spec{.name = name};
    if (turn != 0.0) spec.move = {{.bone = bone, .turn = turn, .shift = shift}};
    c.postures.push_back(spec);
  }
  void everything(const std::array<double, 3>& axis) {
    input::MovingBoneSpec all{.name = "all", .joint = input::JointSpec{}};
    all.joint->point = {0.1, -0.05, 0.3}, all.joint->towards = "everything", all.joint->axis = axis;
    c.bones = {all};
  }

  struct Answer {
    postproc::RunResult result;
    std::vector<postproc::RunResult> states;  ///< the dressed one first
  };
  Answer solve() const {
    const solver::Meshes meshes = make_meshes(c);
    Answer answer;
    const solver::KeptStates kept{0, [&](double, const postproc::RunResult& state) { answer.states.push_back(state); }};
    answer.result = solver::solve(solver::make_model(c, meshes.body), meshes, {}, kept);
    return answer;
  }
};

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

double difference(const std::vector<double>& a, const std::vector<double>& b) {
  double most = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, std::abs(a[n] - b[n]));
  return most;
}

const std::vector<double>& pressures(const postproc::RunResult& state) { return state.body.fields[postproc::field::contact_pressure]; }

double farthest(const postproc::RunResult& a, const postproc::RunResult& b) {
  const auto &u = a.body.fields[postproc::field::displacement], &v = b.body.fields[postproc::field::displacement];
  double most = 0.0;
  for (std::size_t n = 0; n < u.size(); ++n) most = std::max(most, (u[n] - v[n]).norm());
  return most;
}

void expect_balance(const postproc::RunResult& result) {
  for (const postproc::MovementState& state : result.movement) {
    EXPECT_LE(state.force_error, 1e-8 * state.contact_force) << state.posture << " " << state.share;
    EXPECT_LE(state.moment_error, 1e-8 * 0.3 * state.contact_force) << state.posture << " " << state.share;
  }
}

// A rigid motion of everything, far and about an oblique axis, leaves every pressure as it was, to 1e-9 of the largest, turns friction along with the skin, and needs no iteration.
TEST(Postures, ARigidMotionLeavesPressuresUnchanged) {
  for (const double friction : {0.3, 0.0}) {
    Moved moved(friction);
    const Eigen::Vector3d axis = Eigen::Vector3d(1.0, -2.0, 0.5).normalized();
    moved.everything({1.0, -2.0, 0.5});
    moved.posture("turned", 130 * deg, "all", {0.2, 0.1, -0.05});
    const Moved::Answer answer = moved.solve();
    ASSERT_EQ(answer.result.status, postproc::Status::converged) << answer.result.message;
    const postproc::RunResult &before = answer.states.front(), &after = answer.states.back();
    const double most = largest(pressures(before));
    EXPECT_LE(difference(pressures(before), pressures(after)), 1e-9 * most);
    const Eigen::AngleAxisd R(130 * deg, axis);
    const Eigen::Vector3d p(0.1, -0.05, 0.3), shift(0.2, 0.1, -0.05);
    double off = 0.0, shear = 0.0, turned = 0.0;
    for (std::size_t n = 0; n < before.body.nodes.size(); ++n) {
      const Eigen::Vector3d x = before.body.nodes[n] + before.body.fields[postproc::field::displacement][n];
      off = std::max(off, (p + R * (x - p) + shift - after.body.nodes[n] - after.body.fields[postproc::field::displacement][n]).norm());
    }
    EXPECT_LE(off, 1e-10);
    if (friction > 0.0)
      for (std::size_t n = 0; n < before.body.nodes.size(); ++n) {
        const Eigen::Vector3d t = before.body.fields[postproc::field::shear_traction][n];
        shear = std::max(shear, t.norm()), turned = std::max(turned, (R * t - after.body.fields[postproc::field::shear_traction][n]).norm());
      }
    EXPECT_EQ(shear > 0.0, friction > 0.0);
    EXPECT_LE(turned, 1e-8 * shear);
    fmt::print("rigid motion, friction {:g}: pressures differ by {:.1e} of {:.0f} Pa, places by {:.1e} m, {} iterations in all, {} states\n", friction,
               difference(pressures(before), pressures(after)), most, off, answer.result.iterations, answer.states.size());
    expect_balance(answer.result);
  }
}

Moved::Answer bent_and_straightened(double friction, double angle) {
  Moved moved(friction);
  moved.posture("bent", angle), moved.posture("straight", 0.0);
  return moved.solve();
}

// Bent by 20 degrees and straightened, a sleeve without friction lies as it lay: nothing remembers the way.
TEST(Postures, ThereAndBackWithoutFrictionIsNoWay) {
  const Moved::Answer answer = bent_and_straightened(0.0, 20 * deg);
  ASSERT_EQ(answer.result.status, postproc::Status::converged) << answer.result.message;
  const postproc::RunResult &before = answer.states.front(), &after = answer.states.back();
  const double most = largest(pressures(before));
  fmt::print("there and back without friction: pressures differ by {:.1e} of {:.0f} Pa, places by {:.1e} m, {} iterations\n", difference(pressures(before), pressures(after)), most,
             farthest(before, after), answer.result.iterations);
  EXPECT_LE(farthest(before, after), 1e-6 * 0.02);  // the solver's tolerance of gaps: 1e-6 of the sleeve's edge
  EXPECT_LE(difference(pressures(before), pressures(after)), 2e-5 * most);  // which the tissue, 3 G / h = 1 MPa/m, answers with 0.02 Pa
  expect_balance(answer.result);
  EXPECT_GE(answer.result.movement.size(), 5u);
}

// With friction the sleeve stays where the bend has put it: the way there and back shows.
TEST(Postures, ThereAndBackWithFrictionShowsHysteresis) {
  const Moved::Answer answer = bent_and_straightened(0.5, 40 * deg);
  ASSERT_EQ(answer.result.status, postproc::Status::converged) << answer.result.message;
  const postproc::RunResult &before = answer.states.front(), &after = answer.states.back();
  const double most = largest(pressures(before));
  fmt::print("there and back with friction: pressures differ by {:.1f} of {:.0f} Pa, {} iterations\n", difference(pressures(before), pressures(after)), most, answer.result.iterations);
  EXPECT_GT(difference(pressures(before), pressures(after)), 0.01 * most);
  expect_balance(answer.result);
}

}  // namespace
}  // namespace snug::tests
