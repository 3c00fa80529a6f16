// Bones with joints: what of the body they carry, where it goes, and what is said of joints that part nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

#include "mesh/body/skeleton.hpp"
#include "tests/unit/mesh/bodies.hpp"

namespace snug::mesh {
namespace {

using testing::HasSubstr;

constexpr double deg = std::numbers::pi / 180.0;

const BodyMesh& limb() {
  static const BodyMesh mesh = make_body_mesh([] {
    input::BodySpec spec = layered_spec();
    spec.cells_along = 20;
    return spec;
  }(), cylinder());
  return mesh;
}

input::MovingBoneSpec bone(const std::string& name, double height, const std::string& towards = "lower") {
  input::MovingBoneSpec spec{.name = name, .joint = input::JointSpec{}};
  spec.joint->point = {0, 0, height}, spec.joint->towards = towards, spec.joint->axis = {{1, 0, 0}}, spec.joint->blend = 0.04;
  return spec;
}

std::string message(const std::vector<input::MovingBoneSpec>& specs, const BodyMesh& body = limb()) {
  try {
    const Skeleton skeleton(specs, body);
  } catch (const input::InputError& error) {
    return error.what();
  }
  return "";
}

// Beyond the blend a bone carries every node of the core rigidly, before it nothing moves, and halfway the share is a half: a turn about the joint.
TEST(Skeleton, CarriesWhatLiesBeyondTheJointAsOne) {
  const Skeleton skeleton({bone("shank", 0.1)}, limb());
  const Pose pose = {{60 * deg, Eigen::Vector3d(0.01, 0.0, 0.0)}};
  const Eigen::Vector3d joint(0, 0, 0.1);
  int whole = 0, none = 0, between = 0;
  for (const int node : limb().bone_nodes) {
    const Eigen::Vector3d& x = limb().nodes[node];
    const auto shares = skeleton.shares_of(node);
    const Eigen::Vector3d to = skeleton.placed(x, shares, pose);
    const double s = 0.1 - x.z();
    if (s >= 0.02) {
      ++whole;
      EXPECT_LE((to - (joint + Eigen::AngleAxisd(60 * deg, Eigen::Vector3d::UnitX()) * (x - joint) + Eigen::Vector3d(0.01, 0, 0))).norm(), 1e-15);
    } else if (s <= -0.02) {
      ++none;
      EXPECT_EQ(to, x);
    } else {
      ++between;
      EXPECT_NEAR(shares[0], std::pow(s / 0.04 + 0.5, 2) * (3 - 2 * (s / 0.04 + 0.5)), 1e-12);
    }
    EXPECT_LE((skeleton.unplaced(to, shares, pose) - x).norm(), 1e-15);
  }
  EXPECT_GT(whole, 100);
  EXPECT_GT(none, 100);
  EXPECT_GT(between, 50);
}

// The share goes over with a continuous slope: it is the derivative of the share, to the fourth of the error at half the step, and vanishes at both ends.
TEST(Skeleton, TheShareHasTheSlopeThatIsSaidOfIt) {
  const Joint joint{.blend = 0.04};
  for (const double s : {-0.015, -0.004, 0.0, 0.011}) {
    const auto error = [&](double h) { return std::abs((joint.share(s + h) - joint.share(s - h)) / (2 * h) - joint.slope_of_share(s)); };
    EXPECT_NEAR(error(2e-3) / error(1e-3), 4.0, 1e-3) << s;
  }
  EXPECT_EQ(joint.slope_of_share(0.02), 0.0);
  EXPECT_EQ(joint.slope_of_share(-0.02), 0.0);
}

// A bone that lies within another one hangs on it, whatever their order in the case: its joint goes along and its turn is counted against the other's.
TEST(Skeleton, ABoneWithinAnotherGoesWithIt) {
  const Eigen::Vector3d hip(0, 0, 0.15), knee(0, 0, 0.06), foot(0.01, 0.0, 0.0);
  const Eigen::AngleAxisd first(40 * deg, Eigen::Vector3d::UnitX()), second(-70 * deg, Eigen::Vector3d::UnitX());
  const Eigen::Vector3d expected = hip + first * (knee + second * (foot - knee) - hip);
  for (const bool swapped : {false, true}) {
    std::vector<input::MovingBoneSpec> specs = {bone("thigh", 0.15), bone("shank", 0.06)};
    Pose pose = {{40 * deg, {0, 0, 0}}, {-70 * deg, {0, 0, 0}}};
    if (swapped) std::swap(specs[0], specs[1]), std::swap(pose[0], pose[1]);
    const Skeleton skeleton(specs, limb());
    EXPECT_EQ(skeleton.bones()[skeleton.find("shank")].parent, skeleton.find("thigh"));
    EXPECT_EQ(skeleton.bones()[skeleton.find("thigh")].parent, -1);
    const Eigen::Vector3d to = skeleton.placed(foot, std::vector<double>{1.0, 1.0}, pose);
    EXPECT_LE((to - expected).norm(), 1e-15);
    EXPECT_LE((skeleton.unplaced(to, std::vector<double>{1.0, 1.0}, pose) - foot).norm(), 1e-15);
  }
}

// The volume ratio of the core in the fold is that of the map itself, by differences; the blend that is asked for brings it to a tenth.
TEST(Skeleton, TheCoreInTheFoldIsPressedAsMuchAsIsSaid) {
  input::MovingBoneSpec spec = bone("shank", 0.1);
  spec.joint->blend = 0.03;
  const Pose pose = {{50 * deg, Eigen::Vector3d(0.001, -0.002, 0.003)}};
  const Skeleton skeleton({spec}, limb());
  const Joint& joint = *skeleton.bones()[0].joint;
  double least = 1.0;
  for (const int node : limb().bone_nodes) {
    const auto map = [&](const Eigen::Vector3d& x) { return joint.placed(x, joint.share(joint.distance(x)), pose[0]); };
    Eigen::Matrix3d F;
    for (int c = 0; c < 3; ++c) F.col(c) = (map(limb().nodes[node] + 1e-6 * Eigen::Vector3d::Unit(c)) - map(limb().nodes[node] - 1e-6 * Eigen::Vector3d::Unit(c))) / 2e-6;
    least = std::min(least, F.determinant());
  }
  EXPECT_NEAR(skeleton.squeeze(pose, limb()).ratio, least, 1e-6);
  EXPECT_LT(least, 0.5);
  const Pose far = {{170 * deg, {0, 0, 0}}};
  const Skeleton::Squeeze worst = skeleton.squeeze(far, limb());
  EXPECT_LT(worst.ratio, 0.1);
  spec.joint->blend = worst.blend_needed;
  EXPECT_NEAR(Skeleton({spec}, limb()).squeeze(far, limb()).ratio, 0.1, 0.02);
}

// Left out, the axis is across the limb, the direction that to the cut, and the blend twice the width of the core, or what there is room for.
TEST(Skeleton, WhatIsLeftOutIsTakenFromTheLimb) {
  input::MovingBoneSpec spec = bone("shank", 0.1);
  spec.joint->axis.reset(), spec.joint->blend.reset();
  const Skeleton skeleton({spec}, limb());
  EXPECT_LE((skeleton.bones()[0].joint->axis - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LE((skeleton.bones()[0].joint->direction + Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  EXPECT_NEAR(skeleton.bones()[0].joint->blend, 0.06, 1e-3);  // a core of 15 mm
  spec.joint->point = {0, 0, 0.02};
  EXPECT_NEAR(Skeleton({spec}, limb()).bones()[0].joint->blend, 0.036, 1e-3);
}

// A whole body is a bone, too: every node has the whole share, and what lies within it hangs on it.
TEST(Skeleton, EverythingIsOneBone) {
  input::MovingBoneSpec all = bone("all", 5.0, "everything");
  all.joint->blend.reset();
  const Skeleton skeleton({bone("shank", 0.1), all}, limb());
  EXPECT_EQ(skeleton.shares_of(limb().bone_nodes.front())[1], 1.0);
  EXPECT_EQ(skeleton.bones()[0].parent, 1);
  all.joint->axis.reset();
  EXPECT_THAT(message({all}), HasSubstr("is of everything and has no axis; say what the body turns about"));
}

// What parts nothing is refused with its place and what to write: a point outside, in the wrong unit, a cut that is none, a blend beyond the ends, two bones of one part, a body without a core.
TEST(Skeleton, JointsThatPartNothingAreRefused) {
  EXPECT_EQ(message({bone("shank", 0.1)}), "");
  EXPECT_THAT(message({bone("shank", 0.5)}), HasSubstr("the joint of \"shank\" at (0, 0, 500) mm lies outside the body"));
  EXPECT_THAT(message({bone("shank", 100.0)}), HasSubstr("is it in the right unit?"));
  EXPECT_THAT(message({bone("shank", 0.1, "ankle")}), HasSubstr("lies towards \"ankle\", which is no cut of the body"));
  EXPECT_THAT(message({bone("shank", 0.01)}), HasSubstr("reaches beyond the far end of the core"));
  EXPECT_THAT(message({bone("a", 0.1), bone("b", 0.1)}), HasSubstr("\"a\" and \"b\" are the same part of the body"));
  EXPECT_THAT(message({bone("a", 0.06, "upper"), bone("b", 0.14)}), HasSubstr("overlap, and neither lies within the other"));
  input::MovingBoneSpec open = bone("shank", 0.1, "");
  EXPECT_THAT(message({open}), HasSubstr("does not say on which side the bone lies"));
  open.joint->direction = {{0, 0, 0}};
  EXPECT_THAT(message({open}), HasSubstr("a direction of no length"));
  BodyMesh soft = limb();
  soft.bone_nodes.clear();
  EXPECT_THAT(message({bone("shank", 0.1)}, soft), HasSubstr("the body has no rigid core to move"));
}

}  // namespace
}  // namespace snug::mesh
