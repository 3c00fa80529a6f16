#include "cases/input/table.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <toml.hpp>

#include "cases/input/files.hpp"

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
  const std::string head = "[error]";
  if (message.starts_with(head)) message.erase(0, head.size());
  message.erase(0, message.find_first_not_of(" \t"));
  const auto name = message.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz_:");
  if (name != std::string::npos && name > 1 && message[name - 1] == ':' && message[name] == ' ')  // the parser's function
    message.erase(0, message.find_first_not_of(" \t", name));
  const auto last = message.find_last_not_of(" \t.");
  return last == std::string::npos ? std::string("wrong syntax") : message.substr(0, last + 1);
}

constexpr std::uintmax_t longest_text = 1 << 18;  ///< bytes; the parser looks for the place of a key from the beginning
constexpr std::size_t longest_line = 20'000, deepest = 50, most_dots = 20;

/// What stands at a place of a TOML document: the rough states of its grammar.
class Outline {
 public:
  /// What is too much for the parser, which recurses at every bracket and every dot of a key; empty: nothing. Then `line` is
  /// where.
  std::string too_much(const std::string& text, int& line) {
    line = 1;
    for (std::size_t at = 0, begin = 0; at < text.size(); ++at) {
      if (text[at] == '\n') {
        ++line, begin = at + 1, dots_ = 0;
        if (state_ == comment || state_ == basic || state_ == literal) state_ = outside;  // a text that is not closed is the parser's to report
      } else if (at - begin > longest_line) {
        return "a line of more than " + std::to_string(longest_line) + " characters";
      } else {
        at += step(text, at);
      }
      if (depth_ > deepest) return "brackets nested more than " + std::to_string(deepest) + " deep";
      if (dots_ > most_dots) return "a key of more than " + std::to_string(most_dots) + " parts";
    }
    return {};
  }

 private:
  enum State { outside, comment, basic, literal, long_basic, long_literal };

  /// Characters beyond this one that belong to what stands here.
  std::size_t step(const std::string& text, std::size_t at) {
    const char c = text[at];
    if (state_ == outside) return step_outside(text, at);
    if (state_ == comment) return 0;
    const bool escapes = state_ == basic || state_ == long_basic;
    if (escapes && c == '\\' && at + 1 < text.size() && text[at + 1] != '\n') return 1;
    const char quote = escapes ? '"' : '\'';
    if (c != quote) return 0;
    const bool is_long = state_ == long_basic || state_ == long_literal;
    if (is_long && text.compare(at, 3, std::string(3, quote)) != 0) return 0;
    state_ = outside;
    return is_long ? 2 : 0;
  }

  std::size_t step_outside(const std::string& text, std::size_t at) {
    const char c = text[at];
    if (c == '#') state_ = comment;
    if (c == '"' || c == '\'') {
      const bool is_long = text.compare(at, 3, std::string(3, c)) == 0;
      state_ = c == '"' ? (is_long ? long_basic : basic) : (is_long ? long_literal : literal);
      return is_long ? 2 : 0;
    }
    if (c == '[' || c == '{') ++depth_;
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
    if (c == '=' || c == ',' || c == '[' || c == '{') dots_ = 0;
    dots_ += c == '.';
    return 0;
  }

  State state_ = outside;
  std::size_t depth_ = 0, dots_ = 0;
};

/// Parses `text` (of which origin.prefix characters were added) and reports wrong syntax.
Table parse(const std::string& text, Origin origin, Diagnostics& diagnostics) {
  origin.lines = split_lines(text);
  std::istringstream stream(text);
  const std::string remedy = "write it as TOML (https://toml.io): key = value, texts in quotes, sections in [brackets]";
  int line = 0;
  if (const std::string found = Outline().too_much(text, line); !found.empty()) {
    diagnostics.error(origin.place(line, 1), found, remedy);
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
  std::string text;
  try {
    text = read_file(path, {.shown_as = where.file,
                            .most = longest_text,
                            .missing = "write it, or start from a shipped case with snug new NAME --like CASE"});
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.errors()) diagnostics.error(one.where, one.found, one.remedy);
    return empty_table(where);
  }
  where.line = where.column = 1;
  return parse(text, {.base = where}, diagnostics);
}

Table parse_text(const std::string& text, const Location& base, Diagnostics& diagnostics) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos || text[first] != '{') return parse(text, {.base = base}, diagnostics);
  const std::string prefix = "_=";
  const Table outer = parse(prefix + text, {.base = base, .prefix = static_cast<int>(prefix.size())}, diagnostics);
  const Table* inner = outer.table("_");
  return inner ? *inner : empty_table(base);
}

Table table_of(const std::string& text, const Location& base) {
  Diagnostics diagnostics;
  Table table = parse_text(text, base, diagnostics);
  diagnostics.throw_if_any();
  return table;
}

}  // namespace snug::input
