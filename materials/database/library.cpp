#include "materials/database/library.hpp"

#include <fmt/format.h>

#include <array>

#include "cases/input/suggestion.hpp"
#include "materials/database/schema.hpp"
#include "materials/database/snapshot.hpp"
#include "materials/database/store.hpp"

namespace snug::materials {

namespace {

constexpr std::size_t most_named = 40;  // names that a message lists

input::InputError unknown(const std::string& id, std::vector<std::string> known) {
  const std::string near = input::nearest(id, known);
  if (known.size() > most_named) known.resize(most_named), known.push_back("...");
  return {{"library", 0, 0},
          "no entity is called \"" + id + "\"",
          (near.empty() ? "" : "did you mean " + near + "? ") + ("known: " + input::joined(known))};
}

}  // namespace

Entity Stroke::entity(const std::string& id) const { return library_.entity(id); }
void Stroke::put(Entity entity, const std::string& action) { library_.store_->put(std::move(entity), action); }
void Stroke::remove(const std::string& id) { library_.store_->remove(library_.entity(id), "removed"); }

void Stroke::keep(const LibraryFile& file) { library_.store_->keep(file); }

Library::Library(const Settings& settings) : store_(std::make_unique<Store>(settings)) {
  if (settings.shipped) bring_shipped_up_to_date();
}
Library::~Library() = default;
Library::Library(Library&&) noexcept = default;

UnitBook& Library::units() const { return store_->units; }

std::optional<Entity> Library::find(const std::string& id) const { return store_->find(id); }

Entity Library::entity(const std::string& id) const {
  if (auto found = find(id)) return *std::move(found);
  throw unknown(id, ids());
}

std::vector<std::string> Library::ids(std::optional<Kind> kind) const {
  sql::Statement all = store_->connection.prepare(kind ? "SELECT id FROM entity WHERE kind = ?1 ORDER BY number"
                                                       : "SELECT id FROM entity ORDER BY number");
  if (kind) all.bind(1, input::text_of(*kind));
  std::vector<std::string> ids;
  while (all.step()) ids.push_back(all.text(0));
  return ids;
}

std::vector<std::string> Library::children(const std::string& id) const {
  sql::Statement below = store_->connection.prepare(
      "SELECT c.id FROM entity c JOIN entity e ON c.parent = e.number WHERE e.id = ?1 ORDER BY c.number");
  below.bind(1, id);
  std::vector<std::string> ids;
  while (below.step()) ids.push_back(below.text(0));
  return ids;
}

std::int64_t Library::count() const { return store_->connection.integer("SELECT count(*) FROM entity"); }

std::vector<std::string> Library::find_where(const std::string& question, std::optional<Kind> kind) const {
  std::vector<std::string> known;
  store_->items.clear();  // others may have changed them
  sql::Statement items = store_->connection.prepare("SELECT name FROM item ORDER BY name LIMIT 2000");
  while (items.step()) known.push_back(items.text(0));
  const Condition condition = parse_question(
      question, store_->units, [&](const std::string& name) { return store_->item(name); }, known);
  const std::string of_kind = kind ? " AND e.kind = ?" + std::to_string(condition.places.size() + 1) : "";
  const std::string bound = store_->narrowest(condition);
  sql::Statement found = store_->connection.prepare("SELECT e.id FROM entity e WHERE " +
                                                    (bound.empty() ? "" : "e.number IN (" + bound + ") AND ") + "(" +
                                                    condition.sql + ")" + of_kind + " ORDER BY e.number");
  bind_places(condition, found);
  if (kind) found.bind(static_cast<int>(condition.places.size()) + 1, input::text_of(*kind));
  std::vector<std::string> ids;
  while (found.step()) ids.push_back(found.text(0));
  return ids;
}

LibraryFile Library::file(const std::string& hash) const {
  sql::Statement one = store_->connection.prepare("SELECT name, content FROM file WHERE hash = ?1");
  one.bind(1, hash);
  if (!one.step())
    throw input::InputError({"library", 0, 0}, "no file of the hash " + hash,
                            "import the text that refers to it together with the file");
  return {.hash = hash, .name = one.text(0), .content = one.text(1)};
}

void Library::change(const std::function<void(Stroke&)>& make) {
  sql::Transaction writing(store_->connection);
  store_->items.clear();  // others may have changed them
  store_->stroke = store_->connection.integer("SELECT coalesce(max(stroke), 0) + 1 FROM change");
  Stroke stroke(*this);
  try {
    make(stroke);
    writing.commit();
  } catch (...) {
    store_->items.clear();  // some of them may have been of this stroke
    store_->undoes.reset(), store_->undoing = store_->shipping = false;
    throw;
  }
}

std::vector<Change> Library::history(const std::string& id, int most) const {
  sql::Statement changes = store_->connection.prepare(
      std::string("SELECT number, stroke, moment, who, action, entity, undoes FROM change ") +
      (id.empty() ? "" : "WHERE entity = ?2 ") + "ORDER BY number DESC LIMIT ?1");
  changes.bind(1, most);
  if (!id.empty()) changes.bind(2, id);
  std::vector<Change> history;
  while (changes.step()) {
    history.push_back({.number = changes.integer(0),
                       .stroke = changes.integer(1),
                       .moment = changes.text(2),
                       .who = changes.text(3),
                       .action = changes.text(4),
                       .entity = changes.text(5)});
    if (!changes.is_null(6)) history.back().undoes = changes.integer(6);
  }
  return history;
}

std::string Library::undo(bool of_anybody) {
  const input::Location where{"library", 0, 0};
  std::string said;
  change([&](Stroke&) {
    sql::Statement last = store_->connection.prepare(
        "SELECT c.stroke, c.who, c.action FROM change c WHERE c.undoes IS NULL AND NOT EXISTS (SELECT 1 FROM change u "
        "WHERE u.undoes = c.stroke) "
        "AND NOT EXISTS (SELECT 1 FROM change s WHERE s.stroke = c.stroke AND s.action = 'shipped') ORDER BY c.number "
        "DESC LIMIT 1");
    if (!last.step())
      throw input::InputError(where, "there is nothing to undo", "snug materials history tells what was done");
    const std::int64_t stroke = last.integer(0);
    const std::string who = last.text(1);
    last.reset();
    if (who != store_->settings.who && !of_anybody)
      throw input::InputError(where, "the last change is by " + who, "ask " + who + ", or say --of-anybody");
    sql::Statement changes =
        store_->connection.prepare("SELECT action, entity, before FROM change WHERE stroke = ?1 ORDER BY number DESC");
    changes.bind(1, stroke);
    std::vector<std::array<std::string, 3>> steps;
    while (changes.step()) steps.push_back({changes.text(0), changes.text(1), changes.text(2)});
    store_->undoes = stroke, store_->undoing = true;
    for (const auto& [action, id, before] : steps) {
      if (before.empty())
        store_->remove(entity(id), "undone: " + action);
      else
        store_->put(from_snapshot(before), "undone: " + action);
    }
    said = fmt::format("{} by {}: {} of {}",
                       steps.size() == 1 ? "undone, a change" : "undone, " + std::to_string(steps.size()) + " changes",
                       who, steps.front()[0], steps.front()[1]);
  });
  store_->undoes.reset(), store_->undoing = false;
  return said;
}

void Library::check_file() const { sql::check_for_damage(store_->connection); }

}  // namespace snug::materials
