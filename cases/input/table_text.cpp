// Tables back to TOML text.
#include <fmt/format.h>

#include <algorithm>

#include "cases/input/table.hpp"

namespace snug::input {

namespace {

std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n') {
      result += "\\n";
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '-';
  });
  return bare ? key : quoted(key);
}

std::string real_text(double value) {
  const std::string text = fmt::format("{}", value);  // shortest text that reads back to the same number
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string inline_text(const Value& value);

struct InlineText {
  std::string operator()(std::monostate) const { return "\"\""; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(long long value) const { return std::to_string(value); }
  std::string operator()(double value) const { return real_text(value); }
  std::string operator()(const std::string& value) const { return quoted(value); }
  std::string operator()(const std::vector<Value>& items) const {
    std::string text;
    for (const Value& item : items) text += (text.empty() ? "" : ", ") + inline_text(item);
    return "[" + text + "]";
  }
  std::string operator()(const Table& table) const {
    std::string text;
    for (const Entry& entry : table.entries)
      text += (text.empty() ? " " : ", ") + key_text(entry.key) + " = " + inline_text(entry.value);
    return "{" + text + " }";
  }
};

std::string inline_text(const Value& value) { return std::visit(InlineText{}, value.data); }

bool is_section(const Value& value) {
  if (value.table()) return true;
  const auto* items = value.array();
  return items && !items->empty() &&
         std::all_of(items->begin(), items->end(), [](const Value& v) { return v.table(); });
}

void write_section(const Table& table, const std::string& prefix, std::string& text) {
  for (const Entry& entry : table.entries)
    if (!is_section(entry.value)) text += key_text(entry.key) + " = " + inline_text(entry.value) + "\n";
  for (const Entry& entry : table.entries) {
    const std::string name = prefix + key_text(entry.key);
    if (const Table* inner = entry.value.table()) {
      text += "\n[" + name + "]\n";
      write_section(*inner, name + ".", text);
    } else if (is_section(entry.value)) {
      for (const Value& item : *entry.value.array()) {
        text += "\n[[" + name + "]]\n";
        write_section(*item.table(), name + ".", text);
      }
    }
  }
}

}  // namespace

std::string Value::description() const {
  if (table()) return "a table";
  if (array()) return "a list";
  if (text()) return "the text " + inline_text(*this);
  if (std::holds_alternative<bool>(data)) return inline_text(*this);
  if (std::holds_alternative<std::monostate>(data)) return "a date";
  return "the bare number " + inline_text(*this);
}

std::string to_toml(const Table& table) {
  std::string text;
  write_section(table, "", text);
  return text;
}

}  // namespace snug::input
