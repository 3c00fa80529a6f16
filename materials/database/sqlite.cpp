#include "materials/database/sqlite.hpp"

#include <sqlite3.h>

#include <stdexcept>

#include "cases/input/diagnostics.hpp"

namespace snug::materials::sql {

namespace {

constexpr int patience = 10'000;         // milliseconds that another process may hold the file
constexpr int longest_value = 32 << 20;  // bytes of a text or a picture
constexpr const char* damaged = "the library is damaged";
constexpr const char* restore =
    "nothing was changed; put a backup in its place, or move it away and import what snug materials export wrote";

[[noreturn]] void fail(sqlite3* connection, const std::string& file, int result) {
  const std::string reason = connection ? sqlite3_errmsg(connection) : sqlite3_errstr(result);
  switch (result & 0xff) {
    case SQLITE_CORRUPT:
      throw input::InputError({file, 0, 0}, std::string(damaged) + " (" + reason + ")", restore);
    case SQLITE_ERROR:  // our statements are right: it is the tables that are not ours
    case SQLITE_CONSTRAINT:
    case SQLITE_MISMATCH:
    case SQLITE_SCHEMA:
      throw input::InputError({file, 0, 0}, "the tables of the library are not as snug made them (" + reason + ")",
                              restore);
    case SQLITE_NOTADB:
      throw input::InputError({file, 0, 0}, "this is no library of snug, or a damaged one (" + reason + ")", restore);
    case SQLITE_BUSY:
      throw input::InputError({file, 0, 0}, "another process has been writing to the library for ten seconds",
                              "wait for it and try again");
    case SQLITE_CANTOPEN:
    case SQLITE_READONLY:
    case SQLITE_PERM:
    case SQLITE_AUTH:
      throw input::InputError({file, 0, 0}, "the library cannot be opened for writing (" + reason + ")",
                              "see who may write to it and to its folder, or name another file in SNUG_LIBRARY");
    case SQLITE_TOOBIG:
      throw input::InputError({file, 0, 0}, "a text or file of more than 32 MB", "nothing was changed; leave it out");
    default:
      throw std::runtime_error(file + ": " + reason);
  }
}

void check(sqlite3* connection, const std::string& file, int result) {
  if (result != SQLITE_OK && result != SQLITE_DONE && result != SQLITE_ROW) fail(connection, file, result);
}

int open_flags(Connection::Open how) {
  return SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE |
         (how == Connection::Open::or_new ? SQLITE_OPEN_CREATE : 0);
}

/// A pipe or a folder is not handed to SQLite.
void refuse_what_is_no_file(const std::filesystem::path& file) {
  std::error_code fault;
  const auto status = std::filesystem::status(file, fault);
  if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
    throw input::InputError({file.string(), 0, 0},
                            std::filesystem::is_directory(status) ? "this is a directory, not a file"
                                                                  : "this is a pipe or a device, not a file",
                            "name the file of the library, e.g. SNUG_LIBRARY=" + (file / "library.db").string());
}

}  // namespace

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement::Statement(sqlite3* connection, const std::string& file, const std::string& text)
    : file_(file), connection_(connection) {
  sqlite3_stmt* statement = nullptr;
  check(sqlite3_prepare_v2(connection, text.data(), static_cast<int>(text.size()), &statement, nullptr));
  statement_.reset(statement);
}

void Statement::check(int result) const { sql::check(connection_, file_, result); }

Statement& Statement::bind(int place, std::string_view text) {
  check(sqlite3_bind_text64(statement_.get(), place, text.data() ? text.data() : "", text.size(), SQLITE_TRANSIENT,
                            SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind(int place, double number) {
  check(sqlite3_bind_double(statement_.get(), place, number));
  return *this;
}

Statement& Statement::bind(int place, std::int64_t number) {
  check(sqlite3_bind_int64(statement_.get(), place, number));
  return *this;
}

Statement& Statement::bind_null(int place) {
  check(sqlite3_bind_null(statement_.get(), place));
  return *this;
}

Statement& Statement::bind_bytes(int place, std::string_view bytes) {
  check(sqlite3_bind_blob64(statement_.get(), place, bytes.data() ? bytes.data() : "", bytes.size(), SQLITE_TRANSIENT));
  return *this;
}

int Statement::places() const { return sqlite3_bind_parameter_count(statement_.get()); }

bool Statement::step() {
  const int result = sqlite3_step(statement_.get());
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) check(result);
  reset();
  return false;
}

void Statement::run() {
  while (step()) {
  }
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

std::string Statement::text(int column) const {
  const void* bytes = sqlite3_column_blob(statement_.get(), column);  // as it stands, text or bytes
  return bytes ? std::string(static_cast<const char*>(bytes),
                             static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column)))
               : std::string();
}

double Statement::number(int column) const { return sqlite3_column_double(statement_.get(), column); }
std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(statement_.get(), column); }
bool Statement::is_null(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL; }

void Connection::Close::operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }

Connection::Connection(const std::filesystem::path& file, Open how) : file_(file.string()) {
  refuse_what_is_no_file(file);
  sqlite3* connection = nullptr;
  const int result = sqlite3_open_v2(file_.c_str(), &connection, open_flags(how), nullptr);
  connection_.reset(connection);
  check(connection, file_, result);
  sqlite3_busy_timeout(connection, patience);
  sqlite3_limit(connection, SQLITE_LIMIT_LENGTH, longest_value);
  sqlite3_limit(connection, SQLITE_LIMIT_ATTACHED, 0);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  execute("PRAGMA foreign_keys = ON; PRAGMA cell_size_check = ON; PRAGMA synchronous = FULL");
}

void Connection::execute(const std::string& text) {
  check(connection_.get(), file_, sqlite3_exec(connection_.get(), text.c_str(), nullptr, nullptr, nullptr));
}

std::int64_t Connection::integer(const std::string& text) const {
  Statement statement = prepare(text);
  return statement.step() ? statement.integer(0) : 0;
}

std::int64_t Connection::last_row() const { return sqlite3_last_insert_rowid(connection_.get()); }

void Connection::copy_to(const std::filesystem::path& target) const {
  const Connection source(file_, Open::existing);  // of its own, so that it sees what is committed and no more
  Connection copy(target, Open::or_new);
  std::unique_ptr<sqlite3_backup, decltype(&sqlite3_backup_finish)> backup(
      sqlite3_backup_init(copy.connection_.get(), "main", source.connection_.get(), "main"), &sqlite3_backup_finish);
  if (!backup) fail(copy.connection_.get(), copy.file_, sqlite3_errcode(copy.connection_.get()));
  const int result = sqlite3_backup_step(backup.get(), -1);
  backup.reset();
  check(copy.connection_.get(), copy.file_, result);
}

Transaction::Transaction(Connection& connection) : connection_(connection) { connection.execute("BEGIN IMMEDIATE"); }

Transaction::~Transaction() {
  if (!open_) return;
  try {
    connection_.execute("ROLLBACK");
  } catch (const std::exception&) {  // SQLite has rolled back by itself
  }
}

void Transaction::commit() {
  connection_.execute("COMMIT");
  open_ = false;
}

}  // namespace snug::materials::sql
