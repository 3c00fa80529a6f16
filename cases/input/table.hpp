// A TOML document as plain values, each with its place. Keeps the parser's own (heavy) header out of everybody's way.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::input {

struct Value;
struct Entry;

/// A TOML table; entries stand in the order of the file.
struct Table {
  Location where;
  std::vector<Entry> entries;

  /// The value of `key`, or nullptr.
  const Value* find(const std::string& key) const;
  Value* find(const std::string& key);
  /// The table `key`, or nullptr when it is absent or no table.
  const Table* table(const std::string& key) const;
  /// Place of the key itself; the table's place when the key is absent.
  Location where_is(const std::string& key) const;
  std::vector<std::string> keys() const;
  /// Adds or replaces.
  void set(const std::string& key, Value value);
  void remove(const std::string& key);
};

/// A TOML value. Dates are not used by any input and come as std::monostate.
struct Value {
  Location where;
  std::variant<std::monostate, bool, long long, double, std::string, std::vector<Value>, Table> data;

  const std::string* text() const { return std::get_if<std::string>(&data); }
  const Table* table() const { return std::get_if<Table>(&data); }
  Table* table() { return std::get_if<Table>(&data); }
  const std::vector<Value>* array() const { return std::get_if<std::vector<Value>>(&data); }
  /// Integers count as numbers.
  const double* number(double& storage) const;
  /// "the text \"abc\"", "the bare number 3", "a table", ... for messages.
  std::string description() const;
};

/// A value that stands in no file.
template <class Data>
Value value_without_place(Data data) {
  Value value;
  value.data = std::move(data);
  return value;
}

struct Entry {
  std::string key;
  Location where;  ///< of the key
  Value value;
};

/// Reads a TOML file. A missing file or wrong syntax is reported and gives an empty table. Locations name `shown_as`
/// (the path itself when empty).
Table parse_file(const std::filesystem::path& path, Diagnostics& diagnostics, const std::string& shown_as = {});

/// Reads TOML text, either "key = value" lines or one inline table "{ ... }", that stands at `base` in a file.
/// With base.line = 0 every location is `base` itself.
Table parse_text(const std::string& text, const Location& base, Diagnostics& diagnostics);

/// The same of text that is known to be right, for values that stand in no file. Throws InputError.
Table table_of(const std::string& text, const Location& base = {});

/// TOML text with [section] headers.
std::string to_toml(const Table& table);

}  // namespace snug::input
