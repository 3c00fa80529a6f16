#include "solver/app/library_commands.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cases/input/suggestion.hpp"
#include "materials/database/evaluation.hpp"
#include "materials/database/exchange.hpp"
#include "materials/database/items.hpp"
#include "materials/database/named.hpp"
#include "solver/app/library_file.hpp"

namespace snug::app {

namespace {

using input::text_of;
using materials::Datum, materials::DatumType, materials::Entity, materials::Kind, materials::Library, materials::Stroke;

bool has_library() {
  std::error_code ignored;
  const auto file = library_file();
  return !file.empty() && std::filesystem::exists(file, ignored);
}

/// "ITEM=VALUE" of a command line.
std::pair<std::string, std::string> parts(const std::string& word, const std::string& command) {
  const auto sign = word.find('=');
  if (sign == word.npos || sign == 0) throw input::InputError({"snug materials " + command, 0, 0}, "\"" + word + "\" sets nothing", "write ITEM=VALUE, e.g. \"weight=200 g/m2\"");
  return {word.substr(0, sign), word.substr(sign + 1)};
}

/// Data of "ITEM=VALUE": a text as in a file, or a table of TOML such as { equation = "EA*thickness", unit = "N/m" }.
std::vector<Datum> data_of(const std::vector<std::string>& words, const std::string& command, Library& library, std::vector<materials::LibraryFile>& files) {
  std::vector<Datum> data;
  for (const std::string& word : words) {
    const auto [item, value] = parts(word, command);
    if (value.starts_with("{") || value.starts_with("[")) {
      input::Table table;
      const input::Table parsed = input::table_of("value = " + value, {"snug materials " + command, 0, 0});
      table.set(item, *parsed.find("value"));
      input::Diagnostics diagnostics;
      std::vector<Datum> read = materials::data_of(table, materials::files_of("."), library.units(), files, diagnostics);
      diagnostics.throw_if_any();
      data.insert(data.end(), read.begin(), read.end());
    } else {
      data.push_back(materials::datum_of(item, value, library.units()));
    }
  }
  return data;
}

std::string si_text(const Datum& datum, materials::UnitBook& units) {
  if (!datum.si) return {};
  const materials::Item* item = materials::usual_item(datum.name.substr(datum.name.rfind('.') + 1));
  const auto unit = units.find(datum.unit);
  const std::string name = item && std::string(item->unit) != "text" ? item->unit : unit ? unit->name : "";
  return fmt::format("{:.10g}{}{}", *datum.si, name.empty() ? "" : " ", name);
}

std::string printed_text(const Datum& datum) {
  if (datum.type == DatumType::table || datum.type == DatumType::figure) return text_of(datum.type) + " " + datum.value.substr(0, 12);
  if (datum.type == DatumType::equation) return datum.value + (datum.unit.empty() ? "" : " [" + datum.unit + "]");
  const std::string range = datum.low.empty() ? "" : fmt::format(", {} to {}", datum.low, datum.high);
  return (datum.value.empty() ? "given when asked" : materials::quantity_text(datum)) + range;
}

std::string rows_of(const Entity& entity, materials::UnitBook& units, const std::vector<std::string>& children) {
  std::string text = fmt::format("# {} \"{}\"{}{}\n", text_of(entity.kind), entity.id, entity.parent.empty() ? "" : ", parent \"" + entity.parent + "\"", entity.shipped ? "" : ", own");
  for (const Datum& datum : entity.data) {
    const std::string name = datum.symbol.empty() || datum.symbol == datum.name ? datum.name : datum.name + " (" + datum.symbol + ")";
    std::string line = fmt::format("  {:<28} {:<34} {:<26} {}", name, printed_text(datum), si_text(datum, units), datum.source);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return children.empty() ? text : text + "  parent of " + input::joined(children) + "\n";
}

Kind kind_of(const std::string& name) { return *input::choice_of<Kind>(name); }

/// A command of the library: what it does stands in `act`.
class LibraryCommand : public Command {
 public:
  LibraryCommand(std::string name, std::string summary) : name_(std::move(name)), summary_(std::move(summary)) {}
  std::string name() const override { return name_; }
  std::string summary() const override { return summary_; }
  int execute() override {
    Library library = open_library();
    return act(library);
  }

 protected:
  virtual int act(Library& library) = 0;
  void declare_kind(CLI::App& app, const std::string& option, std::string& kind) const {
    app.add_option(option, kind, input::joined(input::choices_of<Kind>()))->check(CLI::IsMember(input::choices_of<Kind>()));
  }

 private:
  std::string name_, summary_;
};

class Find : public LibraryCommand {
 public:
  Find() : LibraryCommand("find", "entities that a question describes, e.g. \"weight < 250 g/m2 and EMT > 30 %\"") {}
  void declare(CLI::App& app) override {
    app.add_option("QUESTION", question_, "comparisons of items joined by and, or, not; names with blanks in double quotes; ~ holds a text; has ITEM")->required();
    declare_kind(app, "--kind", kind_);
    app.add_option("--items", items_, "items to print, as CSV")->delimiter(',');
  }

 private:
  int act(Library& library) override {
    const auto found = library.find_where(question_, kind_.empty() ? std::nullopt : std::optional(kind_of(kind_)));
    if (!items_.empty()) fmt::print("id,{}\n", fmt::join(items_, ","));
    for (const std::string& id : found) {
      std::string line = id;
      const Entity entity = items_.empty() ? Entity{} : library.entity(id);
      for (const std::string& item : items_) {
        const Datum* datum = entity.find(item);
        const std::string text = datum ? printed_text(*datum) : "";
        line += text.find(',') == text.npos ? fmt::format(",{}", text) : fmt::format(",\"{}\"", text);
      }
      fmt::print("{}\n", line);
    }
    if (found.empty()) fmt::print(stderr, "nothing of the library fits\n");
    return done;
  }
  std::string question_, kind_;
  std::vector<std::string> items_;
};

class Evaluate : public LibraryCommand {
 public:
  Evaluate() : LibraryCommand("evaluate", "an item of an entity: its equation, table or value, with numbers given for others") {}
  void declare(CLI::App& app) override {
    app.add_option("ID", id_, "entity")->required();
    app.add_option("ITEM", item_, "its name or symbol")->required();
    app.add_option("--with", given_, "a state variable, another value, or the place in a table: --with \"T=310 K\"; may be repeated")->type_name("SYMBOL=VALUE")->allow_extra_args(false);
  }

 private:
  int act(Library& library) override {
    materials::Given given;
    for (const std::string& word : given_) given.insert(parts(word, "evaluate"));
    const Entity entity = library.entity(id_);
    const auto result = materials::evaluate(entity, item_, given, library.units(), [&](const std::string& hash) { return library.file(hash).content; });
    Datum as_si = *result.datum;
    as_si.si = result.si;
    const bool is_table = as_si.type == DatumType::table;
    fmt::print("{:.10g}{}{}", is_table ? result.si : result.in_unit, is_table ? " " + result.si_unit : as_si.unit.empty() ? "" : " " + as_si.unit, "");
    fmt::print("{}\n", is_table || as_si.unit.empty() ? "" : " = " + si_text(as_si, library.units()));
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
    for (const materials::Item& item : materials::usual_items())
      if (kind_.empty() || text_of(item.kind) == kind_)
        fmt::print("  {:<8} {:<14} {:<32} {:<6} {:<10} {}\n", text_of(item.kind), text_of(item.block), item.name, item.symbol, std::string(item.unit).empty() ? "1" : item.unit, item.meaning);
    return done;
  }

 private:
  int act(Library&) override { return done; }
  std::string kind_;
};

class Add : public LibraryCommand {
 public:
  Add() : LibraryCommand("add", "a new entity: add fabric \"my knit\" \"weight=200 g/m2\" LT=0.9 …") {}
  void declare(CLI::App& app) override {
    app.add_option("KIND", kind_, input::joined(input::choices_of<Kind>()))->required()->check(CLI::IsMember(input::choices_of<Kind>()));
    app.add_option("ID", id_, "its name, of the whole library")->required();
    app.add_option("ITEM=VALUE", words_, "number with unit, text, or { equation = \"…\", unit = \"…\" }, { table = \"FILE\" }, { figure = \"FILE\" }");
    app.add_option("--parent", parent_, "an entity one step up");
  }

 private:
  int act(Library& library) override {
    library.change([&](Stroke& stroke) {
      if (library.find(id_)) throw input::InputError({"snug materials add", 0, 0}, "there is a \"" + id_ + "\" already", "take another ID, or change it by edit");
      std::vector<materials::LibraryFile> files;
      Entity entity{.kind = kind_of(kind_), .id = id_, .parent = parent_, .data = data_of(words_, "add", library, files), .where = {"snug materials add", 0, 0}};
      for (const auto& file : files) stroke.keep(file);
      stroke.put(std::move(entity), "added");
    });
    return done;
  }
  std::string kind_, id_, parent_;
  std::vector<std::string> words_;
};

class Copy : public LibraryCommand {
 public:
  Copy() : LibraryCommand("copy", "an entity under a new ID, as your own") {}
  void declare(CLI::App& app) override {
    app.add_option("ID", id_, "what is copied")->required();
    app.add_option("NEW", copy_, "its new ID")->required();
  }

 private:
  int act(Library& library) override {
    library.change([&](Stroke& stroke) {
      Entity entity = stroke.entity(id_);
      if (library.find(copy_)) throw input::InputError({"snug materials copy", 0, 0}, "there is a \"" + copy_ + "\" already", "take another ID");
      entity.id = copy_, entity.shipped = false, entity.where = {"snug materials copy", 0, 0};
      for (Datum& datum : entity.data) datum.shipped = false;
      stroke.put(std::move(entity), "copied from " + id_);
    });
    return done;
  }
  std::string id_, copy_;
};

class Edit : public LibraryCommand {
 public:
  Edit() : LibraryCommand("edit", "items of an entity: edit \"my knit\" \"weight=210 g/m2\"") {}
  void declare(CLI::App& app) override {
    app.add_option("ID", id_, "entity")->required();
    app.add_option("ITEM=VALUE", words_, "in place of all that the entity has of this item");
    app.add_option("--also", also_, "a further value of an item, behind the others: of another source or type")->type_name("ITEM=VALUE")->allow_extra_args(false);
    app.add_option("--remove", removed_, "an item to take away")->type_name("ITEM")->allow_extra_args(false);
    app.add_option("--parent", parent_, "another parent");
  }

 private:
  int act(Library& library) override {
    library.change([&](Stroke& stroke) {
      Entity entity = stroke.entity(id_);
      entity.where = {"snug materials edit", 0, 0};
      if (!parent_.empty()) entity.parent = parent_;
      std::vector<materials::LibraryFile> files;
      for (const std::string& item : removed_) take_away(entity, item);
      const auto set = data_of(words_, "edit", library, files), also = data_of(also_, "edit", library, files);
      for (const Datum& datum : set) replace(entity, datum);
      entity.data.insert(entity.data.end(), also.begin(), also.end());
      for (const auto& file : files) stroke.keep(file);
      stroke.put(std::move(entity), "edited");
    });
    return done;
  }
  static void take_away(Entity& entity, const std::string& item) {
    std::vector<std::string> known;
    for (const Datum& datum : entity.data) known.push_back(datum.name);
    if (!entity.find(item)) throw input::InputError({"snug materials edit", 0, 0}, entity.id + " has no item \"" + item + "\"", input::did_you_mean(item, known));
    std::erase_if(entity.data, [&](const Datum& datum) { return datum.name == item; });
  }
  static void replace(Entity& entity, const Datum& datum) {
    const auto first = std::find_if(entity.data.begin(), entity.data.end(), [&](const Datum& one) { return one.name == datum.name; });
    if (first == entity.data.end()) return entity.data.push_back(datum);
    *first = datum;
    entity.data.erase(std::remove_if(first + 1, entity.data.end(), [&](const Datum& one) { return one.name == datum.name; }), entity.data.end());
  }
  std::string id_, parent_;
  std::vector<std::string> words_, also_, removed_;
};

class Remove : public LibraryCommand {
 public:
  Remove() : LibraryCommand("remove", "an entity of your own; undo brings it back") {}
  void declare(CLI::App& app) override { app.add_option("ID", id_, "entity")->required(); }

 private:
  int act(Library& library) override {
    library.change([&](Stroke& stroke) { stroke.remove(id_); });
    return done;
  }
  std::string id_;
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
    for (const materials::Change& one : library.history(id_, most_)) fmt::print("{:>6}  {}  {:<12} {:<24} {}\n", one.stroke, one.moment, one.who, one.entity, one.action);
    return done;
  }
  std::string id_;
  int most_ = 40;
};

class Undo : public LibraryCommand {
 public:
  Undo() : LibraryCommand("undo", "takes your last change back; again, the one before") {}
  void declare(CLI::App& app) override { app.add_flag("--of-anybody", of_anybody_, "also when somebody else made it"); }

 private:
  int act(Library& library) override {
    fmt::print("{}\n", library.undo(of_anybody_));
    return done;
  }
  bool of_anybody_ = false;
};

class Import : public LibraryCommand {
 public:
  Import() : LibraryCommand("import", "entities of a .toml, .json or .csv file, all or none") {}
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "as docs/library.md shows")->required();
    declare_kind(app, "--kind", kind_);
    app.add_flag("--replace", replace_, "entities of the library by those of the file");
  }

 private:
  int act(Library& library) override {
    const materials::Entries entries = materials::read_entries(file_, kind_of(kind_), library.units());
    library.change([&](Stroke& stroke) {
      for (const auto& file : entries.files) stroke.keep(file);
      for (const Entity& entity : parents_first(entries.entities)) {
        const auto before = library.find(entity.id);
        if (before && before->shipped) continue_if_same(*before, entity);
        if (before && before->shipped) continue;
        if (before && !replace_) refuse_another(*before, entity);
        stroke.put(entity, "imported");
      }
    });
    fmt::print("{} entities\n", entries.entities.size());
    return done;
  }
  /// A copy of what ships may stand in a file, another version of it may not.
  void continue_if_same(const Entity& before, const Entity& entity) const {
    if (materials::same_values(before, entity)) return;
    throw input::InputError(entity.where, "\"" + entity.id + "\" ships with other values", "what ships is not changed: give yours an ID of its own");
  }
  void refuse_another(const Entity& before, const Entity& entity) const {
    if (materials::same_values(before, entity)) return;
    throw input::InputError(entity.where, "there is a \"" + entity.id + "\" already, with other values", "take another ID, or say --replace");
  }
  static std::vector<Entity> parents_first(std::vector<Entity> entities) {
    std::stable_sort(entities.begin(), entities.end(), [](const Entity& a, const Entity& b) { return a.kind > b.kind; });
    return entities;
  }
  std::string file_, kind_ = "fabric";
  bool replace_ = false;
};

class Export : public LibraryCommand {
 public:
  Export() : LibraryCommand("export", "entities to a .toml, .json or .csv file, which import reads to the same") {}
  void declare(CLI::App& app) override {
    app.add_option("FILE", file_, "what its ending says")->required();
    app.add_option("QUESTION", question_, "only those (snug materials find)");
    app.add_flag("--own", own_, "only what does not ship");
  }

 private:
  int act(Library& library) override {
    std::vector<Entity> entities;
    for (const std::string& id : question_.empty() ? library.ids() : library.find_where(question_)) entities.push_back(library.entity(id));
    if (own_) std::erase_if(entities, [](const Entity& entity) { return entity.shipped; });
    materials::write_entries(entities, library, file_);
    fmt::print("{} entities\n", entities.size());
    return done;
  }
  std::string file_, question_;
  bool own_ = false;
};

class CheckLibrary : public LibraryCommand {
 public:
  CheckLibrary() : LibraryCommand("check", "reads the whole file for damage and compares it with the texts that ship") {}
  void declare(CLI::App&) override {}

 private:
  int act(Library& library) override {
    library.check_file();
    const auto differences = library.differences(materials::shipped_entries(library.units()));
    for (const std::string& line : differences) fmt::print("{}\n", line);
    fmt::print("{}: {} entities, {}\n", library_file().string(), library.count(), differences.empty() ? "sound, as the texts have it" : "sound, but not as the texts have it");
    return differences.empty() ? done : outside_tolerance;
  }
};

}  // namespace

std::vector<std::unique_ptr<Command>> library_commands() {
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<Find>());
  commands.push_back(std::make_unique<Evaluate>());
  commands.push_back(std::make_unique<Items>());
  commands.push_back(std::make_unique<Add>());
  commands.push_back(std::make_unique<Copy>());
  commands.push_back(std::make_unique<Edit>());
  commands.push_back(std::make_unique<Remove>());
  commands.push_back(std::make_unique<History>());
  commands.push_back(std::make_unique<Undo>());
  commands.push_back(std::make_unique<Import>());
  commands.push_back(std::make_unique<Export>());
  commands.push_back(std::make_unique<CheckLibrary>());
  return commands;
}

materials::Library open_library() {
  const std::filesystem::path file = library_file();
  if (file.empty()) throw input::InputError({"snug materials", 0, 0}, "there is no home folder to keep the library in", "name its file in SNUG_LIBRARY");
  return Library(materials::library_settings(file, user_name()));
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
