#include "materials/database/exchange.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "cases/input/csv.hpp"
#include "cases/input/files.hpp"
#include "cases/input/suggestion.hpp"
#include "materials/database/evaluation.hpp"
#include "materials/database/json_reader.hpp"

namespace snug::materials {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::uintmax_t longest_file = 64 << 20;
constexpr std::array columns = {"kind", "id",          "parent", "item", "type",   "value",
                                "unit", "uncertainty", "low",    "high", "symbol", "source"};

Json to_json(const input::Table& table);

Json to_json(const input::Value& value) {
  if (const auto* text = value.text()) return *text;
  if (const auto* table = value.table()) return to_json(*table);
  Json list = Json::array();
  if (const auto* items = value.array())
    for (const input::Value& item : *items) list.push_back(to_json(item));
  return list;
}

Json to_json(const input::Table& table) {
  Json object = Json::object();
  for (const input::Entry& entry : table.entries) object[entry.key] = to_json(entry.value);
  return object;
}

input::Table json_table(const std::filesystem::path& file) {
  return table_of_json(input::read_file(file, {.most = longest_file}), {file.string(), 0, 0});
}

/// Rows of a CSV file as entities: each is found by its ID in the order of the file.
class CsvEntities {
 public:
  CsvEntities(const input::Csv& csv, Kind kind, UnitBook& units, input::Diagnostics& diagnostics)
      : csv_(csv), kind_(kind), units_(units), diagnostics_(diagnostics) {}

  std::vector<Entity> read() {
    if (csv_.find("id") < 0) {
      if (!csv_.columns.empty())
        diagnostics_.error({csv_.file, csv_.columns.front().where.line, 1}, "the column id is missing",
                           "name the column of the entities' IDs id");
      return {};
    }
    const bool by_datum = csv_.find("item") >= 0 && csv_.find("value") >= 0;
    if (by_datum) check_columns();
    for (std::size_t row = 0; row < csv_.rows.size(); ++row) by_datum ? read_datum(row) : read_items(row);
    for (Entity& entity : entities_) {
      for (Datum& datum : entity.data) check_datum(datum, units_, entity.where, diagnostics_);
      check_equations(entity, units_, diagnostics_);
    }
    return std::move(entities_);
  }

 private:
  std::string cell(std::size_t row, const std::string& column) const {
    const int c = csv_.find(column);
    return c < 0 ? std::string() : csv_.rows[row].cells[static_cast<std::size_t>(c)];
  }
  input::Location place(std::size_t row, const std::string& column) const {
    return csv_.place(row, static_cast<std::size_t>(std::max(0, csv_.find(column))));
  }

  void check_columns() {
    const std::vector<std::string> known(columns.begin(), columns.end());
    for (const input::Csv::Column& column : csv_.columns)
      if (std::find(known.begin(), known.end(), column.name) == known.end())
        diagnostics_.error(column.where, "unknown column " + column.name, input::did_you_mean(column.name, known));
  }

  Entity& entity_of_row(std::size_t row) {
    const std::string id = cell(row, "id"), kind = cell(row, "kind"), parent = cell(row, "parent");
    const auto known = by_id_.find(id);
    if (known != by_id_.end()) {
      const Entity& before = entities_[known->second];
      if (parent != before.parent || (!kind.empty() && kind != input::text_of(before.kind)))
        diagnostics_.error(place(row, "id"), id + " has another kind or parent above", "give one to all its rows");
      return entities_[known->second];
    }
    by_id_.emplace(id, entities_.size());
    const auto of_kind = kind.empty() ? kind_ : input::choice_of<Kind>(kind);
    if (!of_kind)
      diagnostics_.error(place(row, "kind"), "\"" + kind + "\" is no kind of entity",
                         input::did_you_mean(kind, input::choices_of<Kind>()));
    check_id(id, place(row, "id"), diagnostics_);
    entities_.push_back({.kind = of_kind.value_or(kind_), .id = id, .parent = parent, .where = place(row, "id")});
    return entities_.back();
  }

  void read_datum(std::size_t row) {
    Entity& entity = entity_of_row(row);
    if (cell(row, "item").empty()) return;  // an entity without data
    const std::string type = cell(row, "type").empty() ? "value" : cell(row, "type");
    const auto of_type = input::choice_of<DatumType>(type);
    if (!of_type)
      return diagnostics_.error(place(row, "type"), "\"" + type + "\" is no type",
                                input::did_you_mean(type, input::choices_of<DatumType>()));
    entity.data.push_back({.name = cell(row, "item"),
                           .symbol = cell(row, "symbol"),
                           .type = *of_type,
                           .value = cell(row, "value"),
                           .unit = cell(row, "unit"),
                           .uncertainty = cell(row, "uncertainty"),
                           .low = cell(row, "low"),
                           .high = cell(row, "high"),
                           .source = cell(row, "source")});
  }

  void read_items(std::size_t row) {
    Entity& entity = entity_of_row(row);
    for (std::size_t c = 0; c < csv_.columns.size(); ++c) {
      const input::Csv::Column& column = csv_.columns[c];
      const std::string& text = csv_.rows[row].cells[c];
      if (text.empty() || column.name == "id" || column.name == "kind" || column.name == "parent") continue;
      Datum datum = datum_of(column.name, text, units_);
      if (!column.unit.empty() && !datum.unit.empty())
        diagnostics_.error(csv_.place(row, c), column.name + ": a unit in the cell and one in the head",
                           "give it once");
      if (!column.unit.empty()) datum.unit = column.unit;
      entity.data.push_back(std::move(datum));
    }
  }

  const input::Csv& csv_;
  Kind kind_;
  UnitBook& units_;
  input::Diagnostics& diagnostics_;
  std::vector<Entity> entities_;
  std::map<std::string, std::size_t> by_id_;
};

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"#") == text.npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

void add_csv_row(std::vector<std::string> cells, std::string& text) {
  cells.resize(columns.size());
  for (const std::string& cell : cells) text.append(csv_cell(cell)).append(",");
  text.back() = '\n';
}

std::string csv_text(const std::vector<Entity>& entities) {
  std::string text;
  add_csv_row({columns.begin(), columns.end()}, text);
  for (const Entity& entity : entities) {
    const std::string kind = input::text_of(entity.kind);
    if (entity.data.empty()) add_csv_row({kind, entity.id, entity.parent}, text);
    for (const Datum& one : entity.data)
      add_csv_row({kind, entity.id, entity.parent, one.name, input::text_of(one.type), one.value, one.unit,
                   one.uncertainty, one.low, one.high, one.symbol, one.source},
                  text);
  }
  return text;
}

/// What a file is called beside the text: the beginning of its hash keeps files of one name apart.
std::string name_beside(const LibraryFile& file) { return file.hash.substr(0, 12) + "-" + file.name; }

}  // namespace

Entries read_entries(const std::filesystem::path& file, Kind kind, UnitBook& units) {
  const std::string ending = file.extension().string();
  input::Diagnostics diagnostics;
  Entries entries;
  if (ending == ".toml") {
    const input::Table table = input::parse_file(file, diagnostics);
    diagnostics.throw_if_any();
    entries = entries_of(table, files_of(file.parent_path()), units, diagnostics);
  } else if (ending == ".json") {
    entries = entries_of(json_table(file), files_of(file.parent_path()), units, diagnostics);
  } else if (ending == ".csv") {
    const input::Csv csv = input::read_csv(file, diagnostics);
    diagnostics.throw_if_any();
    entries.entities = CsvEntities(csv, kind, units, diagnostics).read();
  } else {
    throw input::InputError({file.string(), 0, 0}, "the ending \"" + ending + "\" is none of .toml, .json and .csv",
                            "name the file by what it holds");
  }
  diagnostics.throw_if_any();
  return entries;
}

std::string text_of_entries(const std::vector<Entity>& entities, const Library& library, const std::string& ending) {
  const auto file_name = [&](const std::string& hash) { return name_beside(library.file(hash)); };
  if (ending == ".csv") return csv_text(entities);
  if (ending == ".toml") return input::to_toml(to_table(entities, file_name));
  if (ending != ".json")
    throw input::InputError({"snug materials export", 0, 0},
                            "the ending \"" + ending + "\" is none of .toml, .json and .csv",
                            "name the file by what it is to hold");
  Json json = Json::object();
  for (const Entity& entity : entities) {
    Json& kind = json[input::text_of(entity.kind)];
    if (kind.is_null()) kind = Json::object();
    kind.get_ref<Json::object_t&>().push_back(
        {entity.id, to_json(to_table(entity, file_name))});  // IDs are all different: no search
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void write_entries(const std::vector<Entity>& entities, const Library& library, const std::filesystem::path& file) {
  const std::string ending = file.extension().string(), text = text_of_entries(entities, library, ending);
  if (ending != ".csv")
    for (const Entity& entity : entities)
      for (const Datum& datum : entity.data)
        if (datum.type == DatumType::table || datum.type == DatumType::figure) {
          const LibraryFile kept = library.file(datum.value);
          input::write_file(file.parent_path() / name_beside(kept), kept.content);
        }
  input::write_file(file, text);
}

}  // namespace snug::materials
