#include "materials/database/shipped.hpp"

#include "cases/input/reader.hpp"
#include "cases/input/suggestion.hpp"

namespace snug::materials {
namespace {

input::Table parse(const char* shipped, const std::string& file) {
  input::Diagnostics diagnostics;
  input::Table table = input::parse_text(shipped, {file, 1, 1}, diagnostics);
  diagnostics.throw_if_any();
  return table;
}

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

Entry find_entry(const input::MaterialReference& reference, const char* shipped, const std::string& file,
                 const std::string& what) {
  if (!reference.table.empty()) {
    input::Diagnostics diagnostics;
    const input::Table table = input::parse_text(reference.table, reference.where, diagnostics);
    diagnostics.throw_if_any();
    Entry entry = with_provenance("own values", table);
    if (entry.provenance.source.empty()) entry.provenance.source = "values of the case";
    return entry;
  }
  const input::Table all = parse(shipped, file);
  if (const input::Table* table = all.table(reference.name)) return with_provenance(reference.name, *table);
  throw input::InputError(reference.where, "no " + what + " is called \"" + reference.name + "\"",
                          input::did_you_mean(reference.name, all.keys()));
}

std::vector<std::string> entry_names(const char* shipped) { return parse(shipped, {}).keys(); }

}  // namespace snug::materials
