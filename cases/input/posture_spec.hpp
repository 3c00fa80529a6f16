// What a case says about bones that move: rigid parts of the body's core with joints, and the postures that they are moved to.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

/// Where a bone parts from the one that it hangs on, and what it turns about.
struct JointSpec {
  std::array<double, 3> point = {0, 0, 0};               ///< m
  std::optional<std::array<double, 3>> axis;             ///< of any length
  std::string towards;                                   ///< a cut of the body, or "everything"
  std::optional<std::array<double, 3>> direction;        ///< of any length
  std::optional<double> blend;                           ///< m
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "point", .unit = "m", .meaning = "the middle of the joint, in the frame of the body: a point of the axis, inside the limb", .required = true}, self.point);
    field(Field{.key = "axis",
                .meaning = "direction of the axis (x, y, z), of any length: positive angles turn counter-clockwise seen against it; left out: across the limb, as near to x (the side) as may be"},
          self.axis);
    field(Field{.key = "towards",
                .meaning = "what the bone reaches to from the joint: the name of a cut of the body (of a limb \"lower\" or \"upper\"); or \"everything\": the bone is the whole body"},
          self.towards);
    field(Field{.key = "direction", .meaning = "direction (x, y, z) along the limb from the joint into the bone, of any length; left out: from the point to the middle of the cut"}, self.direction);
    field(Field{.key = "blend",
                .unit = "m",
                .meaning = "length along the limb over which the core goes over from one bone to the other, half of it on either side of the point; left out: twice the width of the core there",
                .bound = positive()},
          self.blend);
  }
};

/// A bone that postures move: all of the body's rigid core beyond its joint. A bone that lies within another one hangs on it and goes with it.
struct MovingBoneSpec {
  std::string name;
  std::optional<JointSpec> joint;  ///< none: a bone that stays where it is
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name of the bone in postures and results, e.g. \"shank\"", .required = true}, self.name);
    field(Field{.key = "joint", .meaning = "where the bone begins and what it turns about; left out: a bone that stays where it is"}, self.joint);
  }
};

/// How a bone stands in a posture, against the one that it hangs on and counted from the position in which the garment was put on.
struct BoneMoveSpec {
  std::string bone;
  double turn = 0.0;                        ///< rad
  std::array<double, 3> shift = {0, 0, 0};  ///< m
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "bone", .meaning = "name of the bone", .required = true}, self.bone);
    field(Field{.key = "turn", .unit = "rad", .meaning = "angle about the axis of its joint", .bound = between(-6.3, 6.3)}, self.turn);
    field(Field{.key = "shift", .unit = "m", .meaning = "displacement (x, y, z)"}, self.shift);
  }
};

/// A position that the body takes after the garment is on. Several in a row are a movement.
struct PostureSpec {
  std::string name;
  std::vector<BoneMoveSpec> move;
  std::optional<int> steps;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name of the posture in results, e.g. \"bent\"", .required = true}, self.name);
    field(Field{.key = "move",
                .meaning = "how bones stand in it, e.g. { bone = \"shank\", turn = \"60 deg\" }; a bone that is not named stands as it did when the garment was put on",
                .one_or_more = true},
          self.move);
    field(Field{.key = "steps", .meaning = "steps on the way to it at least, each a row of the results; left out: one in 10 deg of a turn or 10 mm of a shift", .bound = between(1, 1000)}, self.steps);
  }
};

}  // namespace snug::input
