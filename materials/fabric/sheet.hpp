// What a test sheet says of a fabric beside its tensile curve: bending, hysteresis, compression and surface.
#pragma once

#include <optional>

#include "cases/input/field.hpp"
#include "materials/fabric/fabric.hpp"

namespace snug::materials {

/// Width of the loop of a cyclic test, which is twice the friction: force = stiffness x angle + half of it on the way
/// up, - half of it on the way down. Data only: which sign acts at a place depends on how it was sheared last, which a
/// garment at rest does not say.
struct Hysteresis {
  std::optional<double> shear;       ///< 2HG, N/m, at 0.5 degrees
  std::optional<double> wide_shear;  ///< 2HG5, N/m, at 5 degrees
  std::optional<double> bending;     ///< 2HB, N

  /// Half the width of the shear loop (N/m) at an angle (rad): straight between 0.5 and 5 degrees, constant outside; 0
  /// where neither was measured.
  double half_shear(double angle) const;
};

/// Compression through the thickness, KES: T0 at 0.5 gf/cm2, Tm at the largest pressure Pm.
struct Compression {
  std::optional<double> LC = {}, WC = {}, RC = {};  ///< 1, J/m2, percent
  std::optional<double> T0 = {}, Tm = {}, Pm = {};  ///< m, m, Pa; Pm left out: 50 gf/cm2

  double largest_pressure() const { return Pm.value_or(50.0 * 98.0665); }
  /// By how much the thickness decreases up to Pm, m: T0 - Tm, or what the work of a curve of this linearity leads to,
  /// 2 WC/(LC Pm).
  std::optional<double> decrease() const;
};

/// Thickness (m) under a pressure (Pa), by the exponential of the tensile curve: pressure over T0 - T has the linearity
/// LC and ends at Pm; it begins without pressure at T0, which KES reads at a hundredth of Pm. `thickness` stands for a
/// T0 that is not given. Nothing where LC, the thickness or the decrease is not known, where the decrease is not less
/// than the thickness, which no cloth does, and outside 0 to Pm.
std::optional<double> thickness_under(double pressure, const Compression& compression, double thickness);

/// What every form of fabric has.
struct Sheet {
  double poisson = 0.0;
  double weight = 0.0, thickness = 0.0, bending = 0.0;  ///< kg/m2, m, N m
  std::optional<double> MIU;
  std::optional<double> bending_weft;  ///< N m
  Hysteresis hysteresis;
  Compression compression;
  std::optional<double> MMD, SMD;  ///< 1, m

  BendingStiffness bending_stiffness() const { return {bending, bending_weft.value_or(bending)}; }

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "poisson",
                .meaning = "coupling of warp and weft by the smallest stiffness",
                .bound = {.low = 0.0, .high = 1.0, .high_open = true}},
          self.poisson);
    field(Field{.key = "weight", .unit = "kg/m2", .meaning = "mass per area", .bound = non_negative()}, self.weight);
    field(Field{.key = "thickness", .unit = "m", .meaning = "thickness", .bound = non_negative()}, self.thickness);
    field(Field{.key = "B",
                .unit = "N m",
                .meaning = "bending stiffness per width, of cloth that stands off the skin",
                .bound = non_negative()},
          self.bending);
    field(Field{.key = "MIU",
                .meaning = "mean coefficient of surface friction; what contact.friction is where the case does not say",
                .bound = between(0.0, 2.0)},
          self.MIU);
    field(Field{.key = "B_weft",
                .unit = "N m",
                .meaning = "bending stiffness of the weft, where it differs",
                .bound = positive()},
          self.bending_weft);
    describe_data(self, field);
  }

 private:
  /// Read and kept; no run computes with them.
  template <class Self, class Visitor>
  static void describe_data(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "2HG",
                .unit = "N/m",
                .meaning = "hysteresis of shear at 0.5 degrees (data)",
                .bound = non_negative()},
          self.hysteresis.shear);
    field(Field{.key = "2HG5",
                .unit = "N/m",
                .meaning = "hysteresis of shear at 5 degrees (data)",
                .bound = non_negative()},
          self.hysteresis.wide_shear);
    field(Field{.key = "2HB", .unit = "N", .meaning = "hysteresis of bending (data)", .bound = non_negative()},
          self.hysteresis.bending);
    field(Field{.key = "LC", .meaning = "linearity of the compression curve (data)", .bound = positive()},
          self.compression.LC);
    field(Field{.key = "WC", .unit = "J/m2", .meaning = "work of compression (data)", .bound = positive()},
          self.compression.WC);
    field(Field{.key = "RC",
                .unit = "%",
                .meaning = "resilience of compression in percent (data)",
                .bound = between(0.0, 100.0)},
          self.compression.RC);
    field(Field{.key = "T0", .unit = "m", .meaning = "thickness at 0.5 gf/cm2 (data)", .bound = positive()},
          self.compression.T0);
    field(Field{.key = "Tm",
                .unit = "m",
                .meaning = "thickness at the largest pressure of the test (data)",
                .bound = positive()},
          self.compression.Tm);
    field(Field{.key = "Pm",
                .unit = "Pa",
                .meaning = "largest pressure of the compression test (data); left out: 50 gf/cm2",
                .bound = positive()},
          self.compression.Pm);
    field(Field{.key = "MMD", .meaning = "mean deviation of MIU (data)", .bound = non_negative()}, self.MMD);
    field(Field{.key = "SMD",
                .unit = "m",
                .meaning = "mean deviation of the surface's height (data)",
                .bound = non_negative()},
          self.SMD);
  }
};

}  // namespace snug::materials
