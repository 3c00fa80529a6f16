#include "cases/input/key_list.hpp"

#include "cases/input/job_spec.hpp"

#include <fmt/format.h>

#include <cmath>

#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

std::string bound_line(const Field& field) {
  std::string text;
  if (std::isfinite(field.bound.low))
    text += fmt::format("{} {} {}", field.bound.low_open ? "greater than" : "at least", field.bound.low, field.unit);
  if (std::isfinite(field.bound.high))
    text += fmt::format("{}{} {} {}", text.empty() ? "" : ", ", field.bound.high_open ? "less than" : "at most",
                        field.bound.high, field.unit);
  return text;
}

void line(std::string& text, const char* head, const std::string& content) {
  if (!content.empty()) text += fmt::format("  {:<9} {}\n", head, content);
}

}  // namespace

void KeyList::push(const Field& field, const std::string& key, const std::string& kind, std::string default_value) {
  rows_.push_back({key, kind, field, field.required ? "" : std::move(default_value)});
}

void KeyList::add(const Field& field, const std::string& key, double member, const std::string& list) {
  if (std::isnan(member)) return push(field, key, list + (field.unit.empty() ? "number" : "quantity"), "");  // stands for: not given
  if (field.unit.empty()) return push(field, key, list + "number", fmt::format("{}", member));
  push(field, key, list + "quantity", fmt::format("\"{} {}\"", member, field.unit));
}

void KeyList::add(const Field& field, const std::string& key, int member, const std::string& list) {
  push(field, key, list + "whole number", fmt::format("{}", member));
}

void KeyList::add(const Field& field, const std::string& key, bool member, const std::string& list) {
  push(field, key, list + "true or false", member ? "true" : "false");
}

void KeyList::add(const Field& field, const std::string& key, const std::string& member, const std::string& list) {
  push(field, key, list + (field.choices.empty() ? "text" : "choice"), member.empty() ? "" : "\"" + member + "\"");
}

void KeyList::add(const Field& field, const std::string& key, const std::filesystem::path&, const std::string& list) {
  push(field, key, list + "file of the case directory", "");
}

void KeyList::add(const Field& field, const std::string& key, const MaterialEntry&, const std::string& list) {
  push(field, key, list + "name or table", "");
}

std::vector<KeyRow> case_keys() {
  std::vector<KeyRow> rows = keys_of<Case>();
  for (KeyRow& row : keys_of<Jobs>()) rows.push_back(std::move(row));
  return rows;
}

std::string explanation(const KeyRow& row) {
  std::string text = row.key + "\n";
  line(text, "meaning", row.field.meaning);
  line(text, "kind", row.kind + (row.field.required ? ", required" : ""));
  if (!row.field.unit.empty())
    line(text, "unit",
         fmt::format("{} in SI; any unit of {}, e.g. \"{}\"", row.field.unit, dimension_name(row.field.unit),
                     example_quantity(row.field.unit)));
  line(text, "choices", joined(row.field.choices));
  line(text, "bound", bound_line(row.field));
  line(text, "default", row.default_value);
  return text;
}

}  // namespace snug::input
