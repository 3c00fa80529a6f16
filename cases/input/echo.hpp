// A described struct back to TOML, in SI and with its defaults filled in: read<T>(to_table(t)) gives t again.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/case.hpp"
#include "cases/input/choice.hpp"
#include "cases/input/field.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

/// Visitor over one `describe`: collects the members as TOML values.
/// Writes what a material is out as a table; what it does not know stays a name or the table as it stands.
using WriteOut = std::function<std::optional<Table>(const Field&, const MaterialEntry&)>;

class Echo {
 public:
  explicit Echo(std::filesystem::path directory, WriteOut write_out = {})
      : directory_(std::move(directory)), write_out_(std::move(write_out)) {}

  template <class Member>
  void operator()(const Field& field, const Member& member) {
    if (auto value = value_of(field, member)) table_.set(field.key, std::move(*value));
  }
  Table table() && { return std::move(table_); }

 private:
  // What has no value (left out, empty) does not appear.
  std::optional<Value> value_of(const Field& field, double member) const;
  std::optional<Value> value_of(const Field& field, int member) const;
  std::optional<Value> value_of(const Field& field, bool member) const;
  std::optional<Value> value_of(const Field& field, const std::string& member) const;
  std::optional<Value> value_of(const Field& field, const std::filesystem::path& member) const;
  std::optional<Value> value_of(const Field& field, const MaterialEntry& member) const;

  template <class T>
  std::optional<Value> value_of(const Field& field, const std::optional<T>& member) const {
    return member ? value_of(field, *member) : std::nullopt;
  }
  template <class Items>
  std::optional<Value> list_of(const Field& field, const Items& items) const {
    std::vector<Value> values;
    for (const auto& item : items)
      if (auto value = value_of(field, item)) values.push_back(std::move(*value));
    if (values.empty()) return std::nullopt;
    return value_without_place(std::move(values));
  }
  template <class T>
  std::optional<Value> value_of(const Field& field, const std::vector<T>& member) const {
    if (field.one_or_more && member.size() == 1) return value_of(field, member.front());
    return list_of(field, member);
  }
  template <class T, std::size_t N>
  std::optional<Value> value_of(const Field& field, const std::array<T, N>& member) const {
    return list_of(field, member);
  }
  template <Choice T>
  std::optional<Value> value_of(const Field& field, const T& member) const {
    return value_of(field, text_of(member));
  }
  template <class T>
  std::optional<Value> value_of(const Field&, const T& member) const {
    Echo inner(directory_, write_out_);
    T::describe(member, inner);
    return value_without_place(std::move(inner).table());
  }

  std::filesystem::path directory_;
  WriteOut write_out_;
  Table table_;
};

/// The values of `object`; paths inside `directory` are given relative to it.
template <class T>
Table to_table(const T& object, const std::filesystem::path& directory = {}, const WriteOut& write_out = {}) {
  Echo echo(directory, write_out);
  T::describe(object, echo);
  return std::move(echo).table();
}

/// Text of case.echo.toml.
std::string echo_text(const Case& description, const WriteOut& write_out = {});

}  // namespace snug::input
