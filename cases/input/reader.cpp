#include "cases/input/reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/material_entry.hpp"
#include "cases/input/paths.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

std::string with_unit(double value, const std::string& unit) {
  return unit.empty() ? fmt::format("{}", value) : fmt::format("{} {}", value, unit);
}

/// "greater than 0 m", "from 0 to 0.5", ...
std::string bound_text(const Bound& bound, const std::string& unit) {
  const bool low = std::isfinite(bound.low), high = std::isfinite(bound.high);
  const std::string least = (bound.low_open ? "greater than " : "at least ") + with_unit(bound.low, unit);
  const std::string most = (bound.high_open ? "less than " : "at most ") + with_unit(bound.high, unit);
  return low && high ? least + " and " + most : low ? least : most;
}

bool inside(double value, const Bound& bound) {
  const bool above = bound.low_open ? value > bound.low : value >= bound.low;
  const bool below = bound.high_open ? value < bound.high : value <= bound.high;
  return above && below;
}

void check_bound(const Field& field, const Value& value, double number, Diagnostics& diagnostics) {
  if (inside(number, field.bound)) return;
  diagnostics.error(value.where, fmt::format("{} is {}", field.key, with_unit(number, field.unit)),
                    "it must be " + bound_text(field.bound, field.unit));
}

std::optional<double> plain_number(const Field& field, const Value& value, Diagnostics& diagnostics) {
  double storage = 0.0;
  if (const double* number = value.number(storage)) return *number;
  diagnostics.error(value.where, field.key + " is " + value.description(), "give a number without unit and quotes");
  return std::nullopt;
}

std::optional<double> quantity(const Field& field, const Value& value, Diagnostics& diagnostics) {
  const std::string want = fmt::format("give {} with its unit, e.g. \"{}\" (SI: {})", dimension_name(field.unit),
                                       example_quantity(field.unit), field.unit);
  double storage = 0.0;
  if (const double* number = value.number(storage); number && field.unit == "%") return *number;  // sheets print percentages without a sign
  if (const double* number = value.number(storage)) {
    diagnostics.error(value.where, fmt::format("{} is the bare number {}", field.key, *number),
                      fmt::format("a unit is due here: write \"{} {}\" if SI was meant, e.g. \"{}\"", *number,
                                  field.unit, example_quantity(field.unit)));
    return std::nullopt;
  }
  if (!value.text()) {
    diagnostics.error(value.where, field.key + " is " + value.description(), want);
    return std::nullopt;
  }
  const Quantity result = to_si(*value.text(), field.unit);
  if (result.ok()) return result.value;
  diagnostics.error(value.where, field.key + ": " + result.found, want);
  return std::nullopt;
}

}  // namespace

Reader::Reader(const Table& table, Diagnostics& diagnostics, ReadRules rules)
    : table_(table), diagnostics_(diagnostics), rules_(std::move(rules)) {}

const Value* Reader::take(const Field& field) {
  known_.push_back(field.key);
  const Value* value = table_.find(field.key);
  if (!value && field.required)
    diagnostics_.error(table_.where, "the key " + field.key + " is missing",
                       "add " + field.key + (field.meaning.empty() ? "" : ": " + field.meaning) +
                           (field.unit.empty() ? "" : ", e.g. \"" + example_quantity(field.unit) + "\""));
  return value;
}

void Reader::finish() const {
  std::vector<std::string> known = known_;
  for (const std::string& key : rules_.also_known) known.push_back(key);
  for (const Entry& entry : table_.entries)
    if (std::find(known.begin(), known.end(), entry.key) == known.end())
      diagnostics_.error(entry.where, "unknown key " + entry.key, did_you_mean(entry.key, known));
}

ReadRules Reader::inner_rules() const { return {.directory = rules_.directory, .allow_outside = rules_.allow_outside}; }

void Reader::convert(const Field& field, const Value& value, double& member) const {
  if (const auto number = read_number(field, value, diagnostics_)) member = *number;
}

void Reader::convert(const Field& field, const Value& value, int& member) const {
  const auto* integer = std::get_if<long long>(&value.data);
  if (!integer) return diagnostics_.error(value.where, field.key + " is " + value.description(), "give a whole number");
  check_bound(field, value, static_cast<double>(*integer), diagnostics_);
  member = static_cast<int>(std::clamp<long long>(*integer, -2147483647, 2147483647));
}

void Reader::convert(const Field& field, const Value& value, bool& member) const {
  if (const bool* flag = std::get_if<bool>(&value.data)) {
    member = *flag;
  } else {
    diagnostics_.error(value.where, field.key + " is " + value.description(), "write true or false");
  }
}

void Reader::convert(const Field& field, const Value& value, std::string& member) const {
  const std::string* text = value.text();
  if (!text) return diagnostics_.error(value.where, field.key + " is " + value.description(), "give a text in quotes");
  const auto& choices = field.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), *text) == choices.end())
    return diagnostics_.error(value.where, "\"" + *text + "\" is no " + field.key, did_you_mean(*text, choices));
  member = *text;
}

void Reader::convert(const Field& field, const Value& value, std::filesystem::path& member) const {
  const std::string* text = value.text();
  if (!text || text->empty())
    return diagnostics_.error(value.where, field.key + " is " + value.description(),
                              "give the name of a file in quotes");
  member =
      rules_.directory.empty() ? std::filesystem::path(*text) : resolve_path(*text, value.where, rules_, diagnostics_);
}

void Reader::convert(const Field& field, const Value& value, MaterialEntry& member) const {
  member = {};
  member.where = value.where;
  if (value.text() && !value.text()->empty()) {
    member.name = *value.text();
  } else if (const Table* table = value.table(); table && !table->entries.empty()) {
    member.table = *table;
  } else {
    diagnostics_.error(value.where, field.key + " is " + value.description(),
                       "give the name of an entry (snug materials list) or a table of values");
  }
}

const std::vector<Value>* Reader::array(const Field& field, const Value& value) const {
  if (!value.array())
    diagnostics_.error(value.where, field.key + " is " + value.description(), "give a list in [brackets]");
  return value.array();
}

const Table* Reader::sub_table(const Field& field, const Value& value) const {
  if (!value.table())
    diagnostics_.error(value.where, field.key + " is " + value.description(),
                       "give a table { key = value } or a section [" + field.key + "]");
  return value.table();
}

void Reader::wrong_length(const Field& field, const Value& value, std::size_t expected) const {
  diagnostics_.error(value.where, fmt::format("{} has {} entries", field.key, value.array()->size()),
                     fmt::format("give {} of them", expected));
}

std::string read_choice(const Table& table, const std::string& key, const std::vector<std::string>& choices,
                        Diagnostics& diagnostics) {
  struct Choice {
    Field field;
    std::string text;
    static void describe(Choice& self, Reader& reader) { reader(self.field, self.text); }
  } choice{.field = {.key = key, .required = true, .choices = choices}, .text = {}};
  if (!choices.empty()) choice.field.meaning = "one of " + joined(choices);
  read_into(choice, table, diagnostics, {.also_known = table.keys()});
  return choice.text;
}

std::optional<double> read_number(const Field& field, const Value& value, Diagnostics& diagnostics) {
  const auto number =
      field.unit.empty() ? plain_number(field, value, diagnostics) : quantity(field, value, diagnostics);
  if (number && !std::isfinite(*number)) {
    diagnostics.error(value.where, field.key + " is " + value.description(), "give a finite number");
    return std::nullopt;
  }
  if (number) check_bound(field, value, *number, diagnostics);
  return number;
}

}  // namespace snug::input
