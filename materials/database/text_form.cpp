#include "materials/database/text_form.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/files.hpp"
#include "cases/input/suggestion.hpp"
#include "materials/database/evaluation.hpp"
#include "materials/database/items.hpp"
#include "materials/database/sha256.hpp"

namespace snug::materials {

namespace {

constexpr std::uintmax_t longest_file = 16 << 20;
constexpr std::size_t most_data = 2000, deepest_item = 8;

/// One line, without blanks at its ends.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\t' || c == '\r'; }, ' ');
  text.erase(0, text.find_first_not_of(' '));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

/// The usual item behind a name such as "weft.LT".
const Item* item_of(const std::string& name) { return usual_item(name.substr(name.rfind('.') + 1)); }
bool is_text_item(const std::string& name) {
  const Item* item = item_of(name);
  return name.starts_with("assumptions.") || name == "name" || (item && std::string(item->unit) == "text");
}

/// Reads the values of one entity's table into data.
class DataReader {
 public:
  DataReader(Entity& entity, const FileReader& read, UnitBook& units, std::vector<LibraryFile>& files,
             input::Diagnostics& diagnostics)
      : entity_(entity), read_(read), units_(units), files_(files), diagnostics_(diagnostics) {}

  void read(const std::string& name, const input::Value& value, std::size_t depth = 0) {
    if (depth > deepest_item)
      return diagnostics_.error(value.where, name + " is nested more than " + std::to_string(deepest_item) + " deep",
                                "name its parts as items of their own");
    if (const auto* text = value.text()) return add(datum_of(name, *text, units_), value.where);
    double storage = 0.0;
    if (const double* number = value.number(storage)) return add(of_number(name, *number), value.where);
    if (const input::Table* table = value.table())
      return is_datum(*table) ? read_datum(name, *table) : read_parts(name, *table, depth);
    if (const auto* items = value.array()) return read_list(name, *items, depth);
    diagnostics_.error(value.where, name + " is " + value.description(),
                       "give a text, a number, or a table with value, equation, table or figure");
  }

 private:
  static bool is_datum(const input::Table& table) {
    const std::vector<std::string> types = input::choices_of<DatumType>();
    return std::any_of(types.begin(), types.end(), [&](const std::string& type) { return table.find(type); });
  }
  Datum of_number(const std::string& name, double number) const {
    const Item* item = item_of(name);
    return {.name = name, .value = fmt::format("{}", number), .unit = item ? item->bare : ""};
  }
  void add(Datum datum, const input::Location& where) {
    if (entity_.data.size() == most_data)
      diagnostics_.error(where, entity_.id + " has more than " + std::to_string(most_data) + " data",
                         "make a table of them, or several entities");
    if (entity_.data.size() >= most_data) return;
    check_datum(datum, units_, where, diagnostics_);
    entity_.data.push_back(std::move(datum));
  }
  void read_parts(const std::string& name, const input::Table& table, std::size_t depth) {
    for (const input::Entry& entry : table.entries) read(name + "." + entry.key, entry.value, depth + 1);
  }
  void read_list(const std::string& name, const std::vector<input::Value>& items, std::size_t depth) {
    const bool sources = std::any_of(items.begin(), items.end(),
                                     [](const input::Value& item) { return item.table() && is_datum(*item.table()); });
    for (std::size_t n = 0; n < items.size(); ++n)
      read(sources ? name : name + "." + std::to_string(n + 1), items[n], depth + 1);
  }

  std::string text_of(const std::string& name, const input::Table& table, const char* key) {
    const input::Value* value = table.find(key);
    if (!value) return {};
    double storage = 0.0;
    if (const double* number = value->number(storage)) return fmt::format("{}", *number);
    if (const auto* text = value->text()) return one_line(*text);
    diagnostics_.error(value->where, name + ": " + key + " is " + value->description(), "give a text");
    return {};
  }
  void read_datum(const std::string& name, const input::Table& table) {
    const std::vector<std::string> types = input::choices_of<DatumType>(),
                                   known = {"value",  "equation", "table",       "figure", "unit",
                                            "symbol", "source",   "uncertainty", "range"};
    if (std::count_if(types.begin(), types.end(), [&](const std::string& type) { return table.find(type); }) != 1)
      return diagnostics_.error(table.where, name + " is of several types at once",
                                "write a list with one table for each");
    for (const input::Entry& entry : table.entries)
      if (std::find(known.begin(), known.end(), entry.key) == known.end())
        diagnostics_.error(entry.where, name + ": unknown key " + entry.key, input::did_you_mean(entry.key, known));
    const std::string type =
        *std::find_if(types.begin(), types.end(), [&](const std::string& one) { return table.find(one); });
    Datum datum{.name = name, .type = *input::choice_of<DatumType>(type)};
    const std::string content = text_of(name, table, type.c_str());
    if (datum.type == DatumType::value) {
      const input::Value* bare = table.find("value");
      double storage = 0.0;
      const double* number = bare->number(storage);
      datum = number && !table.find("unit") ? of_number(name, *number) : datum_of(name, content, units_);
    } else {
      datum.value = datum.type == DatumType::equation ? content : kept(content, table.find(type)->where);
    }
    if (const std::string unit = text_of(name, table, "unit"); !unit.empty()) datum.unit = unit;
    if (const std::string deviation = text_of(name, table, "uncertainty"); !deviation.empty())
      datum.uncertainty = deviation;
    datum.symbol = text_of(name, table, "symbol");
    datum.source = text_of(name, table, "source");
    read_range(table, datum);
    add(std::move(datum), table.where);
  }
  /// The hash of a file, which is kept.
  std::string kept(const std::string& name, const input::Location& where) {
    if (name.empty()) return {};
    try {
      LibraryFile file{
          .hash = {}, .name = std::filesystem::path(name).filename().string(), .content = read_(name, where)};
      file.hash = sha256(file.content);
      const std::string mark = file.hash.substr(0, 12) + "-";  // of a file that was exported
      if (file.name.starts_with(mark)) file.name.erase(0, mark.size());
      files_.push_back(file);
      return file.hash;
    } catch (const input::InputError& error) {
      for (const input::Diagnostic& one : error.errors()) diagnostics_.error(one.where, one.found, one.remedy);
      return "-";
    }
  }
  void read_range(const input::Table& table, Datum& datum) {
    const input::Value* range = table.find("range");
    if (!range) return;
    const auto* limits = range->array();
    if (!limits || limits->size() != 2)
      return diagnostics_.error(range->where, datum.name + ": range is " + range->description(),
                                "give two limits, range = [\"1 mm\", \"2 mm\"]");
    const auto limit = [&](const input::Value& value) {
      double storage = 0.0;
      const double* number = value.number(storage);
      const Datum one = value.text() ? datum_of(datum.name, *value.text(), units_)
                        : number     ? of_number(datum.name, *number)
                                     : Datum{};
      if (!plain_number(one.value) || one.unit != datum.unit)
        diagnostics_.error(value.where, datum.name + ": a limit that is " + value.description(),
                           "give a number in the unit of the value" +
                               (datum.unit.empty() ? std::string() : ", \"" + datum.unit + "\""));
      return one.value;
    };
    datum.low = limit((*limits)[0]), datum.high = limit((*limits)[1]);
  }

  Entity& entity_;
  const FileReader& read_;
  UnitBook& units_;
  std::vector<LibraryFile>& files_;
  input::Diagnostics& diagnostics_;
};

input::Value text_value(const std::string& text) { return input::value_without_place(text); }

/// A datum as it stands in a text: a text where that says all, else a table.
input::Value value_of(const Datum& datum, bool one_of_several,
                      const std::function<std::string(const std::string&)>& file_name) {
  const bool plain = datum.type == DatumType::value && datum.symbol.empty() && datum.source.empty() &&
                     datum.low.empty() && !(datum.value.empty() && !datum.unit.empty());
  if (plain && !one_of_several) return text_value(quantity_text(datum));
  input::Table table;
  const bool is_file = datum.type == DatumType::table || datum.type == DatumType::figure;
  if (datum.type == DatumType::value && !datum.value.empty()) {
    table.set("value", text_value(quantity_text(datum)));
  } else {
    table.set(input::text_of(datum.type), text_value(is_file ? file_name(datum.value) : datum.value));
    if (!datum.unit.empty()) table.set("unit", text_value(datum.unit));
    if (!datum.uncertainty.empty()) table.set("uncertainty", text_value(datum.uncertainty));
  }
  if (!datum.symbol.empty()) table.set("symbol", text_value(datum.symbol));
  const std::string unit = datum.unit.empty() ? "" : " " + datum.unit;
  if (!datum.low.empty())
    table.set("range", input::value_without_place(
                           std::vector<input::Value>{text_value(datum.low + unit), text_value(datum.high + unit)}));
  if (!datum.source.empty()) table.set("source", text_value(datum.source));
  return input::value_without_place(std::move(table));
}

/// Puts a value at "weft.LT" or "terms.1.mu": tables by name, lists by number.
void put(input::Table& table, const std::string& path, input::Value value) {
  const auto dot = path.find('.');
  if (dot == path.npos) return table.set(path, std::move(value));
  const std::string head = path.substr(0, dot), rest = path.substr(dot + 1), next = rest.substr(0, rest.find('.'));
  if (!table.find(head))
    table.set(head, std::isdigit(static_cast<unsigned char>(next[0]))
                        ? input::value_without_place(std::vector<input::Value>{})
                        : input::value_without_place(input::Table{}));
  input::Value* inner = table.find(head);
  if (input::Table* deeper = inner->table()) return put(*deeper, rest, std::move(value));
  auto* list = std::get_if<std::vector<input::Value>>(&inner->data);
  if (!list) return;  // a plain value of that name stands there
  const bool is_last = rest.find('.') == rest.npos;
  const auto place = static_cast<std::size_t>(plain_number(next).value_or(0.0));
  if (place == 0 || place > list->size() + 1) return;
  if (place == list->size() + 1) list->push_back(is_last ? value : input::value_without_place(input::Table{}));
  if (!is_last && (*list)[place - 1].table())
    put(*(*list)[place - 1].table(), rest.substr(next.size() + 1), std::move(value));
}

input::Value law_value(const Datum& datum, UnitBook& units) {
  const auto unit = units.find(datum.unit);
  if (!unit || (datum.type == DatumType::value && !datum.si)) return text_value(datum.value);
  const Item* item = item_of(datum.name);
  if (datum.type == DatumType::value && !datum.unit.empty() && !unit->name.empty())
    return text_value(datum.value + " " + datum.unit);
  if (!unit->name.empty()) return text_value(fmt::format("{} {}", *datum.si, unit->name));
  const bool bare = item && *item->bare;  // a key that takes percent
  if (bare)
    return input::value_without_place(
        datum.unit == item->bare && datum.type == DatumType::value ? *plain_number(datum.value) : *datum.si * 100.0);
  return input::value_without_place(datum.unit.empty() && datum.type == DatumType::value ? *plain_number(datum.value)
                                                                                         : *datum.si);
}

}  // namespace

FileReader files_of(const std::filesystem::path& folder) {
  return [folder](const std::string& name, const input::Location& where) {
    const std::filesystem::path path = name;
    if (path.is_absolute() || std::find(path.begin(), path.end(), "..") != path.end())
      throw input::InputError(where, "the file " + name + " is not in the folder of the text",
                              "put it there and give its name alone");
    return input::read_file(folder / path, {.shown_as = (folder / path).string(), .most = longest_file});
  };
}

Datum datum_of(const std::string& name, const std::string& text, UnitBook& units) {
  Datum datum{.name = name, .value = one_line(text)};
  if (is_text_item(name)) return datum;
  if (const auto printed = printed_quantity(datum.value, units))
    datum.value = printed->number, datum.uncertainty = printed->uncertainty,
    datum.unit = printed->unit == "1" ? "" : printed->unit;
  return datum;
}

Entity entity_of(Kind kind, const std::string& id, const input::Table& table, const FileReader& read, UnitBook& units,
                 std::vector<LibraryFile>& files, input::Diagnostics& diagnostics) {
  Entity entity{.kind = kind, .id = id, .where = table.where};
  check_id(id, table.where, diagnostics);
  DataReader reader(entity, read, units, files, diagnostics);
  for (const input::Entry& entry : table.entries) {
    if (entry.key != "parent") {
      reader.read(entry.key, entry.value);
    } else if (entry.value.text()) {
      entity.parent = *entry.value.text();
    } else {
      diagnostics.error(entry.value.where, "parent is " + entry.value.description(),
                        "give the ID of an entity in quotes");
    }
  }
  check_equations(entity, units, diagnostics);
  return entity;
}

std::vector<Datum> data_of(const input::Table& table, const FileReader& read, UnitBook& units,
                           std::vector<LibraryFile>& files, input::Diagnostics& diagnostics) {
  Entity entity;
  DataReader reader(entity, read, units, files, diagnostics);
  for (const input::Entry& entry : table.entries) reader.read(entry.key, entry.value);
  return std::move(entity.data);
}

Entries entries_of(const input::Table& text, const FileReader& read, UnitBook& units, input::Diagnostics& diagnostics) {
  Entries entries;
  for (const input::Entry& kind : text.entries) {
    const auto known = input::choice_of<Kind>(kind.key);
    const input::Table* group = kind.value.table();
    if (!known || !group) {
      diagnostics.error(
          kind.where, "\"" + kind.key + "\" is no kind of entity",
          "write [kind.ID], e.g. [fabric.\"my knit\"]: " + input::did_you_mean(kind.key, input::choices_of<Kind>()));
      continue;
    }
    for (const input::Entry& one : group->entries) {
      if (const input::Table* table = one.value.table())
        entries.entities.push_back(entity_of(*known, one.key, *table, read, units, entries.files, diagnostics));
      else
        diagnostics.error(one.where, kind.key + "." + one.key + " is " + one.value.description(),
                          "give its items below [" + kind.key + ".\"" + one.key + "\"]");
    }
  }
  return entries;
}

input::Table to_table(const Entity& entity, const std::function<std::string(const std::string&)>& file_name) {
  input::Table table;
  if (!entity.parent.empty()) table.set("parent", text_value(entity.parent));
  for (const Datum& datum : entity.data) {
    if (table.find(datum.name)) continue;
    std::vector<input::Value> values;
    const auto count =
        std::count_if(entity.data.begin(), entity.data.end(), [&](const Datum& one) { return one.name == datum.name; });
    for (const Datum& one : entity.data)
      if (one.name == datum.name) values.push_back(value_of(one, count > 1, file_name));
    table.set(datum.name, count > 1 ? input::value_without_place(std::move(values)) : std::move(values.front()));
  }
  return table;
}

input::Table to_table(const std::vector<Entity>& entities,
                      const std::function<std::string(const std::string&)>& file_name) {
  input::Table table;
  for (const Entity& entity : entities) {
    const std::string kind = input::text_of(entity.kind);
    if (!table.find(kind)) table.set(kind, input::value_without_place(input::Table{}));
    table.find(kind)->table()->set(entity.id, input::value_without_place(to_table(entity, file_name)));
  }
  return table;
}

input::Table law_table(const Entity& entity, UnitBook& units) {
  input::Table table;
  for (const Datum& datum : entity.data) {
    const bool usable =
        datum.type == DatumType::value ? !datum.value.empty() : datum.type == DatumType::equation && datum.si;
    if (usable && entity.find(datum.name) == &datum) put(table, datum.name, law_value(datum, units));
  }
  if (!table.find("name")) table.set("name", text_value(entity.id));
  return table;
}

}  // namespace snug::materials
