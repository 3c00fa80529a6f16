// Keys, entities of the library and recorded runs as JSON.
#include "materials/database/items.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/library_commands.hpp"
#include "solver/app/project_text.hpp"

namespace snug::app {

using materials::Datum, materials::DatumType, materials::Entity, materials::RunRecord, materials::RunValue;

namespace {

Json values_json(const std::vector<RunValue>& values) {
  Json json = Json::array();
  for (const RunValue& one : values) {
    json.push_back({{"name", one.name}, {"value", one.number ? Json(*one.number) : Json(one.value)}});
    if (!one.unit.empty()) json.back()["unit"] = one.unit;
  }
  return json;
}

}  // namespace

Json key_json(const input::KeyRow& row) {
  return {{"key", row.key}, {"kind", row.kind}, {"unit", row.field.unit}, {"required", row.field.required}, {"default", row.default_value.empty() ? Json() : Json(row.default_value)},
          {"choices", row.field.choices}, {"meaning", row.field.meaning}};
}

Json datum_json(const Datum& datum, materials::UnitBook& units) {
  Json json = {{"item", datum.name}};
  if (!datum.symbol.empty() && datum.symbol != datum.name) json["symbol"] = datum.symbol;
  json["type"] = input::text_of(datum.type);
  const bool file = datum.type == DatumType::table || datum.type == DatumType::figure;
  json[file ? "file_hash" : "printed"] = datum.type == DatumType::value ? materials::quantity_text(datum) : datum.value;
  json["value_SI"] = datum.si ? Json(*datum.si) : Json();
  if (const std::string unit = si_unit(datum, units); datum.si && !unit.empty()) json["unit_SI"] = unit;
  if (!datum.low.empty()) json["range_printed"] = {datum.low, datum.high};
  if (!datum.unit.empty()) json["unit_printed"] = datum.unit;
  json["source"] = datum.source;
  return json;
}

Json entity_json(const Entity& entity, materials::UnitBook& units) {
  Json data = Json::array();
  for (const Datum& datum : entity.data) data.push_back(datum_json(datum, units));
  return {{"id", entity.id}, {"kind", input::text_of(entity.kind)}, {"parent", entity.parent.empty() ? Json() : Json(entity.parent)}, {"own", !entity.shipped}, {"data", data}};
}

Json run_json(const RunRecord& run, bool whole) {
  Json json = {{"run", run.number}, {"project", run.project}, {"title", run.title}, {"recorded", run.moment}, {"by", run.who}, {"status", run.status}, {"message", run.message},
               {"note", run.note}, {"results_in", run.place}, {"results_are", text_of(whereabouts(run))}, {"case", run.directory}, {"derived_from_run", run.parent ? Json(*run.parent) : Json()},
               {"seconds", run.seconds}, {"results", values_json(run.results)}};
  if (!whole) return json;
  Json inputs = Json::array(), named = Json::array();
  for (const RunValue& file : run.inputs) inputs.push_back({{"file", file.name}, {"sha256", file.value}});
  for (const materials::RunMaterial& one : run.materials) named.push_back({{"part", one.part}, {"entity", one.entity}});
  json.update({{"command_line", run.command}, {"case_hash", run.case_hash}, {"inputs", inputs}, {"materials", named}, {"settings", values_json(run.settings)}, {"versions", values_json(run.versions)}});
  return json;
}

Json rows_json(const std::vector<std::vector<std::string>>& rows) {
  Json json = Json::array();
  for (std::size_t r = 1; r < rows.size(); ++r) {
    Json row = Json::object();
    for (std::size_t c = 0; c < rows[r].size() && c < rows[0].size(); ++c) row[rows[0][c]] = rows[r][c];
    json.push_back(std::move(row));
  }
  return json;
}

}  // namespace snug::app
