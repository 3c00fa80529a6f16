// Bones and postures as a case describes them: read with their units, and each kind of slip told with its line and what to write.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "cases/input/case.hpp"
#include "cases/input/echo.hpp"

namespace snug::input {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string limb =
    "title = \"t\"\n[body]\nstations = \"limb.csv\"\nlayers = [\n{ name = \"bone\", material = \"rigid\" },\n{ name = \"tissue\", material = \"relaxed thigh\" },\n]\n";
const std::string shank = "[[bone]]\nname = \"shank\"\njoint = { point = [\"0 mm\", \"0.5 cm\", \"170 mm\"], axis = [-1, 0, 0], towards = \"lower\", blend = \"6 cm\" }\n";
const std::string bent = "[[posture]]\nname = \"bent\"\nmove = { bone = \"shank\", turn = \"60 deg\" }\n";

class PostureCase : public testing::Test {
 protected:
  void SetUp() override {
    directory_ = fs::temp_directory_path() / ("snug-postures-" + std::to_string(::getpid()) + "-" + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(directory_);
    std::ofstream(directory_ / "limb.csv") << "height [mm], girth [mm], bone_girth [mm]\n0, 500, 90\n";
  }
  void TearDown() override { fs::remove_all(directory_); }
  Case read(const std::string& text) {
    std::ofstream(directory_ / "case.toml") << text;
    return read_case(directory_);
  }
  std::string said(const std::string& text) {
    try {
      read(text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  fs::path directory_;
};

// A joint, a turn in degrees, a shift in inches and a posture without moves come as SI, in their order; what is left out stays open, and the echo reads back to the same.
TEST_F(PostureCase, ComesInSi) {
  const Case c = read(limb + shank + bent + "steps = 4\n[[posture]]\nname = \"out\"\nmove = [{ bone = \"shank\", turn = \"-0.5 rad\", shift = [\"1 in\", \"0 mm\", \"0 mm\"] }]\n[[posture]]\nname = \"straight\"\n");
  ASSERT_EQ(c.bones.size(), 1u);
  const JointSpec& joint = *c.bones[0].joint;
  EXPECT_NEAR(joint.point[1], 0.005, 1e-15);
  EXPECT_NEAR(joint.point[2], 0.17, 1e-15);
  EXPECT_NEAR(*joint.blend, 0.06, 1e-15);
  EXPECT_EQ((*joint.axis)[0], -1.0);
  ASSERT_EQ(c.postures.size(), 3u);
  EXPECT_NEAR(c.postures[0].move[0].turn, std::numbers::pi / 3.0, 1e-12);
  EXPECT_EQ(c.postures[0].steps, 4);
  EXPECT_NEAR(c.postures[1].move[0].shift[0], 0.0254, 1e-15);
  EXPECT_EQ(c.postures[1].move[0].turn, -0.5);
  EXPECT_TRUE(c.postures[2].move.empty());
  EXPECT_FALSE(c.postures[2].steps);
  const Case again = read(to_toml(to_table(c, directory_)));
  EXPECT_EQ(again.postures.size(), 3u);
  EXPECT_EQ(again.postures[1].move[0].turn, -0.5);
  EXPECT_NEAR(again.bones[0].joint->point[2], 0.17, 1e-15);
  EXPECT_FALSE(again.postures[2].steps);
}

// A case without postures has nothing of them in its echo.
TEST_F(PostureCase, WhatIsNotNamedIsNotThere) {
  const std::string text = echo_text(read(limb + "[load]\nskin_pressure = \"1 kPa\"\n"));
  EXPECT_EQ(text.find("posture"), std::string::npos);
  EXPECT_EQ(text.find("joint"), std::string::npos);
}

// Each slip is told: an unknown bone (with the one that is meant), a turn without a unit or beyond a full one, no steps, a bone without a joint, a joint without a side, names twice, nothing moved,
// a bone that nothing moves, a bone that a support holds.
TEST_F(PostureCase, SlipsAreTold) {
  EXPECT_EQ(said(limb + shank + bent), "");
  EXPECT_THAT(said(limb + shank + "[[posture]]\nname = \"bent\"\nmove = { bone = \"shnak\", turn = \"60 deg\" }\n"), HasSubstr("13:8: error: the posture \"bent\" moves \"shnak\", which is no bone of the case; did you mean shank?"));
  EXPECT_THAT(said(limb + bent), HasSubstr("add [[bone]] with its name and joint"));
  EXPECT_THAT(said(limb + shank + "[[posture]]\nname = \"bent\"\nmove = { bone = \"shank\", turn = 60 }\n"), HasSubstr("turn is the bare number 60"));
  EXPECT_THAT(said(limb + shank + "[[posture]]\nname = \"bent\"\nmove = { bone = \"shank\", turn = \"60 mm\" }\n"), HasSubstr("turn"));
  EXPECT_THAT(said(limb + shank + "[[posture]]\nname = \"bent\"\nmove = { bone = \"shank\", turn = \"600 deg\" }\n"), HasSubstr("turn"));
  EXPECT_THAT(said(limb + shank + bent + "steps = 0\n"), HasSubstr("steps"));
  EXPECT_THAT(said(limb + "[[bone]]\nname = \"shank\"\n" + bent), HasSubstr("moves \"shank\", which has no joint; give the [[bone]] one"));
  EXPECT_THAT(said(limb + "[[bone]]\nname = \"shank\"\njoint = { point = [\"0 mm\", \"0 mm\", \"170 mm\"] }\n" + bent), HasSubstr("does not say on which side the bone lies"));
  EXPECT_THAT(said(limb + "[[bone]]\nname = \"shank\"\njoint = { towards = \"lower\" }\n" + bent), HasSubstr("point"));
  EXPECT_THAT(said(limb + shank + shank + bent), HasSubstr("a second bone is called \"shank\""));
  EXPECT_THAT(said(limb + shank + bent + bent), HasSubstr("a second posture is called \"bent\""));
  EXPECT_THAT(said(limb + shank + "[[posture]]\nname = \"dressed\"\nmove = { bone = \"shank\", turn = \"60 deg\" }\n"), HasSubstr("a posture is called \"dressed\""));
  EXPECT_THAT(said(limb + shank + "[[posture]]\nname = \"bent\"\n"), HasSubstr("the first posture, \"bent\", moves nothing"));
  EXPECT_THAT(said(limb + shank + "[load]\nskin_pressure = \"1 kPa\"\n"), HasSubstr("there is a [[bone]] but no [[posture]]"));
  EXPECT_THAT(said(limb + shank + bent + "[[support]]\non = \"bone\"\nx = \"0 mm\"\n"), HasSubstr("a [[support]] holds the bone, which postures move"));
  EXPECT_THAT(said("title = \"t\"\n" + shank + bent), HasSubstr("there is a [[posture]] but no [body]"));
  EXPECT_THAT(said(limb + "[[bone]]\nname = \"all\"\njoint = { point = [\"0 mm\", \"0 mm\", \"0 mm\"], axis = [1, 0, 0], towards = \"everything\", blend = \"6 cm\" }\n[[posture]]\nname = \"bent\"\nmove = { bone = \"all\", turn = \"60 deg\" }\n"),
              HasSubstr("\"all\" is everything, and its joint has a blend"));
}

}  // namespace
}  // namespace snug::input
