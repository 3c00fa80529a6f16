// What a case is compared with: nodal tables of another program or of an earlier run.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "cases/input/field.hpp"

namespace snug::input {

/// Of a shell, along its normal and against it.
enum class StressSurface { all, top, middle, bottom };
constexpr auto texts_of(StressSurface) { return std::array{"all", "top", "middle", "bottom"}; }

/// How nodes find each other.
enum class NodeMatch { automatic, number, coordinates };
constexpr auto texts_of(NodeMatch) { return std::array{"automatic", "number", "coordinates"}; }

/// A table of displacements. A node may differ by relative * (largest displacement of the table) + absolute.
struct DisplacementReference {
  std::filesystem::path file;
  double relative = 1e-3;
  double absolute = 0.0;  ///< m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "file", .meaning = "listing (PRNSOL, .dat and .frd of CalculiX, FEBio's log) or VTU with the displacements", .required = true},
          self.file);
    field(Field{.key = "relative",
                .meaning = "what a node may differ by, over the largest displacement of the table",
                .bound = non_negative()},
          self.relative);
    field(
        Field{.key = "absolute", .unit = "m", .meaning = "what a node may differ by besides", .bound = non_negative()},
        self.absolute);
  }
};

/// A table of stresses. A node may differ by relative * (largest stress of the table) + absolute.
struct StressReference {
  std::filesystem::path file;
  double relative = 1e-3;
  double absolute = 0.0;        ///< Pa
  StressSurface surface = StressSurface::all;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "file", .meaning = "listing (PRNSOL, PRESOL) or VTU with the stresses", .required = true},
          self.file);
    field(Field{.key = "relative",
                .meaning = "what a node may differ by, over the largest stress of the table",
                .bound = non_negative()},
          self.relative);
    field(
        Field{.key = "absolute", .unit = "Pa", .meaning = "what a node may differ by besides", .bound = non_negative()},
        self.absolute);
    field(Field{.key = "surface",
                .meaning = "surface of a shell whose stresses are taken"},
          self.surface);
  }
};

struct ReferenceSpec {
  std::optional<DisplacementReference> displacement;
  std::optional<StressReference> stress;
  std::optional<std::filesystem::path> nodes;
  NodeMatch match = NodeMatch::automatic;
  std::optional<int> load_step;  ///< of the listings; the last where it is left out
  double length_unit = 1.0;  ///< m
  double stress_unit = 1.0;  ///< Pa

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "displacement", .meaning = "table of displacements"}, self.displacement);
    field(Field{.key = "stress", .meaning = "table of stresses"}, self.stress);
    field(Field{.key = "nodes", .meaning = "listing of the undeformed nodes (NLIST) of the tables"}, self.nodes);
    field(Field{.key = "match",
                .meaning = "how nodes find each other; automatic: by number where the places agree or are not known, "
                           "else by coordinates"},
          self.match);
    field(Field{.key = "load_step",
                .meaning = "of listings with several load steps (or times) the one that is taken; left out: the last",
                .bound = between(1, 1e6)},
          self.load_step);
    field(Field{.key = "length_unit",
                .unit = "m",
                .meaning = "unit of coordinates and displacements in the listings, e.g. \"1 mm\"",
                .bound = positive()},
          self.length_unit);
    field(Field{.key = "stress_unit",
                .unit = "Pa",
                .meaning = "unit of stresses in the listings, e.g. \"1 N/cm2\"",
                .bound = positive()},
          self.stress_unit);
  }
};

}  // namespace snug::input
