// The engineering database: entities with their data, in one SQLite file that many processes read and write.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "materials/database/datum.hpp"
#include "materials/database/text_form.hpp"

namespace snug::materials {

/// One line of the history.
struct Change {
  std::int64_t number = 0, stroke = 0;  ///< strokes are undone as a whole
  std::string moment;                   ///< UTC
  std::string who, action, entity;
  std::optional<std::int64_t> undoes = {};  ///< a stroke
};

class Library;
struct Store;  // store.hpp: the file and its statements

/// Changes that are made together or not at all. What it reads is what it will change: nobody writes meanwhile.
class Stroke {
 public:
  /// Throws input::InputError when there is none, with the nearest.
  Entity entity(const std::string& id) const;
  /// Adds the entity, or replaces the one of that ID. Throws input::InputError where its parent is not there or of the
  /// wrong kind, where an item has another dimension than everywhere else, where a name is taken by another kind, and
  /// where something that ships would change.
  void put(Entity entity, const std::string& action);
  /// Throws input::InputError where it ships or others have it as their parent.
  void remove(const std::string& id);
  /// Keeps a file by its content.
  void keep(const LibraryFile& file);

 private:
  friend class Library;
  explicit Stroke(Library& library) : library_(library) {}
  Library& library_;
};

/// Every function throws what sql::Connection throws, and input::InputError as it says.
class Library {
 public:
  struct Settings {
    std::filesystem::path file;
    std::string who = "unknown";  ///< for the history
    std::function<Entries(UnitBook&)> shipped =
        {};                    ///< what the library begins with, read where `edition` is another than the file's
    std::string edition = {};  ///< of what ships
    std::function<bool(Kind, const std::string& item)> is_law_key =
        {};  ///< what a run would read of an entity: not to be added to one that ships
  };
  /// Makes the file, and its folder, where there is none.
  explicit Library(const Settings& settings);
  ~Library();
  Library(Library&&) noexcept;

  std::optional<Entity> find(const std::string& id) const;
  /// Throws input::InputError with the nearest ID when there is none.
  Entity entity(const std::string& id) const;
  /// IDs in order, of one kind or of all.
  std::vector<std::string> ids(std::optional<Kind> kind = std::nullopt) const;
  std::vector<std::string> children(const std::string& id) const;
  std::int64_t count() const;
  /// IDs, in order, of the entities that a question describes (query.hpp), of one kind or of all.
  std::vector<std::string> find_where(const std::string& question, std::optional<Kind> kind = std::nullopt) const;

  /// Name and content of a file; throws input::InputError when there is none of that hash.
  LibraryFile file(const std::string& hash) const;

  /// Makes changes by `make` in one stroke; when it throws, nothing has changed.
  void change(const std::function<void(Stroke&)>& make);
  /// The newest first; of one entity or of all.
  std::vector<Change> history(const std::string& id = {}, int most = 100) const;
  /// Takes the last stroke back that has not been taken back; one of somebody else only with `of_anybody`. Returns what
  /// it did.
  std::string undo(bool of_anybody = false);

  /// Whether what ships stands in the file as the text has it; one line for each entity that does not.
  std::vector<std::string> differences(const Entries& shipped) const;
  /// Reads the whole file for damage; throws input::InputError.
  void check_file() const;
  UnitBook& units() const;

 private:
  friend class Stroke;
  friend class Runs;
  void bring_shipped_up_to_date();
  std::unique_ptr<Store> store_;
};

}  // namespace snug::materials
