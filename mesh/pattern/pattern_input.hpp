// What a pattern of ours in TOML may hold.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/choice.hpp"
#include "cases/input/field.hpp"
#include "cases/input/material_entry.hpp"

namespace snug::mesh {

enum class EdgeKind { line, arc, quadratic, cubic, spline };
constexpr auto texts_of(EdgeKind) { return std::array{"line", "arc", "quadratic", "cubic", "spline"}; }

enum class SeenFrom { outside, inside };
constexpr auto texts_of(SeenFrom) { return std::array{"outside", "inside"}; }

using PointInput = std::array<double, 2>;  ///< x, y in the unit of the file

struct EdgeInput {
  std::string name;
  EdgeKind kind = EdgeKind::line;
  PointInput from = {};
  std::optional<PointInput> to;
  std::vector<PointInput> control, through;
  int order = 3;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "name of the edge in its piece"}, self.name);
    field(Field{.key = "kind", .meaning = "what the edge is between its ends"}, self.kind);
    field(Field{.key = "from", .meaning = "where it begins: [x, y] in the unit of the file", .required = true},
          self.from);
    field(Field{.key = "to", .meaning = "where it ends; left out: where the next edge begins"}, self.to);
    field(Field{.key = "control", .meaning = "control points: one of a quadratic, two of a cubic Bezier curve"},
          self.control);
    field(Field{.key = "through", .meaning = "points on the way: one of an arc, one or more of a spline"},
          self.through);
    field(Field{.key = "order",
                .meaning = "of a spline: 3, or 2 for the quadratic spline (4.1) of old data",
                .bound = between(2, 3)},
          self.order);
  }
};

struct HoleInput {
  std::string name = "hole";
  std::vector<EdgeInput> edges;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "name of the hole"}, self.name);
    field(
        Field{.key = "edges", .meaning = "its border, one edge after the other, in either direction", .required = true},
        self.edges);
  }
};

struct NotchInput {
  std::string name, edge;
  std::optional<double> at;
  std::optional<PointInput> point;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "notches of one name on both sides of a seam meet"}, self.name);
    field(Field{.key = "edge", .meaning = "edge that it stands on", .required = true}, self.edge);
    field(Field{.key = "at", .meaning = "share of the edge's length, from its beginning"}, self.at);
    field(Field{.key = "point", .meaning = "its place instead: [x, y], at most 1 mm off the edge"}, self.point);
  }
};

struct DartInput {
  std::string name;
  std::array<std::string, 2> sides;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "name of its seam"}, self.name);
    field(Field{.key = "sides", .meaning = "the two edges of the piece that are sewn", .required = true}, self.sides);
  }
};

struct PieceInput {
  std::string name, mirror_of;
  SeenFrom seen_from = SeenFrom::outside;
  std::optional<std::array<PointInput, 2>> grain;
  std::optional<input::MaterialEntry> fabric;
  std::vector<EdgeInput> edges, lines;
  std::vector<HoleInput> holes;
  std::vector<NotchInput> notches;
  std::vector<DartInput> darts;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "name of the piece, without dots", .required = true}, self.name);
    field(Field{.key = "mirror_of",
                .meaning = "a piece above, of which this one is the mirror image; its edges keep their names and run "
                           "the other way"},
          self.mirror_of);
    field(Field{.key = "seen_from",
                .meaning = "side of the cloth that the drawing shows; from there on edges run counter-clockwise as "
                           "seen from the outside"},
          self.seen_from);
    field(Field{.key = "grain", .meaning = "the grain line (warp, wales), [[x, y], [x, y]]; left out: along y"},
          self.grain);
    field(Field{.key = "fabric",
                .meaning = "an entry of snug materials list or a table of values; left out: the pattern's"},
          self.fabric);
    field(Field{.key = "edges", .meaning = "the outline, counter-clockwise, one edge after the other"}, self.edges);
    field(Field{.key = "holes", .meaning = "cut-outs"}, self.holes);
    field(Field{.key = "notches", .meaning = "marks on edges"}, self.notches);
    field(Field{.key = "darts", .meaning = "two edges of this piece that are sewn"}, self.darts);
    field(Field{.key = "lines", .meaning = "inner lines, drawn and without effect"}, self.lines);
  }
};

struct SeamInput {
  std::string name, a, b;
  std::optional<double> ease;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "name of the seam; left out: of its edges"}, self.name);
    field(Field{.key = "a",
                .meaning = "edges of one side: \"front.side\", \"back.armhole + front.armhole[0..0.4]\"",
                .required = true},
          self.a);
    field(Field{.key = "b", .meaning = "edges of the other side, which meets it backwards", .required = true}, self.b);
    field(
        Field{.key = "ease",
              .meaning =
                  "how much longer one side is meant to be, of the shorter one (0.6: gathers); left out: at most 0.15",
              .bound = between(0.0, 10.0)},
        self.ease);
  }
};

struct HemInput {
  std::string name, edges;
  input::Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "name", .meaning = "name of the open edge after sewing", .required = true}, self.name);
    field(Field{.key = "edges", .meaning = "its edges: \"front.hem + back.hem\"", .required = true}, self.edges);
  }
};

struct PatternInput {
  std::string title, drawing;
  double unit = 0.0;
  std::optional<input::MaterialEntry> fabric;
  std::vector<PieceInput> pieces;
  std::vector<SeamInput> seams;
  std::vector<HemInput> hems;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "title", .meaning = "what the garment is"}, self.title);
    field(Field{.key = "unit",
                .unit = "m",
                .meaning = "unit of all points of this file, e.g. \"1 mm\"",
                .required = true,
                .bound = positive()},
          self.unit);
    field(Field{.key = "fabric", .meaning = "of pieces that say none; left out: the garment's"}, self.fabric);
    field(Field{.key = "drawing",
                .meaning = "a file beside this one with pieces, .dxf or .svg; those of this file come besides"},
          self.drawing);
    field(Field{.key = "piece", .meaning = "the flat pieces", .one_or_more = true}, self.pieces);
    field(Field{.key = "seam", .meaning = "what is sewn to what", .one_or_more = true}, self.seams);
    field(Field{.key = "hem", .meaning = "names of open edges", .one_or_more = true}, self.hems);
  }
};

}  // namespace snug::mesh
