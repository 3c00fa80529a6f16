#include <fmt/format.h>

#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"
#include "materials/database/shipped.hpp"
#include "materials/fabric/fabric_data.hpp"
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
  constexpr double least_linearity = 0.1;  // that of LT itself: below, cloth has no stiffness at rest
  if (tension.RT && 0.01 * *tension.RT * tension.LT < least_linearity)
    diagnostics.error(where, fmt::format("with RT = {} % the linearity of the unloading curve, LT RT/100, is {:.3g}", *tension.RT, 0.01 * *tension.RT * tension.LT),
                      fmt::format("it must be at least {}: RT is a percentage, about 40 to 90 % of knits and wovens", least_linearity));
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

const std::vector<std::string> fabric_laws = {"linear", "cubic", "kes", "curve", "fast"};

// Every form of fabric, visibly: adding one is a struct in fabric/inputs.hpp and a line here.
template <class Visit>
auto with_form(const input::Table& table, Visit visit) {
  input::Diagnostics diagnostics;
  const std::string law = input::read_choice(table, "law", fabric_laws, diagnostics);
  diagnostics.throw_if_any();
  if (law == "curve") return visit(form_of<CurveFabric>(table, diagnostics));
  if (law == "fast") return visit(form_of<FastFabric>(table, diagnostics));
  if (law == "linear") return visit(form_of<LinearFabric>(table, diagnostics));
  if (law == "cubic") return visit(form_of<CubicFabric>(table, diagnostics));
  return visit(form_of<KesFabric>(table, diagnostics));
}

/// Of laws that know a way back.
template <class Form>
std::optional<Fabric> unloading_of(const Form& form) {
  if constexpr (requires { form.unloading_fabric(); }) return form.unloading_fabric();
  return std::nullopt;
}

/// Laws know no places; what they refuse stands where the fabric is asked for.
template <class Work>
auto located(const input::Location& where, Work&& work) {
  try {
    return work();
  } catch (const input::InputError& error) {
    std::vector<input::Diagnostic> errors = error.errors();
    for (input::Diagnostic& one : errors)
      if (one.where.file.empty()) one.where = where;
    throw input::InputError(std::move(errors));
  }
}

Fabric with_name(Fabric fabric, const Entry& entry) {
  fabric.name = entry.name;
  fabric.source = entry.provenance.text();
  return fabric;
}

}  // namespace

Fabric find_fabric(const input::MaterialEntry& asked, input::FabricBranch branch) {
  const Entry entry = find_entry(asked, shipped(), "fabric");
  const auto fabric = located(asked.where, [&] {
    return with_form(entry.table, [&](const auto& form) -> std::optional<Fabric> { return branch == input::FabricBranch::loading ? form.fabric() : unloading_of(form); });
  });
  if (!fabric)
    throw input::InputError(asked.where, "the fabric " + entry.name + " has no unloading curve",
                            "give its RT (law = \"kes\") or the rows of its test back to no force (law = \"curve\"), or leave branch out");
  return with_name(*fabric, entry);
}

FabricData fabric_data(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "fabric");
  return with_form(entry.table, [&](const auto& form) {
    FabricData data{.loading = with_name(form.fabric(), entry), .unloading = unloading_of(form), .sheet = form.sheet};
    if (data.unloading) data.unloading = with_name(*data.unloading, entry);
    return data;
  });
}

input::Table written_out_fabric(const input::MaterialEntry& asked) {
  const Entry entry = find_entry(asked, shipped(), "fabric");
  return written_out(entry, with_form(entry.table, [](const auto& form) { return input::to_table(form); }), {});
}

std::vector<std::string> fabric_names() { return shipped().keys(); }

}  // namespace snug::materials
