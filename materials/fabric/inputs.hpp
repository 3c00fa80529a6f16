// The forms in which a fabric is written down; each becomes a Fabric.
#pragma once

#include <optional>
#include <string>

#include "cases/input/field.hpp"
#include "materials/fabric/fabric.hpp"
#include "materials/fabric/sheet.hpp"

namespace snug::materials {

/// law = "linear": S = stiffness * E in warp and weft.
struct LinearFabric {
  double warp = 0.0, weft = 0.0, shear = 0.0;  ///< N/m
  Sheet sheet;

  Fabric fabric() const;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "warp", .unit = "N/m", .meaning = "warp stiffness", .required = true, .bound = positive()},
          self.warp);
    field(Field{.key = "weft", .unit = "N/m", .meaning = "weft stiffness", .required = true, .bound = positive()},
          self.weft);
    field(Field{.key = "shear", .unit = "N/m", .meaning = "shear stiffness", .required = true, .bound = positive()},
          self.shear);
    Sheet::describe(self.sheet, field);
  }
};

/// law = "cubic": nominal force F = k1 e + k3 e^3, equal in warp and weft.
struct CubicFabric {
  double k1 = 0.0, k3 = 0.0, shear = 0.0;  ///< N/m
  double data_end = 1.0;                   ///< engineering strain
  Sheet sheet;

  Fabric fabric() const;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "k1", .unit = "N/m", .meaning = "linear stiffness", .required = true, .bound = positive()},
          self.k1);
    field(Field{.key = "k3", .unit = "N/m", .meaning = "cubic stiffness", .required = true, .bound = non_negative()},
          self.k3);
    field(Field{.key = "data_end",
                .meaning = "elongation (1 = 100 %) up to which the law holds; straight beyond",
                .bound = positive()},
          self.data_end);
    field(Field{.key = "shear", .unit = "N/m", .meaning = "shear stiffness", .required = true, .bound = positive()},
          self.shear);
    Sheet::describe(self.sheet, field);
  }
};

/// The tensile part of a KES test in one direction.
struct KesTension {
  double LT = 0.0, WT = 0.0;      ///< 1, J/m2
  std::optional<double> Fm = {}, EMT = {};  ///< N/m, percent; one of the two
  std::optional<double> RT = {};             ///< percent

  /// Fm, or 2 WT/(LT EMT).
  double maximum_force() const { return Fm ? *Fm : 200.0 * WT / (LT * *EMT); }
  TensionCurve curve() const { return TensionCurve::kes(LT, WT, maximum_force()); }
  /// From the turning point (EMT, Fm) back to 0, with RT of the work: the exponential of the linearity LT RT/100, which ends at the
  /// same point; beyond it the curve of the way up. RT is given.
  TensionCurve unloading_curve() const { return TensionCurve::kes(0.01 * *RT * LT, 0.01 * *RT * WT, maximum_force()).continued_as(curve()); }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "LT", .meaning = "linearity of the tensile curve", .required = true, .bound = between(0.1, 1.9)},
          self.LT);
    field(Field{.key = "WT", .unit = "J/m2", .meaning = "tensile work", .required = true, .bound = positive()},
          self.WT);
    field(Field{.key = "Fm", .unit = "N/m", .meaning = "largest force of the test", .bound = positive()}, self.Fm);
    field(Field{.key = "EMT", .unit = "%", .meaning = "elongation at Fm in percent, instead of Fm", .bound = positive()}, self.EMT);
    field(Field{.key = "RT",
                .unit = "%",
                .meaning = "tensile resilience in percent: work of the unloading curve over WT; what branch = \"unloading\" needs",
                .bound = {.low = 0.0, .high = 100.0, .low_open = true}},
          self.RT);
  }
};

/// law = "kes": the printed results of a KES-F test.
struct KesFabric {
  KesTension tension;  ///< warp, and weft unless `weft` is given
  std::optional<KesTension> weft;
  double G = 0.0;  ///< N/m per rad
  Sheet sheet;

  Fabric fabric() const;
  /// Nothing where the RT of warp or weft is missing.
  std::optional<Fabric> unloading_fabric() const;
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    KesTension::describe(self.tension, field);
    field(Field{.key = "weft", .meaning = "LT, WT, Fm or EMT, RT of the weft, where they differ"}, self.weft);
    field(Field{.key = "G", .unit = "N/(m rad)", .meaning = "shear stiffness", .required = true, .bound = positive()},
          self.G);
    Sheet::describe(self.sheet, field);
  }
};

}  // namespace snug::materials
