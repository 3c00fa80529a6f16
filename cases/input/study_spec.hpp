// What a case says about its study: the ladder of meshes and what the answers are measured against.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"

namespace snug::input {

/// An answer that is the same everywhere in the zone of a study.
struct ExactAnswer {
  double pressure = std::numeric_limits<double>::quiet_NaN();                  ///< Pa
  double skin_radial_displacement = std::numeric_limits<double>::quiet_NaN();  ///< m, outwards positive
  std::string source;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "pressure", .unit = "Pa", .meaning = "contact pressure", .required = true, .bound = positive()},
          self.pressure);
    field(Field{.key = "skin_radial_displacement",
                .unit = "m",
                .meaning = "displacement of the skin away from the z axis",
                .required = true},
          self.skin_radial_displacement);
    field(Field{.key = "source", .meaning = "where the answer comes from", .required = true}, self.source);
  }
};

/// One mesh of the ladder or one series of runs: values that replace those of the case.
struct StudyVariant {
  std::string name;
  std::vector<std::string> set;  ///< "section.key=value", as of --set

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name in tables and plot", .required = true}, self.name);
    field(Field{.key = "set", .meaning = "values that replace those of the case: \"body.cells_around=16\""}, self.set);
  }
};

/// The part of the skin whose nodes are compared.
struct StudyZone {
  std::optional<double> from_height, to_height;  ///< m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "from_height", .unit = "m", .meaning = "lower end; left out: the lower cut"}, self.from_height);
    field(Field{.key = "to_height", .unit = "m", .meaning = "upper end; left out: the upper cut"}, self.to_height);
  }
};

struct StudySpec {
  std::vector<StudyVariant> levels, series;
  std::optional<StudyZone> zone;
  std::optional<ExactAnswer> exact;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "levels",
                .meaning = "the ladder of meshes, coarsest first; left out: all cells of the case by common factors"},
          self.levels);
    field(Field{.key = "series",
                .meaning = "what else is varied, each with the whole ladder; left out: the case, tier L1 and straight "
                           "elements"},
          self.series);
    field(Field{.key = "zone", .meaning = "heights between which nodes are compared; left out: all covered skin"},
          self.zone);
    field(Field{.key = "exact", .meaning = "an exact answer, the same everywhere in the zone"}, self.exact);
  }
};

}  // namespace snug::input
