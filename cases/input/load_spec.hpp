// What a case says about the loads on the body and what holds it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

/// Pressure that follows a named surface.
struct SurfacePressure {
  std::string on;
  double value = 0.0;  ///< Pa
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "on", .meaning = "name of the surface", .required = true}, self.on);
    field(Field{.key = "value", .unit = "Pa", .meaning = "pressure, against the outward normal", .required = true},
          self.value);
  }
};

/// Dead traction on a named surface.
struct SurfaceTraction {
  std::string on;
  std::array<double, 3> value = {0, 0, 0};  ///< Pa
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "on", .meaning = "name of the surface", .required = true}, self.on);
    field(Field{.key = "value",
                .unit = "Pa",
                .meaning = "force per area of the undeformed surface (x, y, z); keeps its direction",
                .required = true},
          self.value);
  }
};

/// Dead force at the node nearest to a point, or spread over a named surface or curve.
struct Force {
  std::optional<std::array<double, 3>> at;  ///< m
  std::string on;
  std::array<double, 3> value = {0, 0, 0};  ///< N
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "at", .unit = "m", .meaning = "the node nearest to this point (x, y, z) takes the force"}, self.at);
    field(Field{.key = "on", .meaning = "or: name of the surface or curve that shares the force evenly"}, self.on);
    field(Field{.key = "value", .unit = "N", .meaning = "total force (x, y, z); keeps its direction", .required = true},
          self.value);
  }
};

/// Loads on the body; they grow together from nothing to their full size.
struct LoadSpec {
  double skin_pressure = 0.0;  ///< Pa
  std::vector<SurfacePressure> pressure;
  std::vector<SurfaceTraction> traction;
  std::vector<Force> force;
  std::array<double, 3> gravity = {0, 0, 0};  ///< m/s2

  bool empty() const {
    return skin_pressure == 0.0 && pressure.empty() && traction.empty() && force.empty() &&
           gravity == std::array<double, 3>{0, 0, 0};
  }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "skin_pressure",
                .unit = "Pa",
                .meaning = "pressure on the whole skin, follows the deformed surface"},
          self.skin_pressure);
    field(Field{.key = "pressure", .meaning = "pressures on named surfaces that follow them"}, self.pressure);
    field(Field{.key = "traction", .meaning = "forces per area on named surfaces that keep their direction"},
          self.traction);
    field(Field{.key = "force", .meaning = "forces at points, or spread over surfaces and curves"}, self.force);
    field(Field{.key = "gravity",
                .unit = "m/s2",
                .meaning = "acceleration (x, y, z) that acts on the density of the tissues"},
          self.gravity);
  }
};

/// What holds or moves a named surface of the body. Components that are left out are free.
struct SupportSpec {
  std::string on;
  std::optional<double> x, y, z;  ///< m, displacement at full load
  double turn = 0.0;              ///< rad
  Location where;

  bool moves() const { return turn != 0.0 || x.value_or(0.0) != 0.0 || y.value_or(0.0) != 0.0 || z.value_or(0.0) != 0.0; }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "on",
                .meaning = "name of the surface, curve or point; a limb has skin, bone, lower and upper",
                .required = true},
          self.on);
    field(Field{.key = "x", .unit = "m", .meaning = "displacement along x; left out: free"}, self.x);
    field(Field{.key = "y", .unit = "m", .meaning = "displacement along y; left out: free"}, self.y);
    field(Field{.key = "z", .unit = "m", .meaning = "displacement along z; left out: free"}, self.z);
    field(Field{.key = "turn",
                .unit = "rad",
                .meaning = "turns the surface about the line through its middle along z; x and y must be given",
                .bound = between(-63, 63)},
          self.turn);
  }
};

}  // namespace snug::input
