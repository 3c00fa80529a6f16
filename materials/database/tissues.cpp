#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"
#include "materials/database/shipped.hpp"
#include "materials/laws/inputs.hpp"

namespace snug::materials {
namespace {

// Parsed once: it never changes.
const input::Table& shipped() {
  static const input::Table all = input::table_of(shipped_tissues, {"materials/data/tissues.toml", 1, 1});
  return all;
}

// What an entry says beside the law's own keys.
struct Properties {
  std::array<double, 2> shear_modulus = {0.0, 0.0};
  double density = Tissue{}.density;

  template <class Self, class Visitor>
  static void describe(Self& self, Visitor&& field) {
    field(input::Field{.key = "range", .unit = "Pa", .meaning = "lowest and highest shear modulus published"},
          self.shear_modulus);
    field(input::Field{.key = "density", .unit = "kg/m3", .meaning = "density, for gravity", .bound = input::positive()},
          self.density);
  }
};

}  // namespace

Tissue find_tissue(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "tissue");
  input::Diagnostics diagnostics;
  std::vector<std::string> others = common_keys();
  others.insert(others.end(), {"range", "density"});
  const auto law = read_solid_law(entry.table, others, diagnostics);
  const auto properties = input::read<Properties>(entry.table, diagnostics, {.also_known = entry.table.keys()});
  diagnostics.throw_if_any();
  return {.name = entry.name,
          .law = *law,
          .density = properties.density,
          .shear_range = properties.shear_modulus,
          .source = entry.provenance.text()};
}

input::Table written_out_tissue(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "tissue");
  input::Diagnostics diagnostics;
  const auto properties = input::read<Properties>(entry.table, diagnostics, {.also_known = entry.table.keys()});
  input::Table more = input::to_table(properties);
  if (properties.shear_modulus[1] == 0.0) more.remove("range");  // not given
  return written_out(entry, law_in_si(entry.table), more);
}

Tissue find_membrane_tissue(const input::MaterialEntry& asked) {
  Tissue tissue = find_tissue(asked);
  if (!is_split(tissue.law))
    throw input::InputError(
        asked.where,
        "a layer with thickness is a membrane, and the law of " + tissue.name + " is no incompressible one",
        "use neo-Hooke, Mooney-Rivlin, Ogden, Yeoh, Arruda-Boyce or Fung, or make it a layer of cells");
  return tissue;
}

std::vector<std::string> tissue_names() { return shipped().keys(); }

}  // namespace snug::materials
