// Reads a described struct from a TOML table:
//
//   Diagnostics diagnostics;
//   auto law = read<NeoHooke>(entry.table, diagnostics, {.also_known = {"law", "source"}});
//   diagnostics.throw_if_any();
//
// Every error has its place and remedy: unknown keys with the nearest known one, missing keys, bare numbers, wrong
// dimensions, bounds, choices. Reading goes on after an error, so that all of them come together.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/choice.hpp"
#include "cases/input/diagnostics.hpp"
#include "cases/input/field.hpp"
#include "cases/input/table.hpp"

namespace snug::input {

struct MaterialEntry;

struct ReadRules {
  std::vector<std::string> also_known = {};  ///< keys of this table that somebody else reads
  std::filesystem::path directory = {};      ///< paths are relative to it and must exist; empty: left as they stand
  bool allow_outside = false;                ///< admit absolute paths and ../
};

/// Visitor over one `describe`: fills members from `table`. After the visit, `finish` refuses the unknown keys.
class Reader {
 public:
  Reader(const Table& table, Diagnostics& diagnostics, ReadRules rules);

  template <class Member>
  void operator()(const Field& field, Member& member) {
    if (const Value* value = take(field)) convert(field, *value, member);
  }
  void finish() const;

 private:
  const Value* take(const Field& field);
  void convert(const Field& field, const Value& value, double& member) const;
  void convert(const Field& field, const Value& value, int& member) const;
  void convert(const Field& field, const Value& value, bool& member) const;
  void convert(const Field& field, const Value& value, std::string& member) const;
  void convert(const Field& field, const Value& value, std::filesystem::path& member) const;
  void convert(const Field& field, const Value& value, MaterialEntry& member) const;
  const std::vector<Value>* array(const Field& field, const Value& value) const;
  const Table* sub_table(const Field& field, const Value& value) const;
  void wrong_length(const Field& field, const Value& value, std::size_t expected) const;
  ReadRules inner_rules() const;

  template <class T>
  void convert(const Field& field, const Value& value, std::optional<T>& member) const {
    convert(field, value, member.emplace());
  }
  template <class T>
  void convert(const Field& field, const Value& value, std::vector<T>& member) const {
    member.clear();
    if (field.one_or_more && value.table()) return convert(field, value, member.emplace_back());
    if (const auto* items = array(field, value))
      for (const Value& item : *items) convert(field, item, member.emplace_back());
  }
  template <class T, std::size_t N>
  void convert(const Field& field, const Value& value, std::array<T, N>& member) const {
    const auto* items = array(field, value);
    if (!items) return;
    if (items->size() != N) return wrong_length(field, value, N);
    for (std::size_t i = 0; i < N; ++i) convert(field, (*items)[i], member[i]);
  }
  template <Choice T>
  void convert(const Field& field, const Value& value, T& member) const {
    Field texts = field;
    texts.choices = choices_of<T>();
    std::string text = text_of(member);
    convert(texts, value, text);
    member = choice_of<T>(text).value_or(member);
  }
  template <class T>
  void convert(const Field& field, const Value& value, T& member) const;

  const Table& table_;
  Diagnostics& diagnostics_;
  ReadRules rules_;
  std::vector<std::string> known_;
};

/// Fills `target` (its present values are the defaults) from `table`; a member `Location where` gets the table's place.
template <class T>
void read_into(T& target, const Table& table, Diagnostics& diagnostics, const ReadRules& rules = {}) {
  if constexpr (requires { target.where = Location{}; }) target.where = table.where;
  Reader reader(table, diagnostics, rules);
  T::describe(target, reader);
  reader.finish();
}

/// A T with its defaults, filled from `table`.
template <class T>
T read(const Table& table, Diagnostics& diagnostics, const ReadRules& rules = {}) {
  T target{};
  read_into(target, table, diagnostics, rules);
  return target;
}

template <class T>
void Reader::convert(const Field& field, const Value& value, T& member) const {
  if (!field.text_key.empty() && value.text()) {
    Table table{.where = value.where, .entries = {}};
    table.set(field.text_key, value);
    return read_into(member, table, diagnostics_, inner_rules());
  }
  if (const Table* table = sub_table(field, value)) read_into(member, *table, diagnostics_, inner_rules());
}

/// The text `key` of a table; reports and returns an empty text when it is missing, no text, or none of `choices`
/// (when there are any).
std::string read_choice(const Table& table, const std::string& key, const std::vector<std::string>& choices,
                        Diagnostics& diagnostics);

/// A quantity as text ("20 gf/cm2") or, when `field.unit` is empty, a number; reports what is wrong.
std::optional<double> read_number(const Field& field, const Value& value, Diagnostics& diagnostics);

}  // namespace snug::input
