#include "materials/database/shipped.hpp"

#include "cases/input/echo.hpp"
#include "cases/input/reader.hpp"
#include "cases/input/suggestion.hpp"

namespace snug::materials {
namespace {

Entry with_provenance(std::string name, const input::Table& table) {
  input::Diagnostics diagnostics;
  auto provenance = input::read<Provenance>(table, diagnostics, {.also_known = table.keys()});
  diagnostics.throw_if_any();
  return {std::move(name), table, std::move(provenance)};
}

}  // namespace

std::string Provenance::text() const {
  std::string line = source;
  for (const std::string& assumption : assumptions) line += (line.empty() ? "assumed: " : "; assumed: ") + assumption;
  return line;
}

Entry find_entry(const input::MaterialEntry& asked, const input::Table& shipped, const std::string& what) {
  if (asked.is_inline()) {
    Entry entry = with_provenance("own values", asked.table);
    if (!entry.provenance.name.empty()) entry.name = entry.provenance.name;
    if (entry.provenance.source.empty()) entry.provenance.source = "values of the case";
    return entry;
  }
  if (const input::Table* table = shipped.table(asked.name)) return with_provenance(asked.name, *table);
  throw input::InputError(asked.where, "no " + what + " is called \"" + asked.name + "\"",
                          input::did_you_mean(asked.name, shipped.keys()));
}

input::Table written_out(const Entry& entry, const input::Table& form, const input::Table& more) {
  input::Table table;
  table.set("name", input::value_without_place(entry.name));
  table.set("law", *entry.table.find("law"));
  for (const input::Table* part : {&form, &more})
    for (const input::Entry& one : part->entries) table.set(one.key, one.value);
  table.set("source", input::value_without_place(entry.provenance.source));
  for (const input::Entry& one : input::to_table(entry.provenance).entries)
    if (one.key == "assumptions") table.set(one.key, one.value);
  return table;
}

}  // namespace snug::materials
