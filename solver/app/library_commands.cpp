#include "solver/app/library_commands.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/database/evaluation.hpp"
#include "materials/database/items.hpp"
#include "materials/database/named.hpp"
#include "solver/app/documents.hpp"
#include "solver/app/learning_commands.hpp"
#include "solver/app/library_command.hpp"
#include "solver/app/library_file.hpp"
#include "solver/app/material_list.hpp"

namespace snug::app {

namespace {

using input::text_of;
using materials::Datum, materials::DatumType, materials::Entity, materials::Kind, materials::Library;

bool has_library() {
  std::error_code ignored;
  const auto file = library_file();
  return !file.empty() && std::filesystem::exists(file, ignored);
}

std::string si_text(const Datum& datum, materials::UnitBook& units) {
  if (!datum.si) return {};
  const std::string name = si_unit(datum, units);
  return fmt::format("{:.10g}{}{}", *datum.si, name.empty() ? "" : " ", name);
}

std::string printed_text(const Datum& datum) {
  if (datum.type == DatumType::table || datum.type == DatumType::figure)
    return text_of(datum.type) + " " + datum.value.substr(0, 12);
  if (datum.type == DatumType::equation) return datum.value + (datum.unit.empty() ? "" : " [" + datum.unit + "]");
  const std::string range = datum.low.empty() ? "" : fmt::format(", {} to {}", datum.low, datum.high);
  return (datum.value.empty() ? "given when asked" : materials::quantity_text(datum)) + range;
}

/// How thick a fabric is under pressure, where its compression was measured.
std::string pressed_text(const Entity& entity) {
  const auto number = [&](const char* item) -> std::optional<double> {
    const Datum* datum = entity.find(item);
    return datum ? datum->si : std::nullopt;
  };
  const std::string text = thickness_text(
      {.LC = number("LC"), .WC = number("WC"), .T0 = number("T0"), .Tm = number("Tm"), .Pm = number("Pm")}, number("thickness").value_or(0.0));
  return entity.kind != Kind::fabric || text.empty() ? std::string() : "  under pressure               " + text + "\n";
}

std::string rows_of(const Entity& entity, materials::UnitBook& units, const std::vector<std::string>& children) {
  std::string text =
      fmt::format("# {} \"{}\"{}{}\n", text_of(entity.kind), entity.id,
                  entity.parent.empty() ? "" : ", parent \"" + entity.parent + "\"", entity.shipped ? "" : ", own");
  for (const Datum& datum : entity.data) {
    const std::string name =
        datum.symbol.empty() || datum.symbol == datum.name ? datum.name : datum.name + " (" + datum.symbol + ")";
    std::string line =
        fmt::format("  {:<28} {:<34} {:<26} {}", name, printed_text(datum), si_text(datum, units), datum.source);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  text += pressed_text(entity);
  return children.empty() ? text : text + "  parent of " + input::joined(children) + "\n";
}

class Find : public LibraryCommand {
 public:
  Find() : LibraryCommand("find", "entities that a question describes, e.g. \"weight < 250 g/m2 and EMT > 30 %\"") {}
  void declare(CLI::App& app) override {
    app.add_option(
           "QUESTION", question_,
           "comparisons of items joined by and, or, not; names with blanks in double quotes; ~ holds a text; has ITEM")
        ->required();
    declare_kind(app, "--kind", kind_);
    app.add_option("--items", items_, "items to print, as CSV")->delimiter(',');
  }

 private:
  int act(Library& library) override {
    const auto found = library.find_where(question_, kind_.empty() ? std::nullopt : std::optional(kind_of(kind_)));
    if (!items_.empty()) console().say_as_it_is(fmt::format("id,{}\n", fmt::join(items_, ",")));
    Json& rows = console().document()["entities"] = Json::array();
    for (const std::string& id : found) {
      if (console().json()) rows.push_back(asked_of(library.entity(id), library.units()));
      std::string line = id;
      const Entity entity = items_.empty() ? Entity{} : library.entity(id);
      for (const std::string& item : items_) {
        const Datum* datum = entity.find(item);
        const std::string text = datum ? printed_text(*datum) : "";
        line += text.find(',') == text.npos ? fmt::format(",{}", text) : fmt::format(",\"{}\"", text);
      }
      console().say_as_it_is(line + "\n");
    }
    if (found.empty()) console().note("nothing of the library fits");
    return done;
  }
  /// With the items asked for; with all where none are.
  Json asked_of(Entity entity, materials::UnitBook& units) const {
    if (!items_.empty()) std::erase_if(entity.data, [&](const Datum& datum) { return std::find(items_.begin(), items_.end(), datum.name) == items_.end(); });
    return entity_json(entity, units);
  }
  std::string question_, kind_;
  std::vector<std::string> items_;
};

class Evaluate : public LibraryCommand {
 public:
  Evaluate()
      : LibraryCommand("evaluate",
                       "an item of an entity: its equation, table or value, with numbers given for others") {}
  void declare(CLI::App& app) override {
    app.add_option("ID", id_, "entity")->required();
    app.add_option("ITEM", item_, "its name or symbol")->required();
    app.add_option("--with", given_,
                   "a state variable, another value, or the place in a table: --with \"T=310 K\"; may be repeated")
        ->type_name("SYMBOL=VALUE")
        ->allow_extra_args(false);
  }

 private:
  int act(Library& library) override {
    materials::Given given;
    for (const std::string& word : given_) given.insert(item_and_value(word, "evaluate"));
    const Entity entity = library.entity(id_);
    const auto result = materials::evaluate(entity, item_, given, library.units(),
                                            [&](const std::string& hash) { return library.file(hash).content; });
    Datum as_si = *result.datum;
    as_si.si = result.si;
    const std::string si = as_si.type == DatumType::table ? fmt::format("{:.10g} {}", result.si, result.si_unit)
                                                          : si_text(as_si, library.units());
    const std::string own = fmt::format("{:.10g}{}{}", result.in_unit, as_si.unit.empty() ? "" : " ", as_si.unit);
    console().print("{}\n", as_si.type == DatumType::table || own == si ? si : own + " = " + si);
    console().document() = {{"id", id_}, {"item", item_}, {"value_SI", result.si}, {"unit_SI", as_si.type == DatumType::table ? result.si_unit : si_unit(as_si, library.units())}};
    return done;
  }
  std::string id_, item_;
  std::vector<std::string> given_;
};

class Items : public LibraryCommand {
 public:
  Items() : LibraryCommand("items", "the usual items with symbol, unit and meaning; others are added by using them") {}
  void declare(CLI::App& app) override { declare_kind(app, "KIND", kind_); }
  int execute() override {  // asks no library
    Json& rows = console().document()["items"] = Json::array();
    for (const materials::Item& item : materials::usual_items()) {
      if (!kind_.empty() && text_of(item.kind) != kind_) continue;
      const std::string unit = std::string(item.unit).empty() ? "1" : item.unit;
      console().print("  {:<8} {:<14} {:<32} {:<6} {:<10} {}\n", text_of(item.kind), text_of(item.block), item.name, item.symbol, unit, item.meaning);
      rows.push_back({{"kind", text_of(item.kind)}, {"block", text_of(item.block)}, {"item", item.name}, {"symbol", item.symbol}, {"unit_SI", unit}, {"meaning", item.meaning}});
    }
    return done;
  }

 private:
  int act(Library&) override { return done; }
  std::string kind_;
};

class History : public LibraryCommand {
 public:
  History() : LibraryCommand("history", "what was changed, when and by whom, the newest first") {}
  void declare(CLI::App& app) override {
    app.add_option("ID", id_, "of one entity");
    app.add_option("--most", most_, "lines")->check(CLI::PositiveNumber)->capture_default_str();
  }

 private:
  int act(Library& library) override {
    Json& rows = console().document()["changes"] = Json::array();
    for (const materials::Change& one : library.history(id_, most_)) {
      console().print("{:>6}  {}  {:<12} {:<24} {}\n", one.stroke, one.moment, one.who, one.entity, one.action);
      rows.push_back({{"change", one.stroke}, {"moment", one.moment}, {"by", one.who}, {"id", one.entity}, {"action", one.action}});
    }
    return done;
  }
  std::string id_;
  int most_ = 40;
};

class CheckLibrary : public LibraryCommand {
 public:
  CheckLibrary()
      : LibraryCommand("check", "reads the whole file for damage and compares it with the texts that ship") {}
  void declare(CLI::App&) override {}

 private:
  int act(Library& library) override {
    library.check_file();
    const auto differences = library.differences(materials::shipped_entries(library.units()));
    console().document() = {{"file", library_file().string()}, {"entities", library.count()}, {"differences", differences}};
    for (const std::string& line : differences) console().print("{}\n", line);
    console().print("{}: {} entities, {}\n", library_file().string(), library.count(),
               differences.empty() ? "sound, as the texts have it" : "sound, but not as the texts have it");
    return differences.empty() ? done : outside_tolerance;
  }
};

}  // namespace

std::string si_unit(const Datum& datum, materials::UnitBook& units) {
  const materials::Item* item = materials::usual_item(datum.name.substr(datum.name.rfind('.') + 1));
  const auto unit = units.find(datum.unit);
  return item && std::string(item->unit) != "text" ? item->unit : unit ? unit->name : "";
}

std::pair<std::string, std::string> item_and_value(const std::string& word, const std::string& command) {
  const auto sign = word.find('=');
  if (sign == word.npos || sign == 0)
    throw input::InputError({"snug materials " + command, 0, 0}, "\"" + word + "\" sets nothing",
                            "write ITEM=VALUE, e.g. \"weight=200 g/m2\"");
  return {word.substr(0, sign), word.substr(sign + 1)};
}

std::vector<std::unique_ptr<Command>> library_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<Find>());
  commands.push_back(std::make_unique<Evaluate>());
  commands.push_back(std::make_unique<Items>());
  add_changing_commands(commands);
  add_learning_commands(commands);
  commands.push_back(std::make_unique<History>());
  commands.push_back(std::make_unique<CheckLibrary>());
  return commands;
}

materials::Library open_library() {
  const std::filesystem::path file = library_file();
  if (file.empty())
    throw input::InputError({"snug materials", 0, 0}, "there is no home folder to keep the library in",
                            "name its file in SNUG_LIBRARY");
  return Library(materials::library_settings(file, user_name()));
}

Json known_data_json(const std::string& id) {
  if (has_library()) {
    const Library library = open_library();
    const auto entity = library.find(id);
    return entity ? entity_json(*entity, library.units()) : Json();
  }
  materials::UnitBook units;
  for (const Entity& entity : materials::shipped_entries(units).entities)
    if (entity.id == id) return entity_json(entity, units);
  return {};
}

std::string known_data_text(const std::string& id) {
  if (has_library()) {
    const Library library = open_library();
    const auto entity = library.find(id);
    return entity ? rows_of(*entity, library.units(), library.children(id)) : std::string();
  }
  materials::UnitBook units;
  for (const Entity& entity : materials::shipped_entries(units).entities)
    if (entity.id == id) return rows_of(entity, units, {});
  return {};
}

std::vector<std::string> own_entities(Kind kind) {
  if (!has_library()) return {};
  const Library library = open_library();
  std::vector<std::string> own = library.ids(kind);
  std::erase_if(own, [&](const std::string& id) { return library.entity(id).shipped; });
  return own;
}

}  // namespace snug::app
