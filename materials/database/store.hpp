// The file of the library with its statements: what Library and Stroke are made of.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "materials/database/library.hpp"
#include "materials/database/query.hpp"
#include "materials/database/sqlite.hpp"

namespace snug::materials {

/// What the user wrote, at the places that a statement has of it.
void bind_places(const Condition& condition, sql::Statement& statement);
/// Data of one name stand together, where the first of them stood.
void gather(Entity& entity);

struct Store {
  /// Opens or makes the file.
  explicit Store(const Library::Settings& asked);

  Library::Settings settings;
  sql::Connection connection;
  sql::Statement entity_by_id, data_of, number_of, add_entity, set_entity, remove_data, add_datum, item_by_name,
      set_item, add_change;
  UnitBook units;
  std::map<std::string, std::string> items = {};  // by name: unit, or "text"; of this stroke or question
  std::int64_t stroke = 0;                        // that is being made
  std::optional<std::int64_t> undoes = {};
  bool shipping = false, undoing = false;  // what ships may change

  std::optional<std::string> item(const std::string& name);
  std::optional<Entity> find(const std::string& id);
  /// Of the bounds of a question the one with the fewest entities, when that is few enough to be worth while.
  std::string narrowest(const Condition& condition) const;
  void put(Entity entity, const std::string& action);
  void remove(const Entity& entity, const std::string& action);
  void rename(const Entity& entity, const std::string& id);
  /// A file by its content; one that is there stays.
  void keep(const LibraryFile& file);

 private:
  /// One item has one dimension everywhere: what the usual list says, else what it had at first and as long as somebody
  /// has it.
  void check_item(const Datum& datum, bool is_first, const Entity& entity, input::Diagnostics& diagnostics);
  bool is_held_elsewhere(const std::string& item, const std::string& id) const;
  void keep_item(const std::string& name, const std::string& unit);
  void write_data(std::int64_t number, const Entity& entity);
  void note_change(const std::string& action, const std::string& id, const std::optional<Entity>& before);
  /// Row of the parent, after a look at its kind.
  std::optional<std::int64_t> parent_of(const Entity& entity, input::Diagnostics& diagnostics);
  /// What ships is the text's: it stays as it is, and what a run reads of it is not added to.
  void check_shipped(const Entity& before, const Entity& after, input::Diagnostics& diagnostics) const;
  void write(const Entity& entity, const std::optional<std::int64_t>& parent, bool is_there);
};

}  // namespace snug::materials
