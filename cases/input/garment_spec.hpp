// What a case says about the garment.
#pragma once

#include <array>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/material_entry.hpp"

namespace snug::input {

enum class PatternKind { tube };
constexpr auto texts_of(PatternKind) { return std::array{"tube"}; }

/// Direction against the body's axis.
enum class WarpDirection { along, around };
constexpr auto texts_of(WarpDirection) { return std::array{"along", "around"}; }

/// Displacement that a held edge has not: along the skin in the direction of the axis, or any.
enum class HeldDirection { axis, all };
constexpr auto texts_of(HeldDirection) { return std::array{"axis", "all"}; }

struct PatternSpec {
  PatternKind kind = PatternKind::tube;
  double flat_circumference = 0.0;  ///< m
  double length = 0.0;              ///< m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "kind", .meaning = "tube: a rectangle sewn along its length"}, self.kind);
    field(Field{.key = "flat_circumference",
                .unit = "m",
                .meaning = "circumference of the tube as cut, without tension",
                .required = true,
                .bound = positive()},
          self.flat_circumference);
    field(Field{.key = "length",
                .unit = "m",
                .meaning = "length of the tube as cut",
                .required = true,
                .bound = positive()},
          self.length);
  }
};

struct HeldEdge {
  std::string edge;           ///< upper | lower
  HeldDirection held = HeldDirection::axis;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "edge", .meaning = "edge of the garment", .required = true, .choices = {"upper", "lower"}},
          self.edge);
    field(Field{.key = "held",
                .meaning = "axis: no displacement along the skin in the direction of the body's axis; all: none at all"},
          self.held);
  }
};

struct GarmentSpec {
  std::string name = "garment";
  PatternSpec pattern;
  MaterialEntry fabric;
  WarpDirection warp = WarpDirection::along;
  double position = 0.0;       ///< m; height of the lower edge as placed
  double seam = std::numbers::pi;  ///< rad; where it lies round the limb
  double cell_size = 0.0;      ///< m, on the pattern; 0 = by the skin's cells
  int order = 2;               ///< of the triangles
  std::optional<bool> bending, weight;
  std::vector<HeldEdge> held;
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name in results and contacts, its own where there are several garments"}, self.name);
    field(Field{.key = "pattern", .meaning = "the pieces as cut", .required = true}, self.pattern);
    field(Field{.key = "fabric", .meaning = "an entry of snug materials list or a table of values", .required = true},
          self.fabric);
    field(Field{.key = "warp", .meaning = "warp (wale) direction against the body's axis"}, self.warp);
    field(Field{.key = "position", .unit = "m", .meaning = "height of the lower edge as placed", .required = true},
          self.position);
    field(Field{.key = "seam",
                .unit = "rad",
                .meaning = "angle at which the seam lies round the limb: 0 = side (+x), 90 deg = front (+y); left out: 180 deg"},
          self.seam);
    field(Field{.key = "cell_size",
                .unit = "m",
                .meaning = "edge length of the triangles on the pattern; 0 m: 0.6 of the mean cell size of the skin as worn, finer "
                           "where the tissue is soft for the pressure",
                .bound = non_negative()},
          self.cell_size);
    field(Field{.key = "order",
                .meaning = "2: quadratic triangles; 1: linear ones, to see what quadratic ones bring",
                .bound = between(1, 2)},
          self.order);
    field(Field{.key = "bending",
                .meaning = "true: the fabric's bending stiffness is part of the scene; left out: where a part of the garment "
                           "is wider than the body as placed"},
          self.bending);
    field(Field{.key = "weight",
                .meaning = "true: the fabric's weight is part of the scene, along load.gravity or else down the body's axis; "
                           "left out: where a part of the garment is wider than the body as placed"},
          self.weight);
    field(Field{.key = "held", .meaning = "edges that the wearer or a band holds"}, self.held);
  }
};

}  // namespace snug::input
