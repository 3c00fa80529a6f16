#include "solver/app/material_list.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "cases/input/suggestion.hpp"
#include "materials/database/named.hpp"
#include "materials/database/shipped.hpp"
#include "materials/fabric/fabric.hpp"
#include "materials/fabric/inputs.hpp"
#include "materials/fabric/measured.hpp"
#include "materials/laws/inputs.hpp"
#include "postproc/documents.hpp"
#include "solver/app/library_commands.hpp"

namespace snug::app {

namespace {

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::string entry_text(const std::string& name, const char* shipped, const std::string& what) {
  input::MaterialEntry asked;
  asked.name = name;
  const materials::Entry entry = materials::find_entry(asked, input::table_of(shipped, {what, 1, 1}), what);
  return fmt::format("# {} \"{}\"\n{}", what, name, input::to_toml(entry.table));
}

void append(std::vector<input::KeyRow>& rows, std::vector<input::KeyRow> more) {
  rows.insert(rows.end(), more.begin(), more.end());
}

}  // namespace

std::string thickness_text(const materials::Compression& compression, double thickness) {
  const auto decrease = compression.decrease();
  const double unloaded = compression.T0.value_or(thickness), gf_per_cm2 = 98.0665, most = compression.largest_pressure() / gf_per_cm2;
  if (!decrease || !(unloaded > 0.0)) return {};
  if (*decrease >= unloaded)
    return fmt::format("LC and WC press the cloth by {:.3g} mm, which is {:.3g} mm thick: a misprint?", 1e3 * *decrease, 1e3 * unloaded);
  std::string text = fmt::format("thickness {:.3g} mm", 1e3 * unloaded);
  for (const double share : {0.1, 0.4, 1.0})
    if (const auto pressed = materials::thickness_under(share * compression.largest_pressure(), compression, thickness))
      text += fmt::format(", {:.3g} mm at {:.3g}", 1e3 * *pressed, share * most);
  return text + " gf/cm2";
}

std::string materials_text() {
  using materials::Kind;
  const auto names = [](std::vector<std::string> known, Kind kind) {
    for (const std::string& name : materials::further_shipped(kind)) known.push_back(name);
    return input::joined(known);
  };
  std::string text =
      fmt::format("fabrics:   {}\ntissues:   {}\nrigid:     \"rigid\" (bone without unknowns)\n",
                  names(materials::fabric_names(), Kind::fabric), names(materials::tissue_names(), Kind::tissue));
  for (const auto& [kind, head] : {std::pair{Kind::fabric, "own fabrics"}, std::pair{Kind::tissue, "own tissues"}})
    if (const auto own = own_entities(kind); !own.empty()) text += fmt::format("{}: {}\n", head, input::joined(own));
  return text;
}

postproc::Json materials_json() {
  using materials::Kind;
  const auto names = [](std::vector<std::string> known, Kind kind) {
    for (const std::string& name : materials::further_shipped(kind)) known.push_back(name);
    return known;
  };
  return {{"fabrics", names(materials::fabric_names(), Kind::fabric)}, {"tissues", names(materials::tissue_names(), Kind::tissue)}, {"own_fabrics", own_entities(Kind::fabric)}, {"own_tissues", own_entities(Kind::tissue)}};
}

std::string material_text(const std::string& name) {
  std::vector<std::string> fabrics = materials::fabric_names(), tissues = materials::tissue_names();
  const std::string known = known_data_text(name);
  if (contains(fabrics, name)) return entry_text(name, materials::shipped_fabrics, "fabric") + "\n" + known;
  if (contains(tissues, name)) return entry_text(name, materials::shipped_tissues, "tissue") + "\n" + known;
  if (!known.empty()) return known;
  for (const materials::Kind kind : {materials::Kind::fabric, materials::Kind::tissue})
    for (const std::string& one : materials::further_shipped(kind)) fabrics.push_back(one);
  fabrics.insert(fabrics.end(), tissues.begin(), tissues.end());
  throw input::InputError({"snug materials show", 0, 0}, "there is no material \"" + name + "\"",
                          input::did_you_mean(name, fabrics));
}

std::vector<input::KeyRow> law_keys() {
  std::vector<input::KeyRow> rows;
  materials::for_each_law_input(
      [&]<class Input>() { append(rows, input::keys_of<Input>(Input::page().name + ".")); });
  append(rows, input::keys_of<materials::LinearFabric>("linear."));
  append(rows, input::keys_of<materials::CubicFabric>("cubic."));
  append(rows, input::keys_of<materials::KesFabric>("kes."));
  append(rows, input::keys_of<materials::CurveFabric>("curve."));
  append(rows, input::keys_of<materials::FastFabric>("fast."));
  return rows;
}

std::vector<std::string> law_names() { return materials::solid_law_names(); }

std::string law_page_text(const std::string& name) {
  std::string text;
  materials::for_each_law_input([&]<class Input>() {
    const materials::LawPage page = Input::page();
    if (name == page.name || name == "law." + page.name)
      text = fmt::format("law = \"{}\"\n  formula   {}\n  use       {}\n  source    {}\n", page.name, page.formula,
                         page.use, page.source);
  });
  return text;
}

}  // namespace snug::app
