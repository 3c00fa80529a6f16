#include "materials/database/store.hpp"

#include <algorithm>

#include "cases/input/suggestion.hpp"
#include "materials/database/equation.hpp"
#include "materials/database/evaluation.hpp"
#include "materials/database/items.hpp"
#include "materials/database/schema.hpp"
#include "materials/database/snapshot.hpp"

namespace snug::materials {

namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t checked_at_opening = 16 << 20;  // bytes that are read through each time, in some 40 ms
constexpr std::int64_t most_bounded = 20'000;            // entities that an index is followed to

sql::Connection opened(const fs::path& file) {
  std::error_code ignored;
  if (file.has_parent_path())
    fs::create_directories(file.parent_path(), ignored);  // where this fails the opening says so
  sql::Connection connection(file, sql::Connection::Open::or_new);
  sql::bring_up_to_date(connection);
  std::error_code unknown;
  const auto size = fs::file_size(file, unknown);
  if (!unknown && size <= checked_at_opening) sql::check_for_damage(connection);
  return connection;
}

}  // namespace

void bind_places(const Condition& condition, sql::Statement& statement) {
  const int count = std::min(statement.places(), static_cast<int>(condition.places.size()));
  for (int place = 1; place <= count; ++place)
    std::visit([&](const auto& one) { statement.bind(place, one); },
               condition.places[static_cast<std::size_t>(place) - 1]);
}

void gather(Entity& entity) {
  std::map<std::string, std::size_t> first;
  for (std::size_t n = 0; n < entity.data.size(); ++n) first.emplace(entity.data[n].name, n);
  std::stable_sort(entity.data.begin(), entity.data.end(),
                   [&](const Datum& a, const Datum& b) { return first[a.name] < first[b.name]; });
}

Store::Store(const Library::Settings& asked)
    : settings(asked),
      connection(opened(asked.file)),
      entity_by_id(connection.prepare("SELECT e.number, e.kind, p.id, e.shipped FROM entity e LEFT JOIN entity p ON "
                                      "p.number = e.parent WHERE e.id = ?1")),
      data_of(connection.prepare("SELECT name, shipped, type, symbol, value, unit, uncertainty, low, high, source, "
                                 "si FROM datum WHERE entity = ?1 ORDER BY place")),
      number_of(connection.prepare("SELECT number, kind, shipped FROM entity WHERE id = ?1")),
      add_entity(connection.prepare("INSERT INTO entity (id, kind, parent, shipped) VALUES (?1, ?2, ?3, ?4)")),
      set_entity(connection.prepare("UPDATE entity SET parent = ?2, shipped = ?3 WHERE number = ?1")),
      remove_data(connection.prepare("DELETE FROM datum WHERE entity = ?1")),
      add_datum(connection.prepare("INSERT INTO datum (entity, place, name, first, shipped, type, symbol, value, "
                                   "unit, uncertainty, low, high, source, si) "
                                   "VALUES (?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9, ?10, ?11, ?12, ?13, ?14)")),
      item_by_name(connection.prepare("SELECT si_unit FROM item WHERE name = ?1")),
      set_item(connection.prepare("INSERT OR REPLACE INTO item (name, si_unit) VALUES (?1, ?2)")),
      add_change(connection.prepare(
          "INSERT INTO change (stroke, who, action, entity, before, undoes) VALUES (?1, ?2, ?3, ?4, ?5, ?6)")) {}

std::optional<std::string> Store::item(const std::string& name) {
  const auto known = items.find(name);
  if (known != items.end()) return known->second;
  item_by_name.bind(1, name);
  if (!item_by_name.step()) return std::nullopt;
  const std::string unit = item_by_name.is_null(0) ? "text" : item_by_name.text(0);
  item_by_name.reset();
  return items.emplace(name, unit).first->second;
}

bool Store::is_held_elsewhere(const std::string& item, const std::string& id) const {
  sql::Statement holder = connection.prepare(
      "SELECT 1 FROM datum d JOIN entity e ON e.number = d.entity WHERE d.name = ?1 AND d.first = 1 AND d.si IS NOT "
      "NULL AND e.id <> ?2 UNION ALL SELECT 1 FROM datum d JOIN entity e ON e.number = d.entity WHERE d.name = ?1 AND "
      "d.first = 1 AND d.si IS NULL AND e.id <> ?2 LIMIT 1");  // by the two indexes of items
  return holder.bind(1, item).bind(2, id).step();
}

void Store::keep_item(const std::string& name, const std::string& unit) {
  set_item.bind(1, name);
  if (unit == "text")
    set_item.bind_null(2).run();
  else
    set_item.bind(2, unit).run();
  items[name] = unit;
}

void Store::check_item(const Datum& datum, bool is_first, const Entity& entity, input::Diagnostics& diagnostics) {
  if (datum.type == DatumType::table || datum.type == DatumType::figure) return;
  const bool is_text = datum.type == DatumType::value && !datum.si && datum.unit.empty() &&
                       !datum.value.empty();  // nothing: a state variable
  const auto own = units.find(datum.unit);
  if (!own) return;  // reported before
  const Item* usual = usual_item(datum.name.substr(datum.name.rfind('.') + 1));
  const std::string mine = usual ? usual->unit : is_text ? "text" : own->name;
  auto expected = item(datum.name);
  const auto fits = [&] {
    if (is_text || *expected == "text") return is_text == (*expected == "text") || (usual && !is_text);
    return Dimension(own->name).same_as(Dimension(*expected));
  };
  if (!expected || (!usual && is_first && !fits() && !is_held_elsewhere(datum.name, entity.id)))
    keep_item(datum.name, mine), expected = mine;
  if (fits()) return;
  const std::string wanted = expected->empty() ? "a plain number" : *expected;
  if (is_text)
    diagnostics.error(
        entity.where, datum.name + ": \"" + datum.value + "\" is no number",
        "everywhere else it is " + (expected->empty() ? wanted : "one in " + wanted) + "; name a text otherwise");
  else if (*expected == "text")
    diagnostics.error(entity.where, datum.name + " is a number here and a text everywhere else", "name it otherwise");
  else
    diagnostics.error(entity.where,
                      datum.name + ": \"" + quantity_text(datum) + "\" " +
                          (datum.unit.empty() ? "has no unit" : "is of another dimension"),
                      "write it with a unit that converts to " + wanted);
}

std::optional<Entity> Store::find(const std::string& id) {
  entity_by_id.bind(1, id);
  if (!entity_by_id.step()) return std::nullopt;
  const auto kind = input::choice_of<Kind>(entity_by_id.text(1));
  Entity entity{.kind = kind.value_or(Kind::fabric),
                .id = id,
                .parent = entity_by_id.text(2),
                .shipped = entity_by_id.integer(3) != 0};
  data_of.bind(1, entity_by_id.integer(0));
  entity_by_id.reset();
  while (data_of.step()) {
    Datum datum{.name = data_of.text(0),
                .symbol = data_of.text(3),
                .type = input::choice_of<DatumType>(data_of.text(2)).value_or(DatumType::value),
                .value = data_of.text(4),
                .unit = data_of.text(5),
                .uncertainty = data_of.text(6),
                .low = data_of.text(7),
                .high = data_of.text(8),
                .source = data_of.text(9),
                .shipped = data_of.integer(1) != 0};
    if (!data_of.is_null(10)) datum.si = data_of.number(10);
    entity.data.push_back(std::move(datum));
  }
  return entity;
}

std::string Store::narrowest(const Condition& condition) const {
  std::int64_t fewest = most_bounded;
  std::string best;
  for (const std::string& bound : condition.bounds) {
    sql::Statement count =
        connection.prepare("SELECT count(*) FROM (" + bound + " LIMIT " + std::to_string(fewest) + ")");
    bind_places(condition, count);
    count.step();
    if (count.integer(0) < fewest) fewest = count.integer(0), best = bound;
  }
  return best;
}

void Store::write_data(std::int64_t number, const Entity& entity) {
  std::int64_t place = 0;
  for (const Datum& one : entity.data) {
    const bool first =
        place == 0 || entity.data[static_cast<std::size_t>(place) - 1].name != one.name;  // gathered before
    add_datum.bind(1, number)
        .bind(2, place++)
        .bind(3, one.name)
        .bind(4, first ? 1 : 0)
        .bind(5, one.shipped ? 1 : 0)
        .bind(6, input::text_of(one.type));
    add_datum.bind_text_or_null(7, one.symbol)
        .bind(8, one.value)
        .bind_text_or_null(9, one.unit)
        .bind_text_or_null(10, one.uncertainty);
    add_datum.bind_text_or_null(11, one.low)
        .bind_text_or_null(12, one.high)
        .bind_text_or_null(13, one.source)
        .bind(14, one.si)
        .run();
  }
}

void Store::note_change(const std::string& action, const std::string& id, const std::optional<Entity>& before) {
  add_change.bind(1, stroke).bind(2, settings.who).bind(3, action).bind(4, id);
  if (before)
    add_change.bind(5, snapshot(*before));
  else
    add_change.bind_null(5);
  add_change.bind(6, undoes).run();
}

std::optional<std::int64_t> Store::parent_of(const Entity& entity, input::Diagnostics& diagnostics) {
  if (entity.parent.empty()) return std::nullopt;
  number_of.bind(1, entity.parent);
  if (!number_of.step()) {
    diagnostics.error(entity.where, entity.id + ": there is no entity \"" + entity.parent + "\" to be its parent",
                      "add the parent first");
    return std::nullopt;
  }
  const std::int64_t number = number_of.integer(0);
  const auto kind = input::choice_of<Kind>(number_of.text(1));
  number_of.reset();
  const std::vector<Kind> fit = parents_of(entity.kind);
  std::vector<std::string> names;
  for (const Kind one : fit) names.push_back(input::text_of(one));
  if (!kind || std::find(fit.begin(), fit.end(), *kind) == fit.end())
    diagnostics.error(entity.where,
                      entity.id + ": the parent " + entity.parent + " is a " +
                          (kind ? input::text_of(*kind) : std::string("thing of an unknown kind")),
                      names.empty()
                          ? "a " + input::text_of(entity.kind) + " has none"
                          : "the parent of a " + input::text_of(entity.kind) + " is a " + input::joined(names));
  return number;
}

void Store::check_shipped(const Entity& before, const Entity& after, input::Diagnostics& diagnostics) const {
  if (shipping || undoing || !before.shipped) return;
  const std::string remedy = "what ships is not changed: copy it (snug materials copy " + before.id + " \"my " +
                             before.id + "\") and change the copy";
  if (before.kind != after.kind || before.parent != after.parent)
    return diagnostics.error(after.where, before.id + " ships with this parent and kind", remedy);
  std::vector<Datum> was, is;
  std::copy_if(before.data.begin(), before.data.end(), std::back_inserter(was),
               [](const Datum& one) { return one.shipped; });
  std::copy_if(after.data.begin(), after.data.end(), std::back_inserter(is),
               [](const Datum& one) { return one.shipped; });
  if (was != is) return diagnostics.error(after.where, before.id + " ships with these values", remedy);
  for (const Datum& one : after.data)
    if (!one.shipped && after.find(one.name) == &one &&
        (std::any_of(was.begin(), was.end(), [&](const Datum& other) { return other.name == one.name; }) ||
         (settings.is_law_key && settings.is_law_key(after.kind, one.name))))
      diagnostics.error(after.where, before.id + ": a run would read your " + one.name, remedy);
}

void Store::put(Entity entity, const std::string& action) {
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
  for (std::size_t n = 0; n < entity.data.size(); ++n)
    check_item(entity.data[n], n == 0 || entity.data[n - 1].name != entity.data[n].name, entity, diagnostics);
  if (has_equation) check_equations(entity, units, diagnostics);
  const auto parent = parent_of(entity, diagnostics);
  const auto before = find(entity.id);
  if (before && before->kind != entity.kind)
    diagnostics.error(entity.where, entity.id + " is the ID of a " + input::text_of(before->kind),
                      "take another one: IDs are those of the whole library");
  if (before) check_shipped(*before, entity, diagnostics);
  diagnostics.throw_if_any();
  if (before && before->same_content(entity) && before->shipped == entity.shipped) return;  // nothing changes
  write(entity, parent, before.has_value());
  note_change(action, entity.id, before);
}

void Store::write(const Entity& entity, const std::optional<std::int64_t>& parent, bool is_there) {
  if (!is_there) {
    add_entity.bind(1, entity.id)
        .bind(2, input::text_of(entity.kind))
        .bind(3, parent)
        .bind(4, entity.shipped ? 1 : 0)
        .run();
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

void Store::remove(const Entity& entity, const std::string& action) {
  const input::Location where{"library", 0, 0};
  if (entity.shipped && !shipping && !undoing)
    throw input::InputError(where, entity.id + " ships with snug", "what ships is not removed");
  sql::Statement children =
      connection.prepare("SELECT c.id FROM entity c JOIN entity e ON c.parent = e.number WHERE e.id = ?1 LIMIT 1");
  if (children.bind(1, entity.id).step())
    throw input::InputError(where, entity.id + " is the parent of " + children.text(0),
                            "remove that first, or give it another parent");
  connection.prepare("DELETE FROM entity WHERE id = ?1").bind(1, entity.id).run();
  note_change(action, entity.id, entity);
}

void Store::rename(const Entity& entity, const std::string& id) {
  connection.prepare("UPDATE entity SET id = ?2 WHERE id = ?1").bind(1, entity.id).bind(2, id).run();
  note_change("renamed to " + id + ", since snug ships one of this ID", entity.id, entity);
}

void Store::keep(const LibraryFile& file) {
  connection.prepare("INSERT OR IGNORE INTO file (hash, name, content) VALUES (?1, ?2, ?3)")
      .bind(1, file.hash)
      .bind(2, file.name)
      .bind_bytes(3, file.content)
      .run();
}

}  // namespace snug::materials
