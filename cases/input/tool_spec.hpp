// What a case says about a rigid tool that is moved into the body.
#pragma once

#include <array>
#include <string>

#include "cases/input/choice.hpp"
#include "cases/input/field.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

/// A flat round disc with a rounded edge, or a ball; both are the end of a straight round rod along the direction.
enum class ToolShape { disc, sphere };
constexpr auto texts_of(ToolShape) { return std::array{"disc", "sphere"}; }

/// A rigid tool: it is moved and does not turn.
struct ToolSpec {
  std::string name = "tool";
  ToolShape shape = ToolShape::disc;
  double radius = 0.0;                           ///< m
  double edge_radius = 1e-3;                     ///< m, of a disc
  std::string on = "skin";
  std::array<double, 3> tip = {0, 0, 0};         ///< m, its foremost point (a disc: the middle of its face) at the start
  std::array<double, 3> direction = {0, 0, 0};   ///< of any length
  double travel = 0.0;                           ///< m
  bool from_touch = true;
  double friction = 0.0;
  int steps = 8;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "of the tool in results; several tools have different ones"}, self.name);
    field(Field{.key = "shape", .meaning = "disc: a flat round face with a rounded edge; sphere: a ball"}, self.shape);
    field(Field{.key = "radius", .unit = "m", .meaning = "of the disc, its rounded edge included, or of the ball", .required = true, .bound = positive()},
          self.radius);
    field(Field{.key = "edge_radius", .unit = "m", .meaning = "of the rounded edge of a disc, at most its radius", .bound = positive()}, self.edge_radius);
    field(Field{.key = "on", .meaning = "name of the surface of the body that it meets"}, self.on);
    field(Field{.key = "tip", .unit = "m", .meaning = "its foremost point at the start (x, y, z); of a disc the middle of its face", .required = true},
          self.tip);
    field(Field{.key = "direction", .meaning = "in which it is moved and faces (x, y, z), of any length", .required = true}, self.direction);
    field(Field{.key = "travel", .unit = "m", .meaning = "how far it is moved", .required = true, .bound = positive()}, self.travel);
    field(Field{.key = "from_touch",
                .meaning = "true: the tool stands where it first touches the surface, on its line through tip, and travel counts from there; "
                           "false: it starts at tip"},
          self.from_touch);
    field(Field{.key = "friction", .meaning = "coefficient of friction on the surface; 0: none", .bound = between(0.0, 2.0)}, self.friction);
    field(Field{.key = "steps", .meaning = "rows of the force over the travel at least (tool.csv)", .bound = between(1, 1000)}, self.steps);
  }
};

}  // namespace snug::input
