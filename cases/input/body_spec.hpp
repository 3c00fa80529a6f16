// What a case says about the body.
#pragma once

#include <array>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/field.hpp"
#include "cases/input/material_entry.hpp"
#include "cases/input/standard_morph.hpp"

namespace snug::input {

enum class LayerForm { rigid, solid, membrane, shell };
constexpr auto texts_of(LayerForm) { return std::array{"rigid", "solid", "membrane", "shell"}; }

/// An axis of a scanned surface's file.
enum class FileAxis { x, y, z, minus_x, minus_y, minus_z };
constexpr auto texts_of(FileAxis) { return std::array{"x", "y", "z", "-x", "-y", "-z"}; }

enum class BodyKind { stations, scan, imported };
constexpr auto texts_of(BodyKind) { return std::array{"stations", "scan", "imported"}; }

enum class Facets { curved, flat };
constexpr auto texts_of(Facets) { return std::array{"curved", "flat"}; }

/// Displacement/pressure of the cells.
enum class Elements { Q2P1, Q1P0, P2P1 };
constexpr auto texts_of(Elements) { return std::array{"Q2/P1", "Q1/P0", "P2/P1"}; }

/// Cut planes of a limb: no displacement along the axis, free, fixed.
enum class Ends { sliding, free, fixed };
constexpr auto texts_of(Ends) { return std::array{"sliding", "free", "fixed"}; }

/// One layer of the body, listed from the inside out.
struct LayerSpec {
  std::string name;
  MaterialEntry material;
  std::optional<double> thickness;  ///< m; one solid layer may leave it out and takes the rest
  LayerForm form = LayerForm::solid;
  double foundation = 0.0;          ///< Pa/m, under a shell
  int cells = 2;                    ///< hexahedra through the layer (solid)
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name of the layer in results and messages", .required = true}, self.name);
    field(Field{.key = "material",
                .meaning = "\"rigid\", an entry of snug materials list, or a table of values",
                .required = true},
          self.material);
    field(Field{.key = "thickness",
                .unit = "m",
                .meaning = "thickness; exactly one solid layer leaves it out and takes the rest",
                .bound = positive()},
          self.thickness);
    field(Field{.key = "form",
                .meaning = "left out: rigid for the material \"rigid\", membrane for an outermost layer with a "
                           "thickness (skin), solid for the others; shell: surfaces of an imported mesh that stretch and bend"},
          self.form);
    field(Field{.key = "foundation",
                .unit = "Pa/m",
                .meaning = "of a shell: pressure per deflection along its normal that springs under it put up",
                .bound = non_negative()},
          self.foundation);
    field(Field{.key = "cells", .meaning = "hexahedra through a solid layer", .bound = between(1, 40)}, self.cells);
  }
};

/// A named patch of skin, on every kind of body one of three: a sector of angle and range of height, a landmark with a radius, a polygon.
/// Angles count round the centroid of the section's area at the point's own height: 0 = side (+x), 90 deg = front (+y).
struct LocationSpec {
  std::string name;                                              ///< key of the sensation curve, e.g. "Front thigh"
  double from_angle = std::numeric_limits<double>::quiet_NaN();  ///< rad; NaN until it is given
  double to_angle = std::numeric_limits<double>::quiet_NaN();    ///< rad
  std::optional<double> from_height, to_height;                  ///< m
  std::optional<std::array<double, 3>> limb;                     ///< m, of a sector
  std::optional<std::array<double, 3>> at;                       ///< m, of a landmark
  std::optional<double> radius;                                  ///< m
  std::vector<std::array<double, 3>> polygon;                    ///< m
  bool where_there = false;                                      ///< of a standard body: left out where the part that is meshed has it not
  Location where = {};

  bool is_sector() const { return !at && polygon.empty(); }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name",
                .meaning = "name of the location, that of its sensation curve, e.g. \"Front thigh\"",
                .required = true},
          self.name);
    field(Field{.key = "from_angle",
                .unit = "rad",
                .meaning = "begin of the sector, round the middle of the section at each height; 0 deg = side (+x), 90 deg = front (+y)",
                .bound = between(-7, 7)},
          self.from_angle);
    field(Field{.key = "to_angle",
                .unit = "rad",
                .meaning = "end of the sector, counter-clockwise from its begin",
                .bound = between(-7, 7)},
          self.to_angle);
    field(Field{.key = "from_height", .unit = "m", .meaning = "lower end; left out: the lower cut"}, self.from_height);
    field(Field{.key = "to_height", .unit = "m", .meaning = "upper end; left out: the upper cut"}, self.to_height);
    field(Field{.key = "limb", .unit = "m", .meaning = "a point in the limb of the sector, where the body has several: angles count round that one alone"}, self.limb);
    field(Field{.key = "at", .unit = "m", .meaning = "instead of a sector: a landmark, whose nearest point of the skin is the middle of the patch"}, self.at);
    field(Field{.key = "radius", .unit = "m", .meaning = "of the patch round a landmark, along the skin", .bound = positive()}, self.radius);
    field(Field{.key = "polygon", .unit = "m", .meaning = "instead of a sector: landmarks along the border of the patch, in the frame of the body"}, self.polygon);
  }
};

/// Bone outline for scans: an ellipse that follows the limb's centre line.
struct BoneSpec {
  double girth = 0.0;  ///< m
  double width_to_depth = 1.0;
  std::array<double, 2> offset = {0.0, 0.0};  ///< m, from the section's centroid (x, y)

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "girth", .unit = "m", .meaning = "girth of the bone", .required = true, .bound = positive()},
          self.girth);
    field(Field{.key = "width_to_depth", .meaning = "width (x) over depth (y)", .bound = between(0.2, 5)},
          self.width_to_depth);
    field(Field{.key = "offset", .unit = "m", .meaning = "centre of the bone from the centroid of the section (x, y)"},
          self.offset);
  }
};

/// A plane that cuts a scanned surface (point and outward normal in the frame of the body, metres).
struct CutPlane {
  std::array<double, 3> point = {0, 0, 0};
  std::array<double, 3> normal = {0, 0, 1};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "point", .unit = "m", .meaning = "a point of the plane, in the file's frame", .required = true},
          self.point);
    field(Field{.key = "normal",
                .meaning = "direction out of the piece that is kept, in the file's frame",
                .required = true},
          self.normal);
  }
};

/// A cut with a name through one limb of a scan; what hangs on beyond it falls away.
struct NamedCut {
  static constexpr double open = std::numeric_limits<double>::quiet_NaN();  ///< until it is given, or known from a standard body

  std::string name;
  std::array<double, 3> point = {open, open, open};
  std::array<double, 3> normal = {open, open, open};
  Location where = {};

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "name", .meaning = "name of the cut and of the surface it leaves, e.g. \"waist\" or \"thigh left\"", .required = true}, self.name);
    field(Field{.key = "point",
                .unit = "m",
                .meaning = "a point of the plane, in the file's frame, inside the limb that is cut: other limbs that the plane meets stay whole; left out: "
                           "that of the standard body's cut of this name"},
          self.point);
    field(Field{.key = "normal",
                .meaning = "direction out of the piece that is kept, in the file's frame; left out: that of the standard body's cut of this name, out of the "
                           "part that all the cuts border on"},
          self.normal);
  }
};

/// A place where the core of a body lies at another depth.
struct CorePlace {
  std::array<double, 3> at = {0, 0, 0};  ///< m, in the file's frame
  double radius = 0.0;                   ///< m
  double thickness = 0.0;                ///< m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "at", .unit = "m", .meaning = "the place, in the file's frame", .required = true}, self.at);
    field(Field{.key = "radius", .unit = "m", .meaning = "how far it reaches: at this distance two fifths of the difference are left", .required = true, .bound = positive()}, self.radius);
    field(Field{.key = "thickness", .unit = "m", .meaning = "thickness of all tissue there", .required = true, .bound = positive()}, self.thickness);
  }
};

/// What a body of tetrahedra has inside: surfaces of a file, or all that is deeper than the tissue.
struct CoreSpec {
  std::filesystem::path surface;
  std::optional<double> thickness;  ///< m
  std::vector<CorePlace> places;
  std::optional<double> cell_size;  ///< m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "surface", .meaning = "file of closed surfaces (bones), in the scan's unit and axes; or give a thickness"}, self.surface);
    field(Field{.key = "thickness", .unit = "m", .meaning = "thickness of all tissue between skin and core", .bound = positive()}, self.thickness);
    field(Field{.key = "place", .meaning = "places with another thickness", .one_or_more = true}, self.places);
    field(Field{.key = "cell_size", .unit = "m", .meaning = "edges of the cells at the core; left out: 1.5 times those of the skin", .bound = positive()}, self.cell_size);
  }
};

/// What a scan becomes.
enum class ScanCells { automatic, hexahedra, tetrahedra };
constexpr auto texts_of(ScanCells) { return std::array{"auto", "hexahedra", "tetrahedra"}; }

struct ScanSpec {
  std::string standard;               ///< name of a body that ships; then `surface`, unit and axes are its own
  std::optional<double> stature;      ///< m, of the standard body
  std::vector<GirthSpec> girths;      ///< that are asked of it
  std::optional<BodyMorph> morph;     ///< what follows from both; not in the file
  std::filesystem::path surface;      ///< OBJ, STL, PLY, OFF or v/f text
  std::optional<double> unit;         ///< metres per file unit; guessed from the size where it is left out
  FileAxis up = FileAxis::z, front = FileAxis::y;  ///< that become +z and +y
  std::optional<CutPlane> lower, upper;  ///< in the file's frame, in metres; used where `cuts` is empty
  std::vector<NamedCut> cuts;
  double smoothing_radius = 0.0;      ///< m; 0 = two cell widths of hexahedra, one of tetrahedra
  std::optional<BoneSpec> bone;
  std::optional<CoreSpec> core;
  ScanCells cells = ScanCells::automatic;
  double cell_size = 0.0;             ///< m, edges of tetrahedra at the skin; 0 = the girth of the narrowest cut / 32
  double fill_holes = 0.03;           ///< m, largest diameter
  double wrap = 0.0;                  ///< m, gaps narrower than this are bridged; 0 = only where the scan cuts itself too badly

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "standard",
                .meaning = "instead of a surface: a body that ships, \"woman\" or \"man\", with unit, axes, cuts by name and locations (snug list bodies)"},
          self.standard);
    field(Field{.key = "stature", .unit = "m", .meaning = "of a standard body: its height; heights go by it, girths do not", .bound = positive()}, self.stature);
    field(Field{.key = "girth", .meaning = "of a standard body: girths that it gets, e.g. girth = [{ at = \"waist\", length = \"720 mm\" }, { at = \"knee\", length = \"350 mm\" }]; "
                           "those not named go along with their neighbours"},
          self.girths);
    field(Field{.key = "surface", .meaning = "file of the scanned surface: OBJ, STL, PLY, OFF or v/f text"}, self.surface);
    field(Field{.key = "unit",
                .unit = "m",
                .meaning = "length of one unit of the file, e.g. \"1 mm\"; left out: m, cm or mm, whichever makes the size that of a body",
                .bound = positive()},
          self.unit);
    field(Field{.key = "up", .meaning = "axis of the file that points up"}, self.up);
    field(Field{.key = "front", .meaning = "axis of the file that points to the front"}, self.front);
    field(Field{.key = "lower", .meaning = "plane of the lower cut; with upper, of one limb; or name the cuts: [[body.scan.cut]]"}, self.lower);
    field(Field{.key = "upper", .meaning = "plane of the upper cut"}, self.upper);
    field(Field{.key = "smoothing_radius",
                .unit = "m",
                .meaning = "noise shorter than this is smoothed; 0 m: two cell widths of hexahedra, one of tetrahedra",
                .bound = non_negative()},
          self.smoothing_radius);
    field(Field{.key = "cut", .meaning = "planes with names that part the body from what is not meshed; of a standard body names are enough: "
                           "cut = [\"waist\", \"ankle left\", \"ankle right\"]",
                .text_key = "name",
                .one_or_more = true},
          self.cuts);
    field(Field{.key = "bone", .meaning = "outline of the bone of one limb"}, self.bone);
    field(Field{.key = "core", .meaning = "what a body of tetrahedra has inside; left out: the bone's outline, where that is given"}, self.core);
    field(Field{.key = "cells",
                .meaning = "auto: hexahedra where one limb lies between two cuts and has a bone outline, tetrahedra otherwise, for bodies that branch"},
          self.cells);
    field(Field{.key = "cell_size", .unit = "m", .meaning = "edges of tetrahedra at the skin; 0 m: the girth of the narrowest cut / 32", .bound = non_negative()}, self.cell_size);
    field(Field{.key = "fill_holes", .unit = "m", .meaning = "holes up to this diameter are filled", .bound = non_negative()}, self.fill_holes);
    field(Field{.key = "wrap",
                .unit = "m",
                .meaning = "the surface is wrapped (gaps narrower than this are bridged) and drawn back on the scan; 0 m: only where it cuts itself so that nothing else helps",
                .bound = non_negative()},
          self.wrap);
  }
};

struct BodySpec {
  BodyKind kind = BodyKind::stations;
  std::filesystem::path stations;  ///< table of girths, or JSON of outlines
  std::filesystem::path mesh;      ///< gmsh file
  double unit = 1.0;               ///< metres per unit of that file
  double force_unit = 1.0;         ///< N per unit of force of that file
  std::optional<int> load_step;    ///< of that file, from 1; the last where it is left out
  std::optional<ScanSpec> scan;
  std::vector<LayerSpec> layers;
  std::vector<LocationSpec> locations;
  int cells_around = 24, cells_along = 12;
  Facets facets = Facets::curved;
  Elements elements = Elements::Q2P1;
  Ends ends = Ends::sliding;
  Location where;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(Field{.key = "kind",
                .meaning = "stations: girths along an axis; scan: a surface and two cut planes; imported: a mesh of cells"},
          self.kind);
    field(Field{.key = "stations",
                .meaning = "CSV file (or the first sheet of an .xlsx one) of the girths: height, girth, width_to_depth, centre_x, centre_y, "
                           "bone_girth, bone_width_to_depth, bone_x, bone_y. Or a JSON file of nets \"skin\" and \"bone\" (docs/curves.md): points of sections"},
          self.stations);
    field(Field{.key = "mesh",
                .meaning = "gmsh file (.msh) with hexahedra or tetrahedra, or a geometry (.geo) for gmsh to mesh; its physical "
                           "volumes are the layers by their names, its physical surfaces, curves and points the named surfaces "
                           "(\"skin\" is where a garment touches). Or APDL text or CDB (.cdb, .mac, .txt), CalculiX or Abaqus input "
                           "(.inp) or a FEBio model (.feb) with its materials, forces, supports and pressures; node sets are the named surfaces"},
          self.mesh);
    field(Field{.key = "unit",
                .unit = "m",
                .meaning = "length of one unit of the mesh file, e.g. \"1 mm\"",
                .bound = positive()},
          self.unit);
    field(Field{.key = "force_unit",
                .unit = "N",
                .meaning = "force of one unit of an APDL or CalculiX file, e.g. \"1 mN\"; its stresses are force_unit/unit^2",
                .bound = positive()},
          self.force_unit);
    field(Field{.key = "load_step",
                .meaning = "of a model file with several load steps the one whose end is taken, counted from 1; left out: the last",
                .bound = between(1, 1e6)},
          self.load_step);
    field(Field{.key = "scan", .meaning = "surface, cut planes and bone of a scan"}, self.scan);
    field(Field{.key = "layers",
                .meaning = "the layers from the inside out; of an APDL or CalculiX file: other materials for those it names"},
          self.layers);
    field(Field{.key = "locations", .meaning = "named patches of skin whose pressure is reported; left out on a standard body: its own"}, self.locations);
    field(Field{.key = "cells_around", .meaning = "hexahedra round the body", .bound = between(8, 720)},
          self.cells_around);
    field(Field{.key = "cells_along", .meaning = "hexahedra along the body", .bound = between(1, 720)},
          self.cells_along);
    field(Field{.key = "facets",
                .meaning = "curved: the cells follow the body; flat: straight edges between corners, to see what "
                           "curved ones bring"},
          self.facets);
    field(Field{.key = "elements",
                .meaning = "displacement/pressure of the cells. Q2/P1: quadratic hexahedra; Q1/P0: linear hexahedra, a "
                           "fast preview; P2/P1: quadratic tetrahedra, six in each hexahedron. Tetrahedra of a mesh file "
                           "are P2/P1"},
          self.elements);
    field(Field{.key = "ends",
                .meaning = "cut planes of a limb: sliding (no displacement along the axis), free or fixed"},
          self.ends);
  }
};

}  // namespace snug::input
