#include "materials/database/named.hpp"

#include <algorithm>
#include <cctype>

#include "cases/input/key_list.hpp"
#include "cases/input/suggestion.hpp"
#include "materials/database/sha256.hpp"
#include "materials/database/shipped.hpp"
#include "materials/fabric/inputs.hpp"
#include "materials/fabric/measured.hpp"
#include "materials/laws/inputs.hpp"

namespace snug::materials {

namespace {

input::Table section(const std::string& kind, const char* text, const std::string& file) {
  input::Table all;
  all.set(kind, input::value_without_place(input::table_of(text, {"materials/data/" + file, 1, 1})));
  return all;
}

std::string shipped_file(const std::string& name, const input::Location& where) {
  for (const ShippedText& one : shipped_library())
    if (name == one.name) return one.text;
  throw input::InputError(where, "no file " + name + " ships", "put it into materials/data/library");
}

/// The same number, as far as both print it.
bool same_number(const Datum& a, const Datum& b) {
  return a.name == b.name && a.type == b.type && a.si && b.si && *a.si == *b.si && a.unit == b.unit;
}

/// What a run reads and what is printed, put together.
void merge(Entity& run, const Entity& printed) {
  std::vector<Datum> data;
  for (const Datum& datum : run.data) {
    const auto same = std::find_if(printed.data.begin(), printed.data.end(),
                                   [&](const Datum& other) { return same_number(datum, other); });
    data.push_back(same == printed.data.end() ? datum : *same);
  }
  for (const Datum& datum : printed.data)
    if (std::find(data.begin(), data.end(), datum) == data.end()) data.push_back(datum);
  run.data = std::move(data);
}

void add(const Entries& more, Entries& all) {
  for (const Entity& entity : more.entities) {
    const auto same =
        std::find_if(all.entities.begin(), all.entities.end(), [&](const Entity& one) { return one.id == entity.id; });
    if (same == all.entities.end())
      all.entities.push_back(entity);
    else
      merge(*same, entity);
  }
  all.files.insert(all.files.end(), more.files.begin(), more.files.end());
}

template <class Form>
void add_keys(std::vector<std::string>& keys) {
  for (const input::KeyRow& row : input::keys_of<Form>())
    keys.push_back(row.key.substr(0, row.key.find_first_of(".[")));
}

/// In the library a curve stands as its points: it names no files of a case, and needs no size of the strip.
void add_curve_keys(std::vector<std::string>& keys) {
  std::vector<std::string> all;
  add_keys<CurveFabric>(all);
  for (const std::string& key : all)
    if (key != "warp" && key != "weft" && key != "width" && key != "gauge_length") keys.push_back(key);
}

std::vector<std::string> law_keys_of(Kind kind) {
  std::vector<std::string> keys = common_keys();
  if (kind == Kind::fabric)
    add_keys<LinearFabric>(keys), add_keys<CubicFabric>(keys), add_keys<KesFabric>(keys), add_curve_keys(keys),
        add_keys<FastFabric>(keys);
  if (kind == Kind::tissue) {
    for_each_law_input([&]<class Input>() { add_keys<Input>(keys); });
    keys.insert(keys.end(), {"range", "density"});
  }
  return keys;
}

/// Of one law: what others would call unknown keys.
std::vector<std::string> keys_of_law(Kind kind, const std::string& law) {
  std::vector<std::string> keys = common_keys();
  if (kind == Kind::fabric) {
    if (law == "linear") add_keys<LinearFabric>(keys);
    if (law == "cubic") add_keys<CubicFabric>(keys);
    if (law == "kes") add_keys<KesFabric>(keys);
    if (law == "curve") add_curve_keys(keys);
    if (law == "fast") add_keys<FastFabric>(keys);
  } else {
    for_each_law_input([&]<class Input>() {
      if (Input::page().name == law) add_keys<Input>(keys);
    });
    keys.insert(keys.end(), {"range", "density"});
  }
  return keys;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// One follows from the other; the force is what the law takes.
void keep_one_of_force_and_elongation(input::Table& tension) {
  if (tension.find("Fm") && tension.find("EMT")) tension.remove("EMT");
}

/// Names of tables, which programs of testing machines write.
bool is_table_file(const std::string& name) {
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return contains({".csv", ".txt", ".tsv", ".xlsx"}, ending);
}

/// Whoever names the file of a strip test where a fabric is named wants its curves.
[[noreturn]] void refuse_name(const input::MaterialEntry& asked, Kind kind, const std::vector<std::string>& known) {
  if (kind == Kind::fabric && is_table_file(asked.name))
    throw input::InputError(asked.where, "\"" + asked.name + "\" is a file, and no fabric is called so",
                            "write the curves of a strip test as fabric = { law = \"curve\", warp = \"" + asked.name +
                                "\", weft = \"...\", width = \"50 mm\", shear = \"...\" }");
  throw input::InputError(asked.where, "no " + input::text_of(kind) + " is called \"" + asked.name + "\"",
                          input::did_you_mean(asked.name, known));
}

input::MaterialEntry from_library(const input::MaterialEntry& asked, Kind kind, const std::filesystem::path& file,
                                  std::vector<std::string> known) {
  std::error_code ignored;
  if (!file.empty() && std::filesystem::exists(file, ignored)) {
    const Library library(library_settings(file, "snug"));
    const auto entity = library.find(asked.name);
    if (entity && entity->kind == kind) return entry_of(*entity, asked.where, library.units());
    if (entity)
      throw input::InputError(asked.where,
                              "\"" + asked.name + "\" of the library is a " + input::text_of(entity->kind) +
                                  ", not a " + input::text_of(kind),
                              "name one of that kind (snug materials find \"kind = " + input::text_of(kind) + "\")");
    for (const std::string& id : library.ids(kind))
      if (!contains(known, id)) known.push_back(id);
  }
  refuse_name(asked, kind, known);
}

}  // namespace

input::MaterialEntry entry_of(const Entity& entity, const input::Location& where, UnitBook& units) {
  const Datum* law = entity.find("law");
  if (!law)
    throw input::InputError(where,
                            "the " + input::text_of(entity.kind) + " \"" + entity.id + "\" of the library has no law",
                            "say which one reads its numbers, e.g. snug materials edit \"" + entity.id +
                                "\" law=" + (entity.kind == Kind::fabric ? "kes" : "neo-Hooke"));
  const input::Table all = law_table(entity, units);
  const std::vector<std::string> keys = keys_of_law(entity.kind, law->value);
  input::MaterialEntry entry{.name = {}, .table = {}, .where = where};
  for (const input::Entry& one : all.entries)
    if (contains(keys, one.key)) entry.table.entries.push_back({one.key, where, one.value});
  if (!entry.table.find("source"))
    entry.table.set("source", input::value_without_place("entity \"" + entity.id + "\" of the library"));
  if (entity.kind == Kind::fabric) {
    keep_one_of_force_and_elongation(entry.table);
    if (input::Value* weft = entry.table.find("weft"); weft && weft->table()) keep_one_of_force_and_elongation(*weft->table());
  }
  entry.table.where = where;
  return entry;
}

Entries shipped_entries(UnitBook& units) {
  input::Diagnostics diagnostics;
  Entries all;
  add(entries_of(section("fabric", shipped_fabrics, "fabrics.toml"), shipped_file, units, diagnostics), all);
  add(entries_of(section("tissue", shipped_tissues, "tissues.toml"), shipped_file, units, diagnostics), all);
  for (const ShippedText& one : shipped_library())
    if (std::string(one.name).ends_with(".toml"))
      add(entries_of(input::table_of(one.text, {"materials/data/library/" + std::string(one.name), 1, 1}), shipped_file,
                     units, diagnostics),
          all);
  diagnostics.throw_if_any();
  return all;
}

std::string shipped_edition() {
  std::string all = std::string(shipped_fabrics) + shipped_tissues;
  for (const ShippedText& one : shipped_library()) all += std::string(one.name) + "\n" + one.text;
  return sha256(all);
}

bool is_law_key(Kind kind, const std::string& item) {
  return (kind == Kind::fabric || kind == Kind::tissue) && contains(law_keys_of(kind), item.substr(0, item.find('.')));
}

Library::Settings library_settings(const std::filesystem::path& file, const std::string& who) {
  return {.file = file, .who = who, .shipped = shipped_entries, .edition = shipped_edition(), .is_law_key = is_law_key};
}

input::MaterialEntry resolved(const input::MaterialEntry& asked, Kind kind, const std::filesystem::path& file) {
  if (asked.is_inline() || asked.name.empty() || asked.name == "rigid") return asked;
  std::vector<std::string> known = kind == Kind::fabric ? fabric_names() : tissue_names();
  if (contains(known, asked.name)) return asked;
  UnitBook units;
  for (const Entity& entity : shipped_entries(units).entities) {
    if (entity.id == asked.name && entity.kind == kind) return entry_of(entity, asked.where, units);
    if (entity.kind == kind && entity.find("law") && !contains(known, entity.id)) known.push_back(entity.id);
  }
  return from_library(asked, kind, file, std::move(known));
}

std::vector<std::string> further_shipped(Kind kind) {
  const std::vector<std::string> known = kind == Kind::fabric ? fabric_names() : tissue_names();
  UnitBook units;
  std::vector<std::string> names;
  for (const Entity& entity : shipped_entries(units).entities)
    if (entity.kind == kind && entity.find("law") && !contains(known, entity.id)) names.push_back(entity.id);
  return names;
}

}  // namespace snug::materials
