#include "materials/database/schema.hpp"

#include <array>
#include <chrono>
#include <filesystem>
#include <thread>

#include "cases/input/diagnostics.hpp"

namespace snug::materials::sql {

namespace {

constexpr int application = 0x736e7567;  // "snug", in the header of the file

// One entry a version, for good: what made version N of version N - 1.
// entity.shipped, datum.shipped: 1 = of the text that ships. datum.first: of the data of one name, the one that counts.
constexpr std::array steps = {
    R"sql(
CREATE TABLE note (name TEXT PRIMARY KEY, value TEXT NOT NULL) STRICT, WITHOUT ROWID;
CREATE TABLE item (name TEXT PRIMARY KEY, si_unit TEXT) STRICT, WITHOUT ROWID;
CREATE TABLE entity (
  number INTEGER PRIMARY KEY,
  id TEXT NOT NULL UNIQUE,
  kind TEXT NOT NULL,
  parent INTEGER REFERENCES entity(number),
  shipped INTEGER NOT NULL) STRICT;
CREATE INDEX entity_by_kind ON entity(kind, id);
CREATE INDEX entity_by_parent ON entity(parent) WHERE parent IS NOT NULL;
CREATE TABLE datum (
  entity INTEGER NOT NULL REFERENCES entity(number) ON DELETE CASCADE,
  place INTEGER NOT NULL,
  name TEXT NOT NULL,
  first INTEGER NOT NULL,
  shipped INTEGER NOT NULL,
  type TEXT NOT NULL,
  symbol TEXT, value TEXT NOT NULL, unit TEXT, uncertainty TEXT, low TEXT, high TEXT, source TEXT,
  si REAL,
  PRIMARY KEY (entity, place)) STRICT, WITHOUT ROWID;
CREATE INDEX datum_by_number ON datum(name, si) WHERE first = 1 AND si IS NOT NULL;
CREATE INDEX datum_by_text ON datum(name, value) WHERE first = 1 AND si IS NULL;
)sql",
    R"sql(
CREATE TABLE change (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  stroke INTEGER NOT NULL,
  moment TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  who TEXT NOT NULL, action TEXT NOT NULL, entity TEXT NOT NULL, before TEXT, undoes INTEGER) STRICT;
CREATE INDEX change_by_entity ON change(entity);
CREATE INDEX change_by_stroke ON change(stroke);
CREATE TABLE file (
  hash TEXT PRIMARY KEY,
  name TEXT NOT NULL,
  content BLOB NOT NULL) STRICT;
)sql",
    // Runs: what was computed of what. run.proof: hash of what lay at run.place when it was recorded. run_value.role: input, version, setting, result.
    R"sql(
CREATE TABLE run (
  number INTEGER PRIMARY KEY AUTOINCREMENT,
  project TEXT NOT NULL,
  title TEXT NOT NULL,
  moment TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now')),
  who TEXT NOT NULL,
  directory TEXT NOT NULL,
  place TEXT NOT NULL,
  proof TEXT NOT NULL,
  case_hash TEXT NOT NULL,
  echo TEXT NOT NULL REFERENCES file(hash),
  command TEXT NOT NULL,
  status TEXT NOT NULL,
  message TEXT,
  note TEXT,
  parent INTEGER REFERENCES run(number) ON DELETE SET NULL,
  seconds REAL NOT NULL) STRICT;
CREATE INDEX run_by_project ON run(project);
CREATE INDEX run_by_parent ON run(parent) WHERE parent IS NOT NULL;
CREATE TABLE run_value (
  run INTEGER NOT NULL REFERENCES run(number) ON DELETE CASCADE,
  role TEXT NOT NULL,
  place INTEGER NOT NULL,
  name TEXT NOT NULL,
  value TEXT NOT NULL,
  unit TEXT,
  number REAL,
  PRIMARY KEY (run, role, place)) STRICT, WITHOUT ROWID;
CREATE TABLE run_material (
  run INTEGER NOT NULL REFERENCES run(number) ON DELETE CASCADE,
  part TEXT NOT NULL,
  entity TEXT NOT NULL,
  snapshot TEXT NOT NULL REFERENCES file(hash),
  PRIMARY KEY (run, part)) STRICT, WITHOUT ROWID;
CREATE TABLE derived (
  directory TEXT PRIMARY KEY,
  run INTEGER NOT NULL REFERENCES run(number) ON DELETE CASCADE) STRICT, WITHOUT ROWID;
CREATE INDEX derived_by_run ON derived(run);
CREATE TABLE decision (
  project TEXT PRIMARY KEY,
  run INTEGER NOT NULL REFERENCES run(number) ON DELETE CASCADE,
  why TEXT NOT NULL,
  who TEXT NOT NULL,
  moment TEXT NOT NULL DEFAULT (strftime('%Y-%m-%dT%H:%M:%fZ', 'now'))) STRICT, WITHOUT ROWID;
CREATE INDEX decision_by_run ON decision(run);
)sql"};

int version_of(const Connection& connection) { return static_cast<int>(connection.integer("PRAGMA user_version")); }

/// Throws where the file is not ours; true where it is new.
bool is_new(const Connection& connection) {
  // The owner last: while another process makes the file, in one transaction, what is read before may be of before.
  const auto tables = connection.integer("SELECT count(*) FROM sqlite_schema");
  const int version = version_of(connection);
  const auto owner = connection.integer("PRAGMA application_id");
  if (owner == 0 && version == 0 && tables == 0) return true;
  if (owner != application)
    throw input::InputError({connection.file(), 0, 0}, "this is a database of another program",
                            "name another file in SNUG_LIBRARY");
  if (version > schema_version())
    throw input::InputError({connection.file(), 0, 0},
                            "the library was made by a later snug (schema " + std::to_string(version) +
                                ", this one knows up to " + std::to_string(schema_version()) + ")",
                            "take that snug, or another file in SNUG_LIBRARY");
  return false;
}

/// A copy beside the file, whole or not there.
void back_up(const Connection& connection, int version) {
  namespace fs = std::filesystem;
  const std::string stem = connection.file() + ".schema-" + std::to_string(version) + ".backup";
  fs::path target = stem;
  for (int n = 2; fs::exists(target); ++n) target = stem + "-" + std::to_string(n);
  const fs::path aside = target.string() + ".part";
  fs::remove(aside);
  connection.copy_to(aside);
  fs::rename(aside, target);
}

}  // namespace

namespace {

/// Readers then see what is committed while another writes. While several processes make the file at once SQLite
/// refuses instead of waiting.
void use_write_ahead_log(Connection& connection) {
  for (int attempt = 0;; ++attempt) {
    try {
      connection.execute("PRAGMA journal_mode = WAL");
      return;
    } catch (const input::InputError&) {
      if (attempt == 200) throw;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
}

}  // namespace

int schema_version() { return static_cast<int>(steps.size()); }

void check_for_damage(const Connection& connection) {
  Statement check = connection.prepare("PRAGMA quick_check(1)");
  const std::string found = check.step() ? check.text(0) : "no answer";
  if (found != "ok")
    throw input::InputError(
        {connection.file(), 0, 0}, "the library is damaged (" + found + ")",
        "nothing was changed; put a backup in its place, or move it away and import what snug materials export wrote");
}

void bring_up_to_date(Connection& connection, int upto) {
  if (!is_new(connection) && version_of(connection) >= upto) return;
  use_write_ahead_log(connection);
  Transaction writing(connection);
  const bool fresh = is_new(connection);
  const int found = version_of(connection);  // another process may have been faster
  if (found >= upto) return;
  if (!fresh) {
    check_for_damage(connection);
    back_up(connection, found);
  }
  for (int version = found; version < upto; ++version) connection.execute(steps[static_cast<std::size_t>(version)]);
  connection.execute("PRAGMA application_id = " + std::to_string(application) +
                     "; PRAGMA user_version = " + std::to_string(upto));
  writing.commit();
}

}  // namespace snug::materials::sql
