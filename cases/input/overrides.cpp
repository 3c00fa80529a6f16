#include "cases/input/overrides.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "cases/input/suggestion.hpp"

namespace snug::input {

namespace {

/// "body.layers[1].cells", as messages and `snug explain` name keys, is body.layers.1.cells.
std::vector<std::string> split_path(std::string path) {
  std::replace(path.begin(), path.end(), '[', '.');
  std::erase(path, ']');
  std::vector<std::string> steps;
  std::istringstream stream(path);
  for (std::string step; std::getline(stream, step, '.');) steps.push_back(step);
  return steps;
}

Value override_value(const std::string& text, const Location& where) {
  Diagnostics no_toml;
  const Table parsed = parse_text("value = " + text, where, no_toml);
  if (const Value* value = parsed.find("value"); value && !no_toml.any()) return *value;
  return Value{where, text};
}

/// The names (or numbers) by which the entries of a list can be reached.
std::vector<std::string> entry_names(const std::vector<Value>& items) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const Table* table = items[i].table();
    const Value* name = table ? table->find("name") : nullptr;
    names.push_back(name && name->text() ? *name->text() : std::to_string(i));
  }
  return names;
}

Value* entry_of(std::vector<Value>& items, const std::string& step) {
  std::size_t index = items.size();
  const auto [rest, fault] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (fault == std::errc{} && rest == step.data() + step.size()) return index < items.size() ? &items[index] : nullptr;
  const std::vector<std::string> names = entry_names(items);
  for (std::size_t i = 0; i < items.size(); ++i)
    if (names[i] == step) return &items[i];
  return nullptr;
}

/// pattern = "leg.toml" stands for pattern = { file = "leg.toml" }, whose other keys may be set.
void spell_out_pattern(Value& pattern) {
  if (!pattern.text()) return;
  Table table{.where = pattern.where, .entries = {}};
  table.set("file", pattern);
  pattern.data = std::move(table);
}

/// The value one step below `from`; sections that are not there yet are made.
Value* descend(Value& from, const std::string& step, const Location& where, Diagnostics& diagnostics) {
  if (auto* items = std::get_if<std::vector<Value>>(&from.data)) {
    if (Value* entry = entry_of(*items, step)) return entry;
    if (items->size() == 1 && items->front().table()) return descend(items->front(), step, where, diagnostics);  // the only one needs no name
    diagnostics.error(where, "the list has no entry " + step, "there are: " + joined(entry_names(*items)));
    return nullptr;
  }
  Table* table = from.table();
  if (!table) {
    diagnostics.error(where, step + " is looked for inside " + from.description(), "name a section and its key");
    return nullptr;
  }
  if (!table->find(step)) {
    Table section;
    section.where = where;
    table->set(step, Value{where, std::move(section)});
  }
  return table->find(step);
}

void apply(Value& root, const std::string& text, Diagnostics& diagnostics) {
  const Location where{"--set " + text, 0, 0};
  const auto equals = text.find('=');
  const std::vector<std::string> steps = split_path(text.substr(0, equals));
  if (equals == std::string::npos || steps.empty())
    return diagnostics.error(where, "there is no key=value", "write for example --set garment.fabric=N85L15");
  Value* target = &root;
  for (std::size_t n = 0; n < steps.size() && target; ++n) {
    if (n > 0 && steps[n - 1] == "pattern") spell_out_pattern(*target);
    target = descend(*target, steps[n], where, diagnostics);
  }
  if (target) *target = override_value(text.substr(equals + 1), where);
}

}  // namespace

void apply_overrides(Table& root, const std::vector<std::string>& overrides, Diagnostics& diagnostics) {
  Value whole{root.where, std::move(root)};
  for (const std::string& text : overrides) apply(whole, text, diagnostics);
  root = std::move(*whole.table());
}

}  // namespace snug::input
