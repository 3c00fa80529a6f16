// SQLite as values: a connection, prepared statements, a transaction. The only texts that become SQL are those of our
// own sources; everything that a user wrote is bound to a place of a prepared statement.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

struct sqlite3;
struct sqlite3_stmt;

namespace snug::materials::sql {

/// A statement that was compiled once. Throws as Connection says.
class Statement {
 public:
  Statement(sqlite3* connection, const std::string& file, const std::string& text);

  Statement& bind(int place, std::string_view text);
  Statement& bind(int place, double number);
  Statement& bind(int place, std::int64_t number);
  Statement& bind(int place, int number) { return bind(place, static_cast<std::int64_t>(number)); }
  Statement& bind_null(int place);
  Statement& bind_bytes(int place, std::string_view bytes);
  template <class T>
  Statement& bind(int place, const std::optional<T>& value) {
    return value ? bind(place, *value) : bind_null(place);
  }
  /// An empty text as NULL.
  Statement& bind_text_or_null(int place, std::string_view text) {
    return text.empty() ? bind_null(place) : bind(place, text);
  }

  /// How many places it has to be bound.
  int places() const;
  /// The next row; false after the last one, and then the statement can be bound and stepped anew.
  bool step();
  /// Steps to the end.
  void run();
  /// Ready to be bound and stepped anew.
  void reset();

  std::string text(int column) const;  ///< empty for NULL
  double number(int column) const;
  std::int64_t integer(int column) const;
  bool is_null(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  void check(int result) const;
  std::string file_;
  sqlite3* connection_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// An open database file, for one thread. Throws input::InputError where the file is damaged, none of SQLite's, not to
/// be written to, or held by another process for longer than ten seconds; std::runtime_error where the disk is full or
/// fails.
class Connection {
 public:
  enum class Open { existing, or_new };
  Connection(const std::filesystem::path& file, Open how);

  Statement prepare(const std::string& text) const { return {connection_.get(), file_, text}; }
  /// One or more statements of our own.
  void execute(const std::string& text);
  /// The one number that a statement of our own gives.
  std::int64_t integer(const std::string& text) const;
  std::int64_t last_row() const;
  /// A copy of what is committed, beside or elsewhere; the target must not be there.
  void copy_to(const std::filesystem::path& target) const;
  const std::string& file() const { return file_; }

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  std::string file_;
  std::unique_ptr<sqlite3, Close> connection_;
};

/// Everything between its beginning and `commit`, or nothing. Others may read meanwhile, and write afterwards.
class Transaction {
 public:
  explicit Transaction(Connection& connection);
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Connection& connection_;
  bool open_ = true;
};

}  // namespace snug::materials::sql
