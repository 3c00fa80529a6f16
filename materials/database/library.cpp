#include "materials/database/library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "cases/input/suggestion.hpp"
#include "materials/database/equation.hpp"
#include "materials/database/evaluation.hpp"
#include "materials/database/items.hpp"
#include "materials/database/query.hpp"
#include "materials/database/schema.hpp"
#include "materials/database/sqlite.hpp"

namespace snug::materials {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t checked_at_opening = 16 << 20;  // bytes that are read through each time, in some 10 ms; larger files by snug materials check
constexpr std::int64_t most_bounded = 20'000;  // entities that an index is followed to
constexpr std::size_t most_named = 40;  // names that a message lists

sql::Connection opened(const fs::path& file) {
  std::error_code ignored;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), ignored);  // where this fails the opening says so
  sql::Connection connection(file, sql::Connection::Open::or_new);
  sql::bring_up_to_date(connection);
  std::error_code unknown;
  const auto size = fs::file_size(file, unknown);
  if (!unknown && size <= checked_at_opening) sql::check_for_damage(connection);
  return connection;
}

/// What the user wrote, at the places that a statement has of it.
void bind_places(const Condition& condition, sql::Statement& statement) {
  const int count = std::min(statement.places(), static_cast<int>(condition.places.size()));
  for (int place = 1; place <= count; ++place) std::visit([&](const auto& one) { statement.bind(place, one); }, condition.places[static_cast<std::size_t>(place) - 1]);
}

/// Data of one name stand together, where the first of them stood.
void gather(Entity& entity) {
  std::map<std::string, std::size_t> first;
  for (std::size_t n = 0; n < entity.data.size(); ++n) first.emplace(entity.data[n].name, n);
  std::stable_sort(entity.data.begin(), entity.data.end(), [&](const Datum& a, const Datum& b) { return first[a.name] < first[b.name]; });
}

/// An entity as it was, with the marks of what ships: for the history alone.
std::string snapshot(const Entity& entity) {
  nlohmann::json data = nlohmann::json::array();
  for (const Datum& one : entity.data)
    data.push_back({one.name, one.shipped, input::text_of(one.type), one.symbol, one.value, one.unit, one.uncertainty, one.low, one.high, one.source});
  return nlohmann::json{{"kind", input::text_of(entity.kind)}, {"id", entity.id}, {"parent", entity.parent}, {"shipped", entity.shipped}, {"data", data}}.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

Entity from_snapshot(const std::string& text) try {
  const nlohmann::json json = nlohmann::json::parse(text);
  Entity entity{.kind = input::choice_of<Kind>(json.at("kind")).value(), .id = json.at("id"), .parent = json.at("parent"), .shipped = json.at("shipped")};
  for (const nlohmann::json& one : json.at("data"))
    entity.data.push_back({.name = one.at(0), .symbol = one.at(3), .type = input::choice_of<DatumType>(one.at(2)).value(), .value = one.at(4), .unit = one.at(5),
                           .uncertainty = one.at(6), .low = one.at(7), .high = one.at(8), .source = one.at(9), .shipped = one.at(1)});
  return entity;
} catch (const std::exception&) {
  throw input::InputError({"library", 0, 0}, "the history of the library is damaged", "nothing was changed; put a backup in its place");
}

input::InputError unknown(const std::string& id, std::vector<std::string> known) {
  const std::string near = input::nearest(id, known);
  if (known.size() > most_named) known.resize(most_named), known.push_back("...");
  return {{"library", 0, 0}, "no entity is called \"" + id + "\"", (near.empty() ? "" : "did you mean " + near + "? ") + ("known: " + input::joined(known))};
}

}  // namespace

struct Library::Rooms {
  explicit Rooms(const Settings& asked)
      : settings(asked),
        connection(opened(asked.file)),
        entity_by_id(connection.prepare("SELECT e.number, e.kind, p.id, e.shipped FROM entity e LEFT JOIN entity p ON p.number = e.parent WHERE e.id = ?1")),
        data_of(connection.prepare("SELECT name, shipped, type, symbol, value, unit, uncertainty, low, high, source, si FROM datum WHERE entity = ?1 ORDER BY place")),
        number_of(connection.prepare("SELECT number, kind, shipped FROM entity WHERE id = ?1")),
        add_entity(connection.prepare("INSERT INTO entity (id, kind, parent, shipped) VALUES (?1, ?2, ?3, ?4)")),
        set_entity(connection.prepare("UPDATE entity SET parent = ?2, shipped = ?3 WHERE number = ?1")),
        remove_data(connection.prepare("DELETE FROM datum WHERE entity = ?1")),
        add_datum(connection.prepare("INSERT INTO datum (entity, place, name, first, shipped, type, symbol, value, unit, uncertainty, low, high, source, si) "
                                     "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)")),
        item_by_name(connection.prepare("SELECT si_unit FROM item WHERE name = ?1")),
        add_item(connection.prepare("INSERT OR IGNORE INTO item (name, si_unit) VALUES (?1, ?2)")),
        add_change(connection.prepare("INSERT INTO change (stroke, who, action, entity, before, undoes) VALUES (?1, ?2, ?3, ?4, ?5, ?6)")) {}

  Settings settings;
  sql::Connection connection;
  sql::Statement entity_by_id, data_of, number_of, add_entity, set_entity, remove_data, add_datum, item_by_name, add_item, add_change;
  UnitBook units;
  std::map<std::string, std::string> items = {};  // by name: unit, or "text"; they are never changed
  std::int64_t stroke = 0;                        // that is being made
  std::optional<std::int64_t> undoes = {};
  bool shipping = false, undoing = false;         // what ships may change

  std::optional<std::string> item(const std::string& name) {
    const auto known = items.find(name);
    if (known != items.end()) return known->second;
    item_by_name.bind(1, name);
    if (!item_by_name.step()) return std::nullopt;
    const std::string unit = item_by_name.is_null(0) ? "text" : item_by_name.text(0);
    item_by_name.reset();
    return items.emplace(name, unit).first->second;
  }

  /// One item has one dimension everywhere: what the usual list says, else what it had at first.
  void check_item(const Datum& datum, const input::Location& where, input::Diagnostics& diagnostics) {
    if (datum.type == DatumType::table || datum.type == DatumType::figure) return;
    const bool is_text = datum.type == DatumType::value && !datum.si && datum.unit.empty() && !datum.value.empty();  // nothing: a state variable
    const auto own = units.find(datum.unit);
    if (!own) return;  // reported before
    auto expected = item(datum.name);
    if (!expected) {
      const Item* usual = usual_item(datum.name.substr(datum.name.rfind('.') + 1));
      expected = usual ? usual->unit : is_text ? "text" : own->name;
      if (*expected == "text")
        add_item.bind(1, datum.name).bind_null(2).run();
      else
        add_item.bind(1, datum.name).bind(2, *expected).run();
      items.emplace(datum.name, *expected);
    }
    if (is_text && *expected != "text")
      diagnostics.error(where, datum.name + ": \"" + datum.value + "\" is no number", "it is one everywhere else" + (expected->empty() ? ", without a unit" : ", in " + *expected) + "; name a text otherwise");
    else if (!is_text && *expected == "text" && !usual_item(datum.name))
      diagnostics.error(where, datum.name + " is a number here and a text everywhere else", "name it otherwise");
    else if (!is_text && *expected != "text" && !Dimension(own->name).same_as(Dimension(*expected)))
      diagnostics.error(where, datum.name + ": \"" + quantity_text(datum) + "\" " + (datum.unit.empty() ? "has no unit" : "is of another dimension"),
                        "write it with a unit that converts to " + (expected->empty() ? "a plain number" : *expected));
  }

  std::optional<Entity> find(const std::string& id) {
    entity_by_id.bind(1, id);
    if (!entity_by_id.step()) return std::nullopt;
    const auto kind = input::choice_of<Kind>(entity_by_id.text(1));
    Entity entity{.kind = kind.value_or(Kind::fabric), .id = id, .parent = entity_by_id.text(2), .shipped = entity_by_id.integer(3) != 0};
    data_of.bind(1, entity_by_id.integer(0));
    entity_by_id.reset();
    while (data_of.step()) {
      Datum datum{.name = data_of.text(0), .symbol = data_of.text(3), .type = input::choice_of<DatumType>(data_of.text(2)).value_or(DatumType::value), .value = data_of.text(4),
                  .unit = data_of.text(5), .uncertainty = data_of.text(6), .low = data_of.text(7), .high = data_of.text(8), .source = data_of.text(9), .shipped = data_of.integer(1) != 0};
      if (!data_of.is_null(10)) datum.si = data_of.number(10);
      entity.data.push_back(std::move(datum));
    }
    return entity;
  }

  /// Of the bounds of a question the one with the fewest entities, when that is few enough to be worth while.
  std::string narrowest(const Condition& condition) const {
    std::int64_t fewest = most_bounded;
    std::string best;
    for (const std::string& bound : condition.bounds) {
      sql::Statement count = connection.prepare("SELECT count(*) FROM (" + bound + " LIMIT " + std::to_string(fewest) + ")");
      bind_places(condition, count);
      count.step();
      if (count.integer(0) < fewest) fewest = count.integer(0), best = bound;
    }
    return best;
  }

  void write_data(std::int64_t number, const Entity& entity) {
    std::int64_t place = 0;
    for (const Datum& one : entity.data) {
      const bool first = place == 0 || entity.data[static_cast<std::size_t>(place) - 1].name != one.name;  // gathered before
      add_datum.bind(1, number).bind(2, place++).bind(3, one.name).bind(4, first ? 1 : 0).bind(5, one.shipped ? 1 : 0).bind(6, input::text_of(one.type));
      add_datum.bind_text_or_null(7, one.symbol).bind(8, one.value).bind_text_or_null(9, one.unit).bind_text_or_null(10, one.uncertainty);
      add_datum.bind_text_or_null(11, one.low).bind_text_or_null(12, one.high).bind_text_or_null(13, one.source).bind(14, one.si).run();
    }
  }

  void note_change(const std::string& action, const std::string& id, const std::optional<Entity>& before) {
    add_change.bind(1, stroke).bind(2, settings.who).bind(3, action).bind(4, id);
    if (before)
      add_change.bind(5, snapshot(*before));
    else
      add_change.bind_null(5);
    add_change.bind(6, undoes).run();
  }

  /// Row of the parent, after a look at its kind.
  std::optional<std::int64_t> parent_of(const Entity& entity, input::Diagnostics& diagnostics) {
    if (entity.parent.empty()) return std::nullopt;
    number_of.bind(1, entity.parent);
    if (!number_of.step()) {
      diagnostics.error(entity.where, entity.id + ": there is no entity \"" + entity.parent + "\" to be its parent", "add the parent first");
      return std::nullopt;
    }
    const std::int64_t number = number_of.integer(0);
    const auto kind = input::choice_of<Kind>(number_of.text(1));
    number_of.reset();
    const std::vector<Kind> fit = parents_of(entity.kind);
    std::vector<std::string> names;
    for (const Kind one : fit) names.push_back(input::text_of(one));
    if (!kind || std::find(fit.begin(), fit.end(), *kind) == fit.end())
      diagnostics.error(entity.where, entity.id + ": the parent " + entity.parent + " is a " + (kind ? input::text_of(*kind) : std::string("thing of an unknown kind")),
                        names.empty() ? "a " + input::text_of(entity.kind) + " has none" : "the parent of a " + input::text_of(entity.kind) + " is a " + input::joined(names));
    return number;
  }

  /// What ships is the text's: it stays as it is, and what a run reads of it is not added to.
  void check_shipped(const Entity& before, const Entity& after, input::Diagnostics& diagnostics) const {
    if (shipping || undoing || !before.shipped) return;
    const std::string remedy = "what ships is not changed: copy it (snug materials copy " + before.id + " \"my " + before.id + "\") and change the copy";
    if (before.kind != after.kind || before.parent != after.parent) return diagnostics.error(after.where, before.id + " ships with this parent and kind", remedy);
    std::vector<Datum> was, is;
    std::copy_if(before.data.begin(), before.data.end(), std::back_inserter(was), [](const Datum& one) { return one.shipped; });
    std::copy_if(after.data.begin(), after.data.end(), std::back_inserter(is), [](const Datum& one) { return one.shipped; });
    if (was != is) return diagnostics.error(after.where, before.id + " ships with these values", remedy);
    for (const Datum& one : after.data)
      if (!one.shipped && after.find(one.name) == &one && (std::any_of(was.begin(), was.end(), [&](const Datum& other) { return other.name == one.name; }) ||
                                                           (settings.is_law_key && settings.is_law_key(after.kind, one.name))))
        diagnostics.error(after.where, before.id + ": a run would read your " + one.name, remedy);
  }

  void put(Entity entity, const std::string& action) {
    input::Diagnostics diagnostics;
    gather(entity);
    check_id(entity.id, entity.where, diagnostics);
    if (entity.id == "rigid") diagnostics.error(entity.where, "\"rigid\" is a word of the cases", "take another name");
    bool has_equation = false;
    for (Datum& datum : entity.data) {
      check_datum(datum, units, entity.where, diagnostics);
      has_equation = has_equation || datum.type == DatumType::equation;
    }
    diagnostics.throw_if_any();
    for (const Datum& datum : entity.data) check_item(datum, entity.where, diagnostics);
    if (has_equation) check_equations(entity, units, diagnostics);
    const auto parent = parent_of(entity, diagnostics);
    const auto before = find(entity.id);
    if (before && before->kind != entity.kind) diagnostics.error(entity.where, entity.id + " is the ID of a " + input::text_of(before->kind), "take another one: IDs are those of the whole library");
    if (before) check_shipped(*before, entity, diagnostics);
    diagnostics.throw_if_any();
    if (before && before->same_content(entity) && before->shipped == entity.shipped) return;  // nothing changes
    write(entity, parent, before.has_value());
    note_change(action, entity.id, before);
  }

  void write(const Entity& entity, const std::optional<std::int64_t>& parent, bool is_there) {
    if (!is_there) {
      add_entity.bind(1, entity.id).bind(2, input::text_of(entity.kind)).bind(3, parent).bind(4, entity.shipped ? 1 : 0).run();
      return write_data(connection.last_row(), entity);
    }
    number_of.bind(1, entity.id);
    number_of.step();
    const std::int64_t number = number_of.integer(0);
    number_of.reset();
    set_entity.bind(1, number).bind(2, parent).bind(3, entity.shipped ? 1 : 0).run();
    remove_data.bind(1, number).run();
    write_data(number, entity);
  }

  void remove(const Entity& entity, const std::string& action) {
    const input::Location where{"library", 0, 0};
    if (entity.shipped && !shipping && !undoing) throw input::InputError(where, entity.id + " ships with snug", "what ships is not removed");
    sql::Statement children = connection.prepare("SELECT c.id FROM entity c JOIN entity e ON c.parent = e.number WHERE e.id = ?1 LIMIT 1");
    if (children.bind(1, entity.id).step()) throw input::InputError(where, entity.id + " is the parent of " + children.text(0), "remove that first, or give it another parent");
    connection.prepare("DELETE FROM entity WHERE id = ?1").bind(1, entity.id).run();
    note_change(action, entity.id, entity);
  }

  void rename(const Entity& entity, const std::string& id) {
    connection.prepare("UPDATE entity SET id = ?2 WHERE id = ?1").bind(1, entity.id).bind(2, id).run();
    note_change("renamed to " + id + ", since snug ships one of this ID", entity.id, entity);
  }
};

Entity Stroke::entity(const std::string& id) const { return library_.entity(id); }
void Stroke::put(Entity entity, const std::string& action) { library_.rooms_->put(std::move(entity), action); }
void Stroke::remove(const std::string& id) { library_.rooms_->remove(library_.entity(id), "removed"); }

void Stroke::keep(const LibraryFile& file) {
  library_.rooms_->connection.prepare("INSERT OR IGNORE INTO file (hash, name, content) VALUES (?1, ?2, ?3)").bind(1, file.hash).bind(2, file.name).bind_bytes(3, file.content).run();
}

Library::Library(const Settings& settings) : rooms_(std::make_unique<Rooms>(settings)) {
  if (settings.shipped) bring_shipped_up_to_date();
}
Library::~Library() = default;
Library::Library(Library&&) noexcept = default;

UnitBook& Library::units() const { return rooms_->units; }

std::optional<Entity> Library::find(const std::string& id) const { return rooms_->find(id); }

Entity Library::entity(const std::string& id) const {
  if (auto found = find(id)) return *std::move(found);
  throw unknown(id, ids());
}

std::vector<std::string> Library::ids(std::optional<Kind> kind) const {
  sql::Statement all = rooms_->connection.prepare(kind ? "SELECT id FROM entity WHERE kind = ?1 ORDER BY number" : "SELECT id FROM entity ORDER BY number");
  if (kind) all.bind(1, input::text_of(*kind));
  std::vector<std::string> ids;
  while (all.step()) ids.push_back(all.text(0));
  return ids;
}

std::vector<std::string> Library::children(const std::string& id) const {
  sql::Statement below = rooms_->connection.prepare("SELECT c.id FROM entity c JOIN entity e ON c.parent = e.number WHERE e.id = ?1 ORDER BY c.number");
  below.bind(1, id);
  std::vector<std::string> ids;
  while (below.step()) ids.push_back(below.text(0));
  return ids;
}

std::int64_t Library::count() const { return rooms_->connection.integer("SELECT count(*) FROM entity"); }

std::vector<std::string> Library::find_where(const std::string& question, std::optional<Kind> kind) const {
  std::vector<std::string> known;
  sql::Statement items = rooms_->connection.prepare("SELECT name FROM item ORDER BY name LIMIT 2000");
  while (items.step()) known.push_back(items.text(0));
  const Condition condition = parse_question(question, rooms_->units, [&](const std::string& name) { return rooms_->item(name); }, known);
  const std::string of_kind = kind ? " AND e.kind = ?" + std::to_string(condition.places.size() + 1) : "";
  const std::string bound = rooms_->narrowest(condition);
  sql::Statement found = rooms_->connection.prepare("SELECT e.id FROM entity e WHERE " + (bound.empty() ? "" : "e.number IN (" + bound + ") AND ") + "(" + condition.sql + ")" + of_kind +
                                                    " ORDER BY e.number");
  bind_places(condition, found);
  if (kind) found.bind(static_cast<int>(condition.places.size()) + 1, input::text_of(*kind));
  std::vector<std::string> ids;
  while (found.step()) ids.push_back(found.text(0));
  return ids;
}

LibraryFile Library::file(const std::string& hash) const {
  sql::Statement one = rooms_->connection.prepare("SELECT name, content FROM file WHERE hash = ?1");
  one.bind(1, hash);
  if (!one.step()) throw input::InputError({"library", 0, 0}, "no file of the hash " + hash, "import the text that refers to it together with the file");
  return {.hash = hash, .name = one.text(0), .content = one.text(1)};
}

void Library::change(const std::function<void(Stroke&)>& make) {
  sql::Transaction writing(rooms_->connection);
  rooms_->stroke = rooms_->connection.integer("SELECT coalesce(max(stroke), 0) + 1 FROM change");
  Stroke stroke(*this);
  try {
    make(stroke);
    writing.commit();
  } catch (...) {
    rooms_->items.clear();  // some of them may have been of this stroke
    rooms_->undoes.reset(), rooms_->undoing = rooms_->shipping = false;
    throw;
  }
}

std::vector<Change> Library::history(const std::string& id, int most) const {
  sql::Statement changes = rooms_->connection.prepare(std::string("SELECT number, stroke, moment, who, action, entity, undoes FROM change ") + (id.empty() ? "" : "WHERE entity = ?2 ") +
                                                      "ORDER BY number DESC LIMIT ?1");
  changes.bind(1, most);
  if (!id.empty()) changes.bind(2, id);
  std::vector<Change> history;
  while (changes.step()) {
    history.push_back({.number = changes.integer(0), .stroke = changes.integer(1), .moment = changes.text(2), .who = changes.text(3), .action = changes.text(4), .entity = changes.text(5)});
    if (!changes.is_null(6)) history.back().undoes = changes.integer(6);
  }
  return history;
}

std::string Library::undo(bool of_anybody) {
  const input::Location where{"library", 0, 0};
  std::string said;
  change([&](Stroke&) {
    sql::Statement last = rooms_->connection.prepare("SELECT c.stroke, c.who, c.action FROM change c WHERE c.undoes IS NULL AND NOT EXISTS (SELECT 1 FROM change u WHERE u.undoes = c.stroke) "
                                                     "AND NOT EXISTS (SELECT 1 FROM change s WHERE s.stroke = c.stroke AND s.action = 'shipped') ORDER BY c.number DESC LIMIT 1");
    if (!last.step()) throw input::InputError(where, "there is nothing to undo", "snug materials history tells what was done");
    const std::int64_t stroke = last.integer(0);
    const std::string who = last.text(1);
    last.reset();
    if (who != rooms_->settings.who && !of_anybody) throw input::InputError(where, "the last change is by " + who, "ask " + who + ", or say --of-anybody");
    sql::Statement changes = rooms_->connection.prepare("SELECT action, entity, before FROM change WHERE stroke = ?1 ORDER BY number DESC");
    changes.bind(1, stroke);
    std::vector<std::array<std::string, 3>> steps;
    while (changes.step()) steps.push_back({changes.text(0), changes.text(1), changes.text(2)});
    rooms_->undoes = stroke, rooms_->undoing = true;
    for (const auto& [action, id, before] : steps) {
      if (before.empty())
        rooms_->remove(entity(id), "undone: " + action);
      else
        rooms_->put(from_snapshot(before), "undone: " + action);
    }
    said = fmt::format("{} by {}: {} of {}", steps.size() == 1 ? "undone, a change" : "undone, " + std::to_string(steps.size()) + " changes", who, steps.front()[0], steps.front()[1]);
  });
  rooms_->undoes.reset(), rooms_->undoing = false;
  return said;
}

void Library::bring_shipped_up_to_date() {
  const auto edition = [&] {
    sql::Statement note = rooms_->connection.prepare("SELECT value FROM note WHERE name = 'shipped'");
    return note.step() ? note.text(0) : std::string();
  };
  if (edition() == rooms_->settings.edition) return;
  const Entries shipped = rooms_->settings.shipped(rooms_->units);
  change([&](Stroke& stroke) {
    if (edition() == rooms_->settings.edition) return;  // another process was faster
    rooms_->shipping = true;
    for (const std::string& id : ids()) {  // what does not ship any more is the user's
      auto entity = find(id);
      if (!entity->shipped || std::any_of(shipped.entities.begin(), shipped.entities.end(), [&](const Entity& one) { return one.id == id; })) continue;
      entity->shipped = false;
      for (Datum& datum : entity->data) datum.shipped = false;
      stroke.put(*std::move(entity), "ships no longer");
    }
    for (const LibraryFile& file : shipped.files) stroke.keep(file);
    for (Entity entity : shipped.entities) {
      entity.shipped = true;
      for (Datum& datum : entity.data) datum.shipped = true;
      const auto before = find(entity.id);
      if (before && !before->shipped) {
        std::string other = entity.id + " own";
        while (find(other)) other += " own";
        rooms_->rename(*before, other);
      } else if (before) {  // own items stay, behind
        for (const Datum& datum : before->data)
          if (!datum.shipped) entity.data.push_back(datum);
      }
      stroke.put(std::move(entity), "shipped");
    }
    rooms_->connection.prepare("INSERT INTO note (name, value) VALUES ('shipped', ?1) ON CONFLICT (name) DO UPDATE SET value = ?1").bind(1, rooms_->settings.edition).run();
  });
  rooms_->shipping = false;
}

std::vector<std::string> Library::differences(const Entries& shipped) const {
  std::vector<std::string> lines;
  for (Entity entity : shipped.entities) {
    gather(entity);
    for (Datum& datum : entity.data) datum.shipped = true;
    auto found = find(entity.id);
    if (found) std::erase_if(found->data, [](const Datum& datum) { return !datum.shipped; });
    if (!found || !found->shipped)
      lines.push_back(entity.id + ": in the text, not in the library");
    else if (!found->same_content(entity))
      lines.push_back(entity.id + ": the library has other values than the text");
  }
  sql::Statement held = rooms_->connection.prepare("SELECT id FROM entity WHERE shipped = 1 ORDER BY number");
  while (held.step()) {
    const std::string id = held.text(0);
    if (std::none_of(shipped.entities.begin(), shipped.entities.end(), [&](const Entity& one) { return one.id == id; })) lines.push_back(id + ": in the library, not in the text");
  }
  return lines;
}

void Library::check_file() const { sql::check_for_damage(rooms_->connection); }

}  // namespace snug::materials
