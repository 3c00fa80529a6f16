#include "materials/laws/inputs.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"

namespace snug::materials {
namespace {

// Beyond this Poisson ratio an element whose only unknowns are displacements locks.
constexpr double largest_unsplit_poisson_ratio = 0.495;
constexpr const char* split_remedy =
    "use a law with split (neo-Hooke, Mooney-Rivlin, Ogden, Yeoh, Arruda-Boyce, Fung), whose mixed element does not lock";

double poisson_ratio(double mu, double kappa) { return (3.0 * kappa - 2.0 * mu) / (2.0 * (3.0 * kappa + mu)); }

void check(const Compressibility& c, double mu, const input::Table& table, input::Diagnostics& diagnostics) {
  if (c.poisson_ratio.has_value() == c.bulk_modulus.has_value())
    return diagnostics.error(
        table.where,
        c.poisson_ratio ? "both poisson_ratio and bulk_modulus are given"
                        : "neither poisson_ratio nor bulk_modulus is given",
        "write one of them, for instance poisson_ratio = 0.49; the other follows from the shear modulus");
  if (c.bulk_modulus && *c.bulk_modulus < 2.0 / 3.0 * mu)
    diagnostics.error(table.where_is("bulk_modulus"),
                      fmt::format("the bulk modulus {} Pa makes the Poisson ratio {:.3g}", *c.bulk_modulus,
                                  poisson_ratio(mu, *c.bulk_modulus)),
                      fmt::format("give at least two thirds of the shear modulus, {:.6g} Pa", 2.0 / 3.0 * mu));
}
void check_unsplit(double nu, const input::Location& where, input::Diagnostics& diagnostics) {
  if (nu > largest_unsplit_poisson_ratio)
    diagnostics.error(where, fmt::format("a Poisson ratio of {:.6g} in a law without split", nu),
                      fmt::format("give at most {}, or {}", largest_unsplit_poisson_ratio, split_remedy));
}

void check(const NeoHookeInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  check(form.volume.compressibility, form.shear_modulus, table, diagnostics);
}
void check(const YeohInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  // dW/dx = C10 + 2 C20 x + 3 C30 x^2 has no zero at x > 0.
  if (form.C20 < 0.0 && !(form.C20 * form.C20 < 3.0 * form.C10 * form.C30))
    diagnostics.error(table.where_is("C20"), fmt::format("with C20 = {} Pa the solid loses its stiffness at a finite stretch", form.C20),
                      fmt::format("a negative C20 must be smaller than sqrt(3 C10 C30) = {:.6g} Pa", std::sqrt(3.0 * form.C10 * form.C30)));
  check(form.volume.compressibility, 2.0 * form.C10, table, diagnostics);
}
void check(const ArrudaBoyceInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  check(form.volume.compressibility, ArrudaBoyce{form.mu, form.locking_stretch, {}}.initial_shear_modulus(), table, diagnostics);
}
void check(const FungInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  check(form.volume.compressibility, form.shear_modulus, table, diagnostics);
}
void check(const MooneyRivlinInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  const double mu = 2.0 * (form.C10 + form.C01);
  if (!(mu > 0.0))
    return diagnostics.error(table.where, "C10 and C01 are both 0",
                             "give one of them; the shear modulus is 2 (C10 + C01)");
  check(form.volume.compressibility, mu, table, diagnostics);
}
void check(const OgdenInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  const input::Location where = table.where_is("terms");
  if (form.terms.empty())
    return diagnostics.error(where, "terms is empty", "give at least one, e.g. { mu = \"2 kPa\", alpha = 8 }");
  const auto& places = *table.find("terms")->array();
  double mu = 0.0;
  for (std::size_t p = 0; p < form.terms.size(); ++p) {
    if (form.terms[p].alpha == 0.0)
      diagnostics.error(places[p].where, "alpha is 0", "a term with alpha 0 stores nothing: leave it out");
    mu += 0.5 * form.terms[p].mu * form.terms[p].alpha;
  }
  if (!(mu > 0.0))
    return diagnostics.error(
        where, fmt::format("the terms make the shear modulus {:.6g} Pa at rest", mu),
        "half the sum of mu alpha must be greater than 0: a term with negative alpha has a negative mu");
  check(form.volume.compressibility, mu, table, diagnostics);
}
void check(const CompressibleNeoHookeInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  check(form.compressibility, form.shear_modulus, table, diagnostics);
  if (diagnostics.any()) return;
  const bool bulk = form.compressibility.bulk_modulus.has_value();
  check_unsplit(bulk ? poisson_ratio(form.shear_modulus, *form.compressibility.bulk_modulus)
                     : *form.compressibility.poisson_ratio,
                table.where_is(bulk ? "bulk_modulus" : "poisson_ratio"), diagnostics);
}
void check(const LinearElasticInput& form, const input::Table& table, input::Diagnostics& diagnostics) {
  check_unsplit(form.poisson_ratio, table.where_is("poisson_ratio"), diagnostics);
}

}  // namespace

double Compressibility::bulk(double mu) const {
  if (bulk_modulus) return *bulk_modulus;
  return 2.0 * mu * (1.0 + *poisson_ratio) / (3.0 * (1.0 - 2.0 * *poisson_ratio));
}

Volumetric VolumeInput::part(double shear_modulus) const {
  const auto chosen = form == "logarithmic" ? VolumetricForm::logarithmic
                      : form == "quadratic" ? VolumetricForm::quadratic
                                            : VolumetricForm::barrier;
  return {chosen, compressibility.bulk(shear_modulus)};
}

Ogden OgdenInput::law() const {
  Ogden law;
  law.terms.assign(terms.begin(), terms.end());
  law.volume = volume.part(law.initial_shear_modulus());
  return law;
}

ArrudaBoyce ArrudaBoyceInput::law() const {
  ArrudaBoyce law{mu, locking_stretch, {}};
  law.volume = volume.part(law.initial_shear_modulus());
  return law;
}

std::vector<std::string> solid_law_names() {
  std::vector<std::string> names;
  for_each_law_input([&]<class Input>() { names.push_back(Input::page().name); });
  return names;
}

input::Table law_in_si(const input::Table& table) {
  input::Diagnostics diagnostics;
  input::Table written;
  const std::string name = input::read_choice(table, "law", solid_law_names(), diagnostics);
  for_each_law_input([&]<class Input>() {
    if (Input::page().name == name) written = input::to_table(input::read<Input>(table, diagnostics, {.also_known = table.keys()}));
  });
  return written;
}

std::optional<SolidLaw> read_solid_law(const input::Table& table, const std::vector<std::string>& others,
                                       input::Diagnostics& diagnostics) {
  const std::string name = input::read_choice(table, "law", solid_law_names(), diagnostics);
  if (diagnostics.any()) return std::nullopt;
  std::optional<SolidLaw> law;
  for_each_law_input([&]<class Input>() {
    if (Input::page().name != name) return;
    const auto form = input::read<Input>(table, diagnostics, {.also_known = others});
    if (!diagnostics.any()) check(form, table, diagnostics);
    if (!diagnostics.any()) law = form.law();
  });
  return law;
}

}  // namespace snug::materials
