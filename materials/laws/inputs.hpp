// The forms in which a law of a solid is written down; each becomes a law, and each has its page.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "cases/input/field.hpp"
#include "cases/input/table.hpp"
#include "materials/laws/solid_law.hpp"

namespace snug::materials {

/// What its page says about a law beside its keys.
struct LawPage {
  std::string name;     ///< as in law = "..."
  std::string formula;  ///< plain text
  std::string use;      ///< when to take it and when not
  std::string source;   ///< paper or book
};

/// How little a solid changes its volume: exactly one of the two numbers.
struct Compressibility {
  std::optional<double> poisson_ratio;  ///< of the undeformed state
  std::optional<double> bulk_modulus;   ///< Pa

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "poisson_ratio",
                .meaning = "initial Poisson ratio; this or bulk_modulus",
                .bound = {.low = 0.0, .high = 0.5, .high_open = true}},
          self.poisson_ratio);
    field(Field{.key = "bulk_modulus",
                .unit = "Pa",
                .meaning = "initial bulk modulus (kappa = 2/D1 of other programs); this or poisson_ratio",
                .bound = positive()},
          self.bulk_modulus);
  }
  /// Pa; `shear_modulus` is the initial one.
  double bulk(double shear_modulus) const;
};

/// What every law with split has.
struct VolumeInput {
  Compressibility compressibility;
  std::string form = "barrier";

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    Compressibility::describe(self.compressibility, field);
    field(Field{.key = "volumetric",
                .meaning = "energy of the volume change: barrier k/4 (J^2 - 1 - 2 ln J), logarithmic k/2 (ln J)^2, "
                           "quadratic k/2 (J - 1)^2",
                .choices = {"barrier", "logarithmic", "quadratic"}},
          self.form);
  }
  Volumetric part(double shear_modulus) const;
};

inline input::Field shear_modulus_field() {
  return {.key = "shear_modulus",
          .unit = "Pa",
          .meaning = "initial shear modulus",
          .required = true,
          .bound = input::positive()};
}

struct NeoHookeInput {
  double shear_modulus = 0.0;  ///< Pa
  VolumeInput volume;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(shear_modulus_field(), self.shear_modulus);
    VolumeInput::describe(self.volume, field);
  }
  static LawPage page();
  NeoHooke law() const { return {shear_modulus, volume.part(shear_modulus)}; }
};

struct MooneyRivlinInput {
  double C10 = 0.0, C01 = 0.0;  ///< Pa
  VolumeInput volume;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    const auto coefficient = [](const char* key, const char* invariant) {
      return Field{.key = key,
                   .unit = "Pa",
                   .meaning = std::string("coefficient of the ") + invariant + " invariant",
                   .required = true,
                   .bound = non_negative()};
    };
    field(coefficient("C10", "first"), self.C10);
    field(coefficient("C01", "second"), self.C01);
    VolumeInput::describe(self.volume, field);
  }
  static LawPage page();
  MooneyRivlin law() const { return {C10, C01, volume.part(2.0 * (C10 + C01))}; }
};

struct OgdenTermInput : OgdenTerm {
  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "mu", .unit = "Pa", .meaning = "coefficient of the term", .required = true}, self.mu);
    field(Field{.key = "alpha", .meaning = "exponent of the term, not 0", .required = true}, self.alpha);
  }
};

struct OgdenInput {
  std::vector<OgdenTermInput> terms;
  VolumeInput volume;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "terms",
                .meaning = "one { mu = \"...\", alpha = ... } a term; the shear modulus is half the sum of mu alpha",
                .required = true},
          self.terms);
    VolumeInput::describe(self.volume, field);
  }
  static LawPage page();
  Ogden law() const;
};

struct YeohInput {
  double C10 = 0.0, C20 = 0.0, C30 = 0.0;  ///< Pa
  VolumeInput volume;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "C10", .unit = "Pa", .meaning = "coefficient of x = J^(-2/3) I1 - 3; half the initial shear modulus", .required = true, .bound = positive()},
          self.C10);
    field(Field{.key = "C20", .unit = "Pa", .meaning = "coefficient of x^2; negative where the solid softens first", .required = true}, self.C20);
    field(Field{.key = "C30", .unit = "Pa", .meaning = "coefficient of x^3", .required = true, .bound = non_negative()}, self.C30);
    VolumeInput::describe(self.volume, field);
  }
  static LawPage page();
  Yeoh law() const { return {C10, C20, C30, volume.part(2.0 * C10)}; }
};

struct ArrudaBoyceInput {
  double mu = 0.0;  ///< Pa
  double locking_stretch = 0.0;
  VolumeInput volume;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(Field{.key = "mu", .unit = "Pa", .meaning = "coefficient of the series; less than the initial shear modulus", .required = true, .bound = positive()},
          self.mu);
    field(Field{.key = "locking_stretch",
                .meaning = "lambda_m, stretch at which the chains are straight",
                .required = true,
                .bound = {.low = 1.0, .low_open = true}},
          self.locking_stretch);
    VolumeInput::describe(self.volume, field);
  }
  static LawPage page();
  ArrudaBoyce law() const;
};

struct FungInput {
  double shear_modulus = 0.0;  ///< Pa
  double stiffening = 0.0;
  VolumeInput volume;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(shear_modulus_field(), self.shear_modulus);
    field(Field{.key = "stiffening",
                .meaning = "exponent b: how fast the solid stiffens",
                .required = true,
                .bound = positive()},
          self.stiffening);
    VolumeInput::describe(self.volume, field);
  }
  static LawPage page();
  Fung law() const { return {shear_modulus, stiffening, volume.part(shear_modulus)}; }
};

struct CompressibleNeoHookeInput {
  double shear_modulus = 0.0;  ///< Pa
  Compressibility compressibility;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(shear_modulus_field(), self.shear_modulus);
    Compressibility::describe(self.compressibility, field);
  }
  static LawPage page();
  CompressibleNeoHooke law() const {
    return {shear_modulus, compressibility.bulk(shear_modulus) - 2.0 / 3.0 * shear_modulus};
  }
};

struct LinearElasticInput {
  double youngs_modulus = 0.0;  ///< Pa
  double poisson_ratio = 0.3;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    using namespace input;
    field(
        Field{
            .key = "youngs_modulus", .unit = "Pa", .meaning = "Young's modulus", .required = true, .bound = positive()},
        self.youngs_modulus);
    field(Field{.key = "poisson_ratio",
                .meaning = "Poisson ratio",
                .required = true,
                .bound = {.low = 0.0, .high = 0.5, .high_open = true}},
          self.poisson_ratio);
  }
  static LawPage page();
  LinearElastic law() const { return {youngs_modulus, poisson_ratio}; }
};

/// Calls visit.operator()<Input>() for every form, in the order of the pages. Adding a law is a line here.
template <class Visitor>
void for_each_law_input(Visitor&& visit) {
  visit.template operator()<NeoHookeInput>();
  visit.template operator()<MooneyRivlinInput>();
  visit.template operator()<OgdenInput>();
  visit.template operator()<YeohInput>();
  visit.template operator()<ArrudaBoyceInput>();
  visit.template operator()<FungInput>();
  visit.template operator()<CompressibleNeoHookeInput>();
  visit.template operator()<LinearElasticInput>();
}

/// The names that law = "..." of a tissue may have.
std::vector<std::string> solid_law_names();

/// The law that a table describes; reports unknown laws and keys, wrong values and combinations that are no stable
/// solid, each with its place and remedy. Nothing when something was wrong. `others`: keys that somebody else reads.
/// The form of the law that a right table holds, in SI and with its defaults.
input::Table law_in_si(const input::Table& table);
std::optional<SolidLaw> read_solid_law(const input::Table& table, const std::vector<std::string>& others,
                                       input::Diagnostics& diagnostics);

}  // namespace snug::materials
