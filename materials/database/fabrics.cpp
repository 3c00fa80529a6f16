#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"
#include "materials/database/shipped.hpp"
#include "materials/fabric/inputs.hpp"

namespace snug::materials {
namespace {

// Parsed once: it never changes.
const input::Table& shipped() {
  static const input::Table all = input::table_of(shipped_fabrics, {"materials/data/fabrics.toml", 1, 1});
  return all;
}

void check(const KesTension& tension, const input::Location& where, input::Diagnostics& diagnostics) {
  if (tension.Fm.has_value() == tension.EMT.has_value())
    diagnostics.error(where, tension.Fm ? "both Fm and EMT are given" : "neither Fm nor EMT is given",
                      "write one of them, for instance Fm = \"50 gf/cm\"; the other follows from LT and WT");
}
void check(const LinearFabric&, const input::Table&, input::Diagnostics&) {}
void check(const CubicFabric&, const input::Table&, input::Diagnostics&) {}
void check(const KesFabric& kes, const input::Table& table, input::Diagnostics& diagnostics) {
  check(kes.tension, table.where, diagnostics);
  if (kes.weft) check(*kes.weft, table.where_is("weft"), diagnostics);
}

template <class Form>
Fabric build(const input::Table& table, input::Diagnostics& diagnostics) {
  const Form form = input::read<Form>(table, diagnostics, {.also_known = common_keys()});
  if (!diagnostics.any()) check(form, table, diagnostics);
  diagnostics.throw_if_any();
  return form.fabric();
}

// Every form of fabric, visibly: adding one is a struct in fabric/inputs.hpp and a line here.
Fabric read_fabric(const input::Table& table) {
  input::Diagnostics diagnostics;
  const std::string law = input::read_choice(table, "law", {"linear", "cubic", "kes"}, diagnostics);
  diagnostics.throw_if_any();
  if (law == "linear") return build<LinearFabric>(table, diagnostics);
  if (law == "cubic") return build<CubicFabric>(table, diagnostics);
  return build<KesFabric>(table, diagnostics);
}

}  // namespace

Fabric find_fabric(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "fabric");
  Fabric fabric = read_fabric(entry.table);
  fabric.name = entry.name;
  fabric.source = entry.provenance.text();
  return fabric;
}

input::Table written_out_fabric(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "fabric");
  input::Diagnostics diagnostics;
  const std::string law = input::read_choice(entry.table, "law", {"linear", "cubic", "kes"}, diagnostics);
  const auto in_si = [&]<class Form>(Form) {
    return input::to_table(input::read<Form>(entry.table, diagnostics, {.also_known = common_keys()}));
  };
  return written_out(entry, law == "linear" ? in_si(LinearFabric{}) : law == "cubic" ? in_si(CubicFabric{}) : in_si(KesFabric{}), {});
}

std::vector<std::string> fabric_names() { return shipped().keys(); }

}  // namespace snug::materials
