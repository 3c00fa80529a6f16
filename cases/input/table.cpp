#include "cases/input/table.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <regex>
#include <sstream>
#include <toml.hpp>

namespace snug::input {

namespace {

/// Where the parser's places lie in the file that the user sees.
struct Origin {
  Location base;   ///< place of the first character of the text
  int prefix = 0;  ///< characters put before the text for the parser
  std::vector<std::string> lines = {};

  Location place(int line, int column) const {
    if (base.line == 0) return base;
    if (line == 1) column = std::max(1, column - prefix) + base.column - 1;
    return {base.file, base.line + line - 1, column};
  }
};

template <class At>
Location place_of(const At& at, const Origin& origin) {
  return origin.place(static_cast<int>(at.line()), static_cast<int>(at.column()));
}

/// The parser keeps no place for keys: the key stands last before its value on the value's line.
Location place_of_key(const std::string& key, const toml::value& value, const Origin& origin) {
  const int line = static_cast<int>(value.location().line()), column = static_cast<int>(value.location().column());
  if (line >= 1 && line <= static_cast<int>(origin.lines.size())) {
    const std::string before = origin.lines[line - 1].substr(0, column - 1);
    const auto at = before.rfind(key);
    if (at != std::string::npos) return origin.place(line, static_cast<int>(at) + 1);
  }
  return origin.place(line, column);
}

Table empty_table(const Location& where) {
  Table table;
  table.where = where;
  return table;
}

Value converted(const toml::value& value, const Origin& origin);

Table converted_table(const toml::value& value, const Origin& origin) {
  Table table = empty_table(place_of(value.location(), origin));
  for (const auto& [key, item] : value.as_table())
    table.entries.push_back({key, place_of_key(key, item, origin), converted(item, origin)});
  // The parser forgets the order of the keys; their places still have it.
  std::stable_sort(table.entries.begin(), table.entries.end(), [](const Entry& a, const Entry& b) {
    return std::pair(a.value.where.line, a.value.where.column) < std::pair(b.value.where.line, b.value.where.column);
  });
  return table;
}

Value converted(const toml::value& value, const Origin& origin) {
  Value result;
  result.where = place_of(value.location(), origin);
  switch (value.type()) {
    case toml::value_t::boolean:
      result.data = value.as_boolean();
      break;
    case toml::value_t::integer:
      result.data = static_cast<long long>(value.as_integer());
      break;
    case toml::value_t::floating:
      result.data = static_cast<double>(value.as_floating());
      break;
    case toml::value_t::string:
      result.data = std::string(value.as_string().str);
      break;
    case toml::value_t::table:
      result.data = converted_table(value, origin);
      break;
    case toml::value_t::array: {
      std::vector<Value> items;
      for (const auto& item : value.as_array()) items.push_back(converted(item, origin));
      result.data = std::move(items);
      break;
    }
    default:
      break;
  }
  return result;
}

std::vector<std::string> split_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

/// The parser's message without its drawing of the source line.
std::string short_message(const std::string& what) {
  std::string message = what.substr(0, what.find('\n'));
  message = std::regex_replace(message, std::regex(R"(^\[error\]\s*)"), "");
  message = std::regex_replace(message, std::regex(R"(^[A-Za-z_:]+:\s+)"), "");  // the name of the parser's function
  return std::regex_replace(message, std::regex(R"(\.?\s*$)"), "");
}

/// The parser recurses at every bracket and every dot of a key: a line that would overflow its stack is found before.
/// Returns the number of that line, or 0. Strings and comments are told apart roughly; the limit is far beyond any
/// case.
int line_of_deep_nesting(const std::string& text) {
  constexpr int deepest = 100;
  int line = 1, brackets = 0, dots = 0;
  char quote = 0;
  bool comment = false;
  for (const char c : text) {
    if (c == '\n') {
      ++line;
      dots = 0;
      comment = false;
    } else if (comment) {
      continue;
    } else if (quote) {
      if (c == quote) quote = 0;
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '#') {
      comment = true;
    } else {
      brackets += (c == '[' || c == '{') - (c == ']' || c == '}');
      dots += c == '.';
      if (brackets > deepest || dots > 10 * deepest) return line;
    }
  }
  return 0;
}

/// Parses `text` (of which origin.prefix characters were added) and reports wrong syntax.
Table parse(const std::string& text, Origin origin, Diagnostics& diagnostics) {
  origin.lines = split_lines(text);
  std::istringstream stream(text);
  const std::string remedy = "write it as TOML (https://toml.io): key = value, texts in quotes, sections in [brackets]";
  if (const int line = line_of_deep_nesting(text)) {
    diagnostics.error(origin.place(line, 1), "brackets or keys are nested too deeply", remedy);
    return empty_table(origin.base);
  }
  try {
    Table table = converted_table(toml::parse(stream, origin.base.file), origin);
    table.where = origin.base;
    return table;
  } catch (const toml::exception& error) {
    diagnostics.error(place_of(error.location(), origin), short_message(error.what()), remedy);
  } catch (const std::exception& error) {  // some syntax errors of the parser are plain standard exceptions
    diagnostics.error(origin.base, short_message(error.what()), remedy);
  }
  return empty_table(origin.base);
}

}  // namespace

const Value* Table::find(const std::string& key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

Value* Table::find(const std::string& key) {
  for (Entry& entry : entries)
    if (entry.key == key) return &entry.value;
  return nullptr;
}

const Table* Table::table(const std::string& key) const {
  const Value* value = find(key);
  return value ? value->table() : nullptr;
}

Location Table::where_is(const std::string& key) const {
  for (const Entry& entry : entries)
    if (entry.key == key) return entry.where;
  return where;
}

std::vector<std::string> Table::keys() const {
  std::vector<std::string> names;
  for (const Entry& entry : entries) names.push_back(entry.key);
  return names;
}

void Table::set(const std::string& key, Value value) {
  for (Entry& entry : entries)
    if (entry.key == key) {
      entry.where = value.where;
      entry.value = std::move(value);
      return;
    }
  Location place = value.where;
  entries.push_back({key, std::move(place), std::move(value)});
}

void Table::remove(const std::string& key) {
  std::erase_if(entries, [&](const Entry& entry) { return entry.key == key; });
}

const double* Value::number(double& storage) const {
  if (const auto* integer = std::get_if<long long>(&data)) {
    storage = static_cast<double>(*integer);
    return &storage;
  }
  return std::get_if<double>(&data);
}

Table parse_file(const std::filesystem::path& path, Diagnostics& diagnostics, const std::string& shown_as) {
  Location where{.file = shown_as.empty() ? path.string() : shown_as};
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path)) {
    diagnostics.error(where, "there is no such file",
                      "write it, or start from a shipped case with snug new NAME --like CASE");
    return empty_table(where);
  }
  std::ostringstream text;
  text << file.rdbuf();
  where.line = where.column = 1;
  return parse(text.str(), {.base = where}, diagnostics);
}

Table parse_text(const std::string& text, const Location& base, Diagnostics& diagnostics) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '{') return parse(text, {.base = base}, diagnostics);
  const std::string prefix = "_=";
  const Table outer = parse(prefix + text, {.base = base, .prefix = static_cast<int>(prefix.size())}, diagnostics);
  const Table* inner = outer.table("_");
  return inner ? *inner : empty_table(base);
}

}  // namespace snug::input
