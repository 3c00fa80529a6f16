#include "cases/input/toml_edit.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>
#include <vector>

#include "cases/input/table.hpp"

namespace snug::input {

namespace {

std::vector<std::string> steps_of(const std::string& path) {
  std::vector<std::string> steps;
  std::istringstream stream(path);
  for (std::string step; std::getline(stream, step, '.');) steps.push_back(step);
  return steps;
}

/// A list counts as its only table, or as the entry of that name or number; `used`: the step named it.
const Value* entry_of(const std::vector<Value>& items, const std::string& step, bool& used) {
  std::size_t index = items.size();
  const auto [rest, fault] = std::from_chars(step.data(), step.data() + step.size(), index);
  used = true;
  if (fault == std::errc{} && rest == step.data() + step.size()) return index < items.size() ? &items[index] : nullptr;
  for (const Value& item : items)
    if (const Value* name = item.table() ? item.table()->find("name") : nullptr; name && name->text() && *name->text() == step) return &item;
  used = false;
  return items.size() == 1 && items.front().table() ? &items.front() : nullptr;
}

/// As far as the path leads: the last value that is there, and the steps that are left.
struct Found {
  const Value* value = nullptr;  ///< null: the document itself
  std::vector<std::string> missing;
};

std::optional<Found> follow(const Table& root, const std::vector<std::string>& steps) {
  Found found;
  const Table* table = &root;
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (found.value)
      if (const auto* items = found.value->array()) {
        bool used = false;
        found.value = entry_of(*items, steps[n], used);
        if (!found.value) return std::nullopt;
        table = found.value->table();
        if (used) continue;
      }
    const Value* next = table ? table->find(steps[n]) : nullptr;
    if (!next) {
      found.missing.assign(steps.begin() + static_cast<std::ptrdiff_t>(n), steps.end());
      return found;
    }
    found.value = next, table = next->table();
  }
  return found;
}

std::optional<std::size_t> offset_of(const std::string& text, const Location& where) {
  std::size_t at = 0;
  for (int line = 1; line < where.line; ++line) {
    at = text.find('\n', at);
    if (at == text.npos) return std::nullopt;
    ++at;
  }
  at += static_cast<std::size_t>(std::max(1, where.column) - 1);
  return at < text.size() ? std::optional(at) : std::nullopt;
}

/// End of a literal that begins there: a text, a list or table with what is nested in it, or a word.
std::size_t end_of(const std::string& text, std::size_t at) {
  int depth = 0;
  for (bool word = true; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"' || c == '\'') {
      const bool plain = c == '\'';
      for (++at; at < text.size() && text[at] != c; ++at)
        if (!plain && text[at] == '\\') ++at;
      if (depth == 0) return std::min(at + 1, text.size());
      word = false;
    } else if (c == '#' && depth > 0) {
      at = std::min(text.find('\n', at), text.size());
    } else if (c == '[' || c == '{') {
      ++depth, word = false;
    } else if (c == ']' || c == '}') {
      if (depth == 0) return at;
      if (--depth == 0) return at + 1;
    } else if (depth == 0 && word && (c == ',' || c == '\n' || c == '#' || c == ' ')) {
      return at;
    }
  }
  return at;
}

std::string replaced(std::string text, std::size_t from, std::size_t to, const std::string& by) { return text.replace(from, to - from, by); }

/// Adds a key to a table that is there: an inline one after its brace, a section after its head.
std::optional<std::string> added(const std::string& text, const Value& table, const std::string& line, const std::string& text_key) {
  const auto at = offset_of(text, table.where);
  if (!at) return std::nullopt;
  if (table.text()) {
    const std::size_t end = end_of(text, *at);
    return replaced(text, *at, end, "{ " + text_key + " = " + text.substr(*at, end - *at) + ", " + line + " }");
  }
  if (text[*at] == '{') {
    const bool empty = text.find_first_not_of(" \n", *at + 1) == text.find('}', *at);
    return replaced(text, *at + 1, *at + 1, " " + line + (empty ? " " : ","));
  }
  const std::size_t end = std::min(text.find('\n', *at), text.size());
  return replaced(text, end, end, "\n" + line);
}

bool reads_back(const std::string& text, const std::vector<std::string>& steps, const std::string& literal) {
  Diagnostics wrong;
  const Table now = parse_text(text, {"text", 1, 1}, wrong), wanted = parse_text("value = " + literal, {"text", 1, 1}, wrong);
  const auto found = wrong.any() ? std::nullopt : follow(now, steps);
  if (!found || !found->value || !found->missing.empty() || !wanted.find("value")) return false;
  Table one, other;
  one.set("value", *found->value), other.set("value", *wanted.find("value"));
  return to_toml(one) == to_toml(other);
}

}  // namespace

std::optional<std::string> with_value(const std::string& text, const std::string& path, const std::string& literal, const std::string& text_key) {
  const std::vector<std::string> steps = steps_of(path);
  Diagnostics wrong;
  const Table root = parse_text(text, {"text", 1, 1}, wrong);
  const auto found = wrong.any() || steps.empty() ? std::nullopt : follow(root, steps);
  if (!found) return std::nullopt;
  std::optional<std::string> result;
  if (found->missing.empty()) {
    const auto at = offset_of(text, found->value->where);
    if (at && !(found->value->table() && text[*at] != '{')) result = replaced(text, *at, end_of(text, *at), literal);
  } else if (found->value && found->missing.size() == 1) {
    result = added(text, *found->value, found->missing.front() + " = " + literal, text_key);
  } else if (!found->value) {  // a section of its own, or a key before the first one
    const std::size_t dot = path.rfind('.');
    result = dot == path.npos ? literal.empty() ? text : path + " = " + literal + "\n" + text
                              : text + (text.ends_with('\n') ? "" : "\n") + "\n[" + path.substr(0, dot) + "]\n" + path.substr(dot + 1) + " = " + literal + "\n";
  }
  if (!result || !reads_back(*result, steps, literal)) return std::nullopt;
  return result;
}

}  // namespace snug::input
