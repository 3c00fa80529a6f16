// What a case says about the garment.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/material_entry.hpp"

namespace snug::input {

enum class PatternKind { tube, sewn, graduated };
constexpr auto texts_of(PatternKind) { return std::array{"tube", "sewn", "graduated"}; }

/// Direction against the body's axis.
enum class WarpDirection { along, around };
constexpr auto texts_of(WarpDirection) { return std::array{"along", "around"}; }

/// Displacement that a held edge has not: along the skin in the direction of the axis, or any.
enum class HeldDirection { axis, all };
constexpr auto texts_of(HeldDirection) { return std::array{"axis", "all"}; }

/// Circumference of a graduated tube at a height of it.
struct GirthRow {
  double height = 0.0;  ///< m, over its lower edge
  double girth = 0.0;   ///< m, without tension
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "height", .unit = "m", .meaning = "over the lower edge, as knitted", .required = true, .bound = non_negative()}, self.height);
    field(Field{.key = "girth", .unit = "m", .meaning = "circumference there, without tension", .required = true, .bound = positive()}, self.girth);
  }
};

/// Pressure that a graduated tube is made for.
struct PressureRow {
  double height = 0.0;    ///< m, over its lower edge
  double pressure = 0.0;  ///< Pa, mean round the limb
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "height", .unit = "m", .meaning = "over the lower edge, as knitted", .required = true, .bound = non_negative()}, self.height);
    field(Field{.key = "pressure", .unit = "Pa", .meaning = "on the skin there, mean round the limb", .required = true, .bound = positive()}, self.pressure);
  }
};

struct PatternSpec {
  PatternKind kind = PatternKind::tube;
  double flat_circumference = 0.0;   ///< m, of a tube
  double length = 0.0;               ///< m, of a tube
  std::vector<GirthRow> circumferences;  ///< of a graduated tube, from below
  std::vector<PressureRow> pressures;    ///< that a graduated tube is made for, from below
  std::filesystem::path file;        ///< of a sewn pattern
  std::vector<std::string> pieces;   ///< of the file that are worn; none: all
  double from_height = 0.0;              ///< m over the lowest point of each piece: what lies between is worn
  std::optional<double> to_height;
  double girth_scale = 1.0, length_scale = 1.0;
  Location where = {};

  bool sewn() const { return kind == PatternKind::sewn; }
  bool graduated() const { return kind == PatternKind::graduated; }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "kind", .meaning = "tube: a rectangle sewn along its length; graduated: knitted round, each course with a length of its own; sewn: the "
                                       "pieces and seams of a file (taken where file is given)"},
          self.kind);
    field(Field{.key = "flat_circumference", .unit = "m", .meaning = "circumference of the tube as cut, without tension", .bound = non_negative()},
          self.flat_circumference);
    field(Field{.key = "length", .unit = "m", .meaning = "length of the tube as cut", .bound = non_negative()}, self.length);
    field(Field{.key = "circumferences",
                .meaning = "of a graduated tube: its circumferences from the lower edge up, [{ height = \"0 mm\", girth = \"180 mm\" }, …]; smooth between "
                           "them, beyond them as at the ends"},
          self.circumferences);
    field(Field{.key = "pressures",
                .meaning = "of a graduated tube: the pressures that it is made for, [{ height = \"0 mm\", pressure = \"20 mmHg\" }, …], straight between "
                           "them; without circumferences these come from the law of Laplace, and snug design finds better ones"},
          self.pressures);
    field(Field{.key = "file",
                .meaning = "sewing pattern: .toml (docs/patterns.md), .json (GarmentCode), .dxf or .svg; pattern = \"FILE\" is the same"},
          self.file);
    field(Field{.key = "pieces", .meaning = "names of the pieces of the file that are worn; left out: all of them"}, self.pieces);
    field(Field{.key = "from_height", .unit = "m", .meaning = "what is worn of each piece begins at this height over the lowest point of its drawing", .bound = non_negative()},
          self.from_height);
    field(Field{.key = "to_height", .unit = "m", .meaning = "and ends at this one; left out: at its highest point", .bound = positive()}, self.to_height);
    field(Field{.key = "girth_scale", .meaning = "factor across the drawings of the pieces: 0.9 is a tenth smaller round", .bound = between(0.2, 5.0)},
          self.girth_scale);
    field(Field{.key = "length_scale", .meaning = "factor along the drawings of the pieces", .bound = between(0.2, 5.0)}, self.length_scale);
  }
};

struct HeldEdge {
  std::string edge;           ///< of a tube: upper | lower
  HeldDirection held = HeldDirection::axis;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "edge", .meaning = "open edge of the garment: \"upper\" or \"lower\" of a tube; of a pattern what it calls it", .required = true},
          self.edge);
    field(Field{.key = "held",
                .meaning = "axis: no displacement along the skin in the direction of the body's axis; all: none at all"},
          self.held);
  }
};

/// An elastic band sewn along an edge.
struct BandSpec {
  std::string edge;
  std::string rest_length;     ///< "-8 %" of the edge on the pattern, or a length
  double stiffness = 0.0;      ///< N/m, force over strain and width
  double width = 0.0;          ///< m
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "edge", .meaning = "edge of the garment that it is sewn along", .required = true}, self.edge);
    field(Field{.key = "rest_length",
                .meaning = "its length without tension: against the edge as cut (\"-8 %\": as much shorter), or a length (\"310 mm\")",
                .required = true},
          self.rest_length);
    field(Field{.key = "stiffness", .unit = "N/m", .meaning = "force of a strain of 1, over its width", .required = true, .bound = positive()}, self.stiffness);
    field(Field{.key = "width", .unit = "m", .meaning = "width of the band", .required = true, .bound = positive()}, self.width);
  }
};

/// A part of a garment that is of another fabric.
struct ZoneSpec {
  std::vector<std::string> pieces;  ///< of a sewn pattern
  double from_height = 0.0;         ///< m, over the lower edge of a tube
  std::optional<double> to_height;  ///< m; none: to its upper edge
  MaterialEntry fabric;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "pieces", .meaning = "pieces of a sewing pattern that are of this fabric, instead of the one that the pattern has for them"}, self.pieces);
    field(Field{.key = "from_height", .unit = "m", .meaning = "of a tube: the zone begins at this height over its lower edge, as knitted", .bound = non_negative()},
          self.from_height);
    field(Field{.key = "to_height", .unit = "m", .meaning = "and ends at this one; left out: at the upper edge", .bound = positive()}, self.to_height);
    field(Field{.key = "fabric", .meaning = "an entry of snug materials list or a table of values", .required = true}, self.fabric);
  }
};

/// A control net that the garment is placed on, instead of on the skin.
struct ShapeSpec {
  std::filesystem::path net;  ///< a file of nets (docs/curves.md)
  std::string name;           ///< of the net in it; empty: its only one
  int subdivide = 3;
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "net", .meaning = "JSON file of curves and nets (docs/curves.md): points round the body, row over row", .required = true}, self.net);
    field(Field{.key = "name", .meaning = "of the net in the file; left out: the only one"}, self.name);
    field(Field{.key = "subdivide", .meaning = "steps of the four-point scheme that make the net a surface", .bound = between(0, 6)}, self.subdivide);
  }
};

/// Rest length (m) of a band along an edge that is `pattern_length` (m) as cut; empty where the text is neither a percentage nor
/// a length.
std::optional<double> rest_length(const BandSpec& band, double pattern_length);

struct GarmentSpec {
  std::string name = "garment";
  PatternSpec pattern;
  MaterialEntry fabric;
  FabricBranch branch = FabricBranch::loading;
  WarpDirection warp = WarpDirection::along;
  std::optional<double> position;  ///< m; height of the lowest point as placed
  std::optional<double> seam;  ///< rad; where it lies round the limb
  std::string bottom;          ///< open edge of a sewn pattern that lies lowest
  double cell_size = 0.0;      ///< m, on the pattern; 0 = by the skin's cells
  int order = 2;               ///< of the triangles
  std::optional<bool> bending, weight;
  std::vector<HeldEdge> held;
  std::vector<BandSpec> band;
  std::vector<ZoneSpec> zone;  ///< once the pattern is read, those that it names, too
  std::optional<ShapeSpec> shape;
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name in results and contacts, its own where there are several garments"}, self.name);
    field(Field{.key = "pattern", .meaning = "the pieces as cut: a table, or the file of a sewing pattern", .required = true, .text_key = "file"},
          self.pattern);
    field(Field{.key = "fabric", .meaning = "an entry of snug materials list or a table of values; left out: the pattern's"}, self.fabric);
    field(Field{.key = "branch", .meaning = "curve of the fabric that the garment runs on: loading, or unloading after it was stretched further"}, self.branch);
    field(Field{.key = "warp", .meaning = "warp (wale) direction against the body's axis"}, self.warp);
    field(Field{.key = "position", .unit = "m",
                .meaning = "height of the lowest point as placed; may be left out on a body that branches, where crotch, shoulders or waist tell it"},
          self.position);
    field(Field{.key = "seam",
                .unit = "rad",
                .meaning = "angle at which the (first) seam lies round the limb: 0 = side (+x), 90 deg = front (+y); left out: 180 deg, and "
                           "of a pattern with pieces called front or back where these come to lie there"},
          self.seam);
    field(Field{.key = "shape", .meaning = "control net round one limb that the garment is placed on before it tightens; left out: the skin", .text_key = "net"}, self.shape);
    field(Field{.key = "bottom", .meaning = "open edge of a pattern that lies lowest; left out: the one that its drawing has lowest"}, self.bottom);
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
                           "is wider than the body as placed or lies on shoulders"},
          self.bending);
    field(Field{.key = "weight",
                .meaning = "true: the fabric's weight is part of the scene, along load.gravity or else down the body's axis; "
                           "left out: where a part of the garment is wider than the body as placed"},
          self.weight);
    field(Field{.key = "held", .meaning = "edges that the wearer or the rest of a garment holds"}, self.held);
    field(Field{.key = "band", .meaning = "elastic bands along edges", .one_or_more = true}, self.band);
    field(Field{.key = "zone", .meaning = "parts of the garment that are of another fabric: pieces of a pattern, or heights of a tube", .one_or_more = true},
          self.zone);
  }
};

/// m, the height at which the lowest point is placed. Throws InputError where the case does not say it.
double lowest_point(const GarmentSpec& garment);

}  // namespace snug::input
