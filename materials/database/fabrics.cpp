#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"
#include "materials/database/shipped.hpp"
#include "materials/fabric/inputs.hpp"
#include "materials/fabric/measured.hpp"

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
void check(const CurveFabric&, const input::Table&, input::Diagnostics&) {}
void check(const FastFabric& fast, const input::Table& table, input::Diagnostics& diagnostics) {
  if (fast.EB5.has_value() == fast.G.has_value())
    diagnostics.error(table.where, fast.G ? "both EB5 and G are given" : "neither EB5 nor G is given", "write one of them, for instance EB5 = \"4.1 %\"");
}
void check(const KesFabric& kes, const input::Table& table, input::Diagnostics& diagnostics) {
  check(kes.tension, table.where, diagnostics);
  if (kes.weft) check(*kes.weft, table.where_is("weft"), diagnostics);
}

/// Files that a fabric names lie in the folder of its case.
template <class Form>
Form form_of(const input::Table& table, input::Diagnostics& diagnostics) {
  const std::filesystem::path folder = std::filesystem::path(table.where.file).parent_path();
  const Form form = input::read<Form>(with_forces_per_width(table, diagnostics), diagnostics,
                                      {.also_known = common_keys(), .directory = folder.empty() ? std::filesystem::path(".") : folder});
  if (!diagnostics.any()) check(form, table, diagnostics);
  diagnostics.throw_if_any();
  if constexpr (requires { form.with_points(table.where); }) return form.with_points(table.where);
  else return form;
}

template <class Form>
Fabric build(const input::Table& table, input::Diagnostics& diagnostics) {
  return form_of<Form>(table, diagnostics).fabric();
}

const std::vector<std::string> fabric_laws = {"linear", "cubic", "kes", "curve", "fast"};

// Every form of fabric, visibly: adding one is a struct in fabric/inputs.hpp and a line here.
Fabric read_fabric(const input::Table& table) {
  input::Diagnostics diagnostics;
  const std::string law = input::read_choice(table, "law", fabric_laws, diagnostics);
  diagnostics.throw_if_any();
  if (law == "curve") return build<CurveFabric>(table, diagnostics);
  if (law == "fast") return build<FastFabric>(table, diagnostics);
  if (law == "linear") return build<LinearFabric>(table, diagnostics);
  if (law == "cubic") return build<CubicFabric>(table, diagnostics);
  return build<KesFabric>(table, diagnostics);
}

}  // namespace

Fabric find_fabric(const input::MaterialEntry& asked) {
  if (const std::string ending = std::filesystem::path(asked.name).extension().string(); ending == ".csv" || ending == ".txt" || ending == ".tsv")
    throw input::InputError(asked.where, "\"" + asked.name + "\" is a file, and no fabric is called so",
                            "write the curves of a strip test as fabric = { law = \"curve\", warp = \"" + asked.name +
                                "\", weft = \"...\", width = \"50 mm\", shear = \"...\" }");
  const Entry entry = find_entry(asked, shipped(), "fabric");
  Fabric fabric = read_fabric(entry.table);
  fabric.name = entry.name;
  fabric.source = entry.provenance.text();
  return fabric;
}

input::Table written_out_fabric(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "fabric");
  input::Diagnostics diagnostics;
  const std::string law = input::read_choice(entry.table, "law", fabric_laws, diagnostics);
  const auto in_si = [&]<class Form>(Form) {
    return input::to_table(form_of<Form>(entry.table, diagnostics));
  };
  if (law == "curve") return written_out(entry, in_si(CurveFabric{}), {});
  if (law == "fast") return written_out(entry, in_si(FastFabric{}), {});
  return written_out(entry, law == "linear" ? in_si(LinearFabric{}) : law == "cubic" ? in_si(CubicFabric{}) : in_si(KesFabric{}), {});
}

std::vector<std::string> fabric_names() { return shipped().keys(); }

}  // namespace snug::materials
