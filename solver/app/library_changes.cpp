// Commands that write to the library, or out of it.
#include <fmt/format.h>

#include <algorithm>

#include "materials/database/doubts.hpp"
#include "materials/database/exchange.hpp"
#include "solver/app/library_command.hpp"

namespace snug::app {

namespace {

using materials::Datum, materials::Entity, materials::Kind, materials::Library, materials::Stroke;

/// Data of "ITEM=VALUE": a text as in a file, or a table of TOML such as { equation = "EA*thickness", unit = "N/m" }.
std::vector<Datum> data_of(const std::vector<std::string>& words, const std::string& command, Library& library,
                           std::vector<materials::LibraryFile>& files) {
  std::vector<Datum> data;
  for (const std::string& word : words) {
    const auto [item, value] = item_and_value(word, command);
    if (value.starts_with("{") || value.starts_with("[")) {
      input::Table table;
      const input::Table parsed = input::table_of("value = " + value, {"snug materials " + command, 0, 0});
      table.set(item, *parsed.find("value"));
      input::Diagnostics diagnostics;
      std::vector<Datum> read =
          materials::data_of(table, materials::files_of("."), library.units(), files, diagnostics);
      diagnostics.throw_if_any();
      data.insert(data.end(), read.begin(), read.end());
    } else {
      data.push_back(materials::datum_of(item, value, library.units()));
    }
  }
  return data;
}

/// Says what does not go together; it is kept all the same.
void tell_doubts(const Entity& entity, Console& console) {
  for (const std::string& doubt : materials::doubts_of(entity)) console.warn(fmt::format("warning: {}: {}", entity.id, doubt));
}

class Add : public LibraryCommand {
 public:
  Add() : LibraryCommand("add", "a new entity: add fabric \"my knit\" \"weight=200 g/m2\" LT=0.9 …") {}
  void declare(CLI::App& app) override {
    app.add_option("KIND", kind_, input::joined(input::choices_of<Kind>()))
        ->required()
        ->check(CLI::IsMember(input::choices_of<Kind>()));
    app.add_option("ID", id_, "its name, of the whole library")->required();
    app.add_option(
        "ITEM=VALUE", words_,
        "number with unit, text, or { equation = \"…\", unit = \"…\" }, { table = \"FILE\" }, { figure = \"FILE\" }");
    app.add_option("--parent", parent_, "an entity one step up");
  }

 private:
  int act(Library& library) override {
    library.change([&](Stroke& stroke) {
      if (library.find(id_))
        throw input::InputError({"snug materials add", 0, 0}, "there is a \"" + id_ + "\" already",
                                "take another ID, or change it by edit");
      std::vector<materials::LibraryFile> files;
      Entity entity{.kind = kind_of(kind_),
                    .id = id_,
                    .parent = parent_,
                    .data = data_of(words_, "add", library, files),
                    .where = {"snug materials add", 0, 0}};
      for (const auto& file : files) stroke.keep(file);
      stroke.put(std::move(entity), "added");
    });
    tell_doubts(library.entity(id_), console());
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
      if (library.find(copy_))
        throw input::InputError({"snug materials copy", 0, 0}, "there is a \"" + copy_ + "\" already",
                                "take another ID");
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
    app.add_option("--also", also_, "a further value of an item, behind the others: of another source or type")
        ->type_name("ITEM=VALUE")
        ->allow_extra_args(false);
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
    tell_doubts(library.entity(id_), console());
    return done;
  }
  static void take_away(Entity& entity, const std::string& item) {
    std::vector<std::string> known;
    for (const Datum& datum : entity.data) known.push_back(datum.name);
    if (!entity.find(item))
      throw input::InputError({"snug materials edit", 0, 0}, entity.id + " has no item \"" + item + "\"",
                              input::did_you_mean(item, known));
    std::erase_if(entity.data, [&](const Datum& datum) { return datum.name == item; });
  }
  static void replace(Entity& entity, const Datum& datum) {
    const auto first =
        std::find_if(entity.data.begin(), entity.data.end(), [&](const Datum& one) { return one.name == datum.name; });
    if (first == entity.data.end()) return entity.data.push_back(datum);
    *first = datum;
    entity.data.erase(
        std::remove_if(first + 1, entity.data.end(), [&](const Datum& one) { return one.name == datum.name; }),
        entity.data.end());
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

class Undo : public LibraryCommand {
 public:
  Undo() : LibraryCommand("undo", "takes your last change back; again, the one before") {}
  void declare(CLI::App& app) override { app.add_flag("--of-anybody", of_anybody_, "also when somebody else made it"); }

 private:
  int act(Library& library) override {
    console().print("{}\n", library.undo(of_anybody_));
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
    for (const Entity& entity : entries.entities) tell_doubts(entity, console());
    console().print("{} entities\n", entries.entities.size());
    return done;
  }
  /// A copy of what ships may stand in a file, another version of it may not.
  void continue_if_same(const Entity& before, const Entity& entity) const {
    if (materials::same_values(before, entity)) return;
    throw input::InputError(entity.where, "\"" + entity.id + "\" ships with other values",
                            "what ships is not changed: give yours an ID of its own");
  }
  void refuse_another(const Entity& before, const Entity& entity) const {
    if (materials::same_values(before, entity)) return;
    throw input::InputError(entity.where, "there is a \"" + entity.id + "\" already, with other values",
                            "take another ID, or say --replace");
  }
  static std::vector<Entity> parents_first(std::vector<Entity> entities) {
    std::stable_sort(entities.begin(), entities.end(),
                     [](const Entity& a, const Entity& b) { return a.kind > b.kind; });
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
    for (const std::string& id : question_.empty() ? library.ids() : library.find_where(question_))
      entities.push_back(library.entity(id));
    if (own_) std::erase_if(entities, [](const Entity& entity) { return entity.shipped; });
    materials::write_entries(entities, library, file_);
    console().print("{} entities\n", entities.size());
    return done;
  }
  std::string file_, question_;
  bool own_ = false;
};

}  // namespace

void add_changing_commands(std::vector<std::unique_ptr<Command>>& commands) {
  commands.push_back(std::make_unique<Add>());
  commands.push_back(std::make_unique<Copy>());
  commands.push_back(std::make_unique<Edit>());
  commands.push_back(std::make_unique<Remove>());
  commands.push_back(std::make_unique<Undo>());
  commands.push_back(std::make_unique<Import>());
  commands.push_back(std::make_unique<Export>());
}

}  // namespace snug::app
