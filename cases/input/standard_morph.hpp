// A standard body of other girths and stature: where its sections go. The surface follows in mesh/surface/morph.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/diagnostics.hpp"

namespace snug::input {

struct StandardBody;

/// A girth that is asked of a standard body.
struct GirthSpec {
  std::string at;       ///< "waist", "knee left", or "knee" for both sides
  double length = 0.0;  ///< m
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "at", .meaning = "where: a cut or a landmark with a girth of the standard body (snug list bodies); without left or right: both sides", .required = true}, self.at);
    field(Field{.key = "length", .unit = "m", .meaning = "girth of the section there", .required = true, .bound = positive()}, self.length);
  }
};

/// A section of the body that keeps its shape: points x of it go to c + factor (x - c) + shift, c its middle.
struct BodyRing {
  std::string name;
  std::array<double, 3> point = {0, 0, 0};   ///< m, in the middle, of the body with its new stature
  std::array<double, 3> normal = {0, 0, 1};  ///< of its plane
  double factor = 1.0;
  std::array<double, 3> shift = {0, 0, 0};   ///< m
  double was = 0.0;                          ///< m, girth of the standard body
  std::optional<double> asked;               ///< m
  bool end = false;                          ///< no other ring is farther out: head, hands and feet beyond it only go along
};

struct BodyMorph {
  double stature = 1.0;  ///< new over old; heights go by it, girths do not
  std::vector<BodyRing> rings;
};

/// Where the sections of a body go. Girths that are not asked go along: along the trunk, and along each limb from the trunk on, the factor is linear in the
/// distance between the nearest ones that are asked, and the same beyond the last. Legs and arms are moved outwards by as much as the trunk
/// becomes wider where they hang on, legs also by as much as they become thicker. Reports a girth that the body does not have, one that is asked
/// twice, and one (or a stature) that is too far from the body's own to be made of it.
BodyMorph body_morph(const StandardBody& body, const std::vector<GirthSpec>& girths, std::optional<double> stature, const Location& where, Diagnostics& diagnostics);

}  // namespace snug::input
