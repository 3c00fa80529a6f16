// The list of every key of the input, generated from the same descriptions that read it.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "cases/input/choice.hpp"
#include "cases/input/case.hpp"
#include "cases/input/field.hpp"

namespace snug::input {

/// One input as a reader of the list sees it.
struct KeyRow {
  std::string key;   ///< with its sections: "body.layers[].thickness"
  std::string kind;  ///< "text", "quantity", "number", "whole number", "file", "material", "section", "list of ..."
  Field field;
  std::string default_value;  ///< as written in a case; empty when there is none
};

/// Visitor over one `describe`: collects the rows, sections included.
class KeyList {
 public:
  explicit KeyList(std::string prefix) : prefix_(std::move(prefix)) {}

  template <class Member>
  void operator()(const Field& field, const Member& member) {
    add(field, prefix_ + field.key, member, "");
  }
  std::vector<KeyRow> rows() && { return std::move(rows_); }

 private:
  void add(const Field& field, const std::string& key, double member, const std::string& list);
  void add(const Field& field, const std::string& key, int member, const std::string& list);
  void add(const Field& field, const std::string& key, bool member, const std::string& list);
  void add(const Field& field, const std::string& key, const std::string& member, const std::string& list);
  void add(const Field& field, const std::string& key, const std::filesystem::path& member, const std::string& list);
  void add(const Field& field, const std::string& key, const MaterialEntry& member, const std::string& list);
  void push(const Field& field, const std::string& key, const std::string& kind, std::string default_value);

  template <class T>
  void add(const Field& field, const std::string& key, const std::optional<T>&, const std::string& list) {
    const std::size_t own = rows_.size();
    add(field, key, T{}, list);
    rows_[own].default_value.clear();  // left out means left out, not T's own default
  }
  template <class T>
  void add(const Field& field, const std::string& key, const std::vector<T>&, const std::string&) {
    const std::size_t own = rows_.size();
    const bool brackets = std::is_class_v<T> && !std::is_same_v<T, std::string> && !field.one_or_more;
    add(field, key + (brackets ? "[]" : ""), T{}, field.one_or_more ? "one or more of " : "list of ");
    rows_[own].default_value.clear();
  }
  template <class T, std::size_t N>
  void add(const Field& field, const std::string& key, const std::array<T, N>&, const std::string&) {
    const std::size_t own = rows_.size();
    add(field, key, T{}, "list of " + std::to_string(N) + " ");
    rows_[own].default_value.clear();
  }
  template <Choice T>
  void add(const Field& field, const std::string& key, const T& member, const std::string& list) {
    Field texts = field;
    texts.choices = choices_of<T>();
    add(texts, key, text_of(member), list);
  }
  template <class T>
  void add(const Field& field, const std::string& key, const T& member, const std::string& list) {
    push(field, key, list + "section", "");
    KeyList inner(key + ".");
    T::describe(member, inner);
    for (KeyRow& row : std::move(inner).rows()) rows_.push_back(std::move(row));
  }

  std::string prefix_;
  std::vector<KeyRow> rows_;
};

/// Rows of one described type; `prefix` ("neo-Hooke.") stands before its keys.
template <class T>
std::vector<KeyRow> keys_of(const std::string& prefix = {}) {
  KeyList keys(prefix);
  const T defaults{};
  T::describe(defaults, keys);
  return std::move(keys).rows();
}

/// Everything that case.toml can hold.
std::vector<KeyRow> case_keys();

/// A few lines that explain one input.
std::string explanation(const KeyRow& row);

}  // namespace snug::input
