// Fabrics as test sheets give them: the curve of a strip test, and the sheet of a FAST test.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/table.hpp"
#include "materials/fabric/inputs.hpp"

namespace snug::materials {

/// A point of a tensile curve.
struct CurvePoint {
  double strain = 0.0, force = 0.0;  ///< 1, N/m

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "strain", .meaning = "elongation, 1 = 100 %", .required = true, .bound = non_negative()}, self.strain);
    field(Field{.key = "force", .unit = "N/m", .meaning = "force per width", .required = true, .bound = non_negative()}, self.force);
  }
};

/// law = "curve": nominal force over elongation as a machine has measured it, of warp and weft.
struct CurveFabric {
  std::filesystem::path warp, weft;  ///< tables
  std::vector<CurvePoint> warp_points, weft_points;
  std::optional<double> width, gauge_length;  ///< m, of the strip
  double shear = 0.0;                      ///< N/m
  Sheet sheet;

  /// The same with the points of its tables. Throws input::InputError at the table, or at `where`.
  CurveFabric with_points(const input::Location& where) const;
  /// Has its points.
  Fabric fabric() const;
  /// Nothing where a table ends before the force is back at rest.
  std::optional<Fabric> unloading_fabric() const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "warp", .meaning = "table of a strip test along the warp: a column strain [%] or extension [mm], and force [N] or force [N/m]; unloading in the rows after the largest force, or in a column unloading"}, self.warp);
    field(Field{.key = "weft", .meaning = "the same along the weft"}, self.weft);
    field(Field{.key = "warp_points", .meaning = "instead of a table: { strain = ..., force = \"...\" } a point"}, self.warp_points);
    field(Field{.key = "weft_points", .meaning = "the same of the weft"}, self.weft_points);
    field(Field{.key = "width", .unit = "m", .meaning = "width of the strip, where the table has forces", .bound = positive()}, self.width);
    field(Field{.key = "gauge_length", .unit = "m", .meaning = "free length of the strip, where the table has extensions", .bound = positive()}, self.gauge_length);
    field(Field{.key = "shear", .unit = "N/m", .meaning = "shear stiffness", .required = true, .bound = positive()}, self.shear);
    Sheet::describe(self.sheet, field);
  }
};

/// The tensile part of a FAST-3 test in one direction: extensions in percent at 5, 20 and 100 gf/cm.
struct FastTension {
  std::optional<double> E5, E20;
  double E100 = 0.0;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "E5", .unit = "%", .meaning = "extension at 5 gf/cm (4.9 N/m)", .bound = positive()}, self.E5);
    field(Field{.key = "E20", .unit = "%", .meaning = "extension at 20 gf/cm (19.6 N/m)", .bound = positive()}, self.E20);
    field(Field{.key = "E100", .unit = "%", .meaning = "extension at 100 gf/cm (98.1 N/m)", .required = true, .bound = positive()}, self.E100);
  }
  std::vector<CurvePoint> points() const;
};

/// law = "fast": the sheet of a FAST (SiroFAST) test. Source: De Boos & Tester, SiroFAST: a system for fabric objective measurement,
/// CSIRO Report WT92.02 (1994): shear rigidity G = 123/EB5 N/m with the bias extension EB5 in percent.
struct FastFabric {
  FastTension tension;  ///< warp, and weft unless `weft` is given
  std::optional<FastTension> weft;
  std::optional<double> EB5, G;  ///< percent, N/m; one of the two
  Sheet sheet;

  double shear() const { return G ? *G : 123.0 / *EB5; }
  Fabric fabric() const;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    FastTension::describe(self.tension, field);
    field(Field{.key = "weft", .meaning = "E5, E20, E100 of the weft, where they differ"}, self.weft);
    field(Field{.key = "EB5", .unit = "%", .meaning = "bias extension at 5 gf/cm, from which the shear rigidity follows", .bound = positive()}, self.EB5);
    field(Field{.key = "G", .unit = "N/m", .meaning = "shear rigidity as the sheet prints it, instead of EB5", .bound = positive()}, self.G);
    Sheet::describe(self.sheet, field);
  }
};

/// The curve through points of a test: the loading branch, up to the largest force; noise is taken out so that the force never falls.
/// Throws input::InputError at `where`: fewer than two points, no force, no strain.
TensionCurve curve_through(const std::vector<CurvePoint>& points, const input::Location& where);

/// The curve back from the largest force, through what comes after it in a test of one cycle; nothing where the force does not come back
/// to a fiftieth of it. Cloth keeps some elongation: up to the first hundredth of the force the curve is straight from 0, so that it
/// stays one of cloth with a stiffness.
std::optional<TensionCurve> unloading_curve_through(const std::vector<CurvePoint>& points);

/// The points of a test that its curves go through: loading from rest, and back to rest where the test has it. They give the same curves.
std::vector<CurvePoint> knots_of(const std::vector<CurvePoint>& points, const input::Location& where);

/// A fabric's table in which stiffnesses given as stresses ("2 MPa") are forces per width: times `thickness`. Reports what has none.
input::Table with_forces_per_width(const input::Table& table, input::Diagnostics& diagnostics);

}  // namespace snug::materials
