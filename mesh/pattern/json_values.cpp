#include "mesh/pattern/json_values.hpp"

#include "mesh/formats/json_values.hpp"

namespace snug::mesh {

input::Table parse_json(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics) {
  const std::string remedy = "write a JSON object, { \"pattern\": { ... } }";
  input::Table empty;
  empty.where.file = shown_as;
  try {
    input::Value root = parse_json(text, shown_as);
    if (input::Table* table = root.table()) return std::move(*table);
    diagnostics.error({shown_as, 1, 1}, "the file holds " + root.description(), remedy);
  } catch (const input::InputError& error) {
    for (const input::Diagnostic& one : error.errors()) diagnostics.error(one.where, one.found, remedy);
  }
  return empty;
}

}  // namespace snug::mesh
