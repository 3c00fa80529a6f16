#include "materials/database/datum.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cases/input/text.hpp"

namespace snug::materials {

namespace {

constexpr std::size_t longest_name = 100, longest_text = 100'000, longest_unit = 200;

bool is_name_character(unsigned char c) {
  return std::isalnum(c) || c >= 0x80 || std::string(" -_.+/()'").find(static_cast<char>(c)) != std::string::npos;
}

/// Bytes of the character of UTF-8 that begins at `at`, or 0 where none does.
std::size_t length_of_character(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0; };
  const unsigned char first = byte(at);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xf0 && first < 0xf5 ? 4 : first >= 0xe0 ? 3 : first >= 0xc2 ? 2 : 0;
  if (first >= 0xf5 || length == 0) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(at + i) & 0xc0) != 0x80) return 0;
  const unsigned char second = byte(at + 1);
  if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
      (first == 0xf4 && second > 0x8f))
    return 0;
  return length;
}

/// What is wrong with a text, or nothing.
std::string fault_of_text(const std::string& text, std::size_t longest) {
  if (text.size() > longest)
    return "has " + std::to_string(text.size()) + " characters, at most " + std::to_string(longest) + " are kept";
  for (std::size_t at = 0; at < text.size();) {
    const auto c = static_cast<unsigned char>(text[at]);
    if ((c < ' ' && c != '\n' && c != '\t') || c == 0x7f) return "holds a control character";
    const std::size_t length = length_of_character(text, at);
    if (length == 0) return "is no UTF-8";
    at += length;
  }
  return {};
}

void check_text(const std::string& what, const std::string& text, std::size_t longest, const input::Location& where,
                input::Diagnostics& diagnostics) {
  if (const std::string fault = fault_of_text(text, longest); !fault.empty())
    diagnostics.error(where, what + " " + fault,
                      "write plain text, and put what is long into a file (table or figure)");
}

void check_name(const std::string& what, const std::string& name, const input::Location& where,
                input::Diagnostics& diagnostics) {
  const bool good =
      !name.empty() && name.size() <= longest_name && name.front() != ' ' && name.back() != ' ' &&
      fault_of_text(name, longest_name).empty() &&
      std::all_of(name.begin(), name.end(), [](char c) { return is_name_character(static_cast<unsigned char>(c)); });
  if (!good)
    diagnostics.error(
        where, what + " \"" + name + "\" cannot be a name",
        "take letters, digits, blanks inside and - _ . + / ( ) ', at most " + std::to_string(longest_name) + " bytes");
}

/// Takes the digits of a number from the beginning of a text, and the blanks before and behind.
std::string take_number(std::string& text) {
  text.erase(0, text.find_first_not_of(' '));
  double number = 0.0;
  const char *begin = text.data(), *end = begin + text.size(), *digits = begin + (begin != end && *begin == '+');
  const auto [rest, fault] = std::from_chars(digits, end, number);
  if (fault != std::errc{} || !std::isfinite(number)) return {};
  std::string result(begin, rest);
  text = input::trimmed_copy({rest, end});
  return result;
}

bool take(std::string& text, const std::string& word) {
  if (!text.starts_with(word)) return false;
  text.erase(0, word.size());
  return true;
}

/// A number of a datum (its value, a limit of its range) in SI; reports what is none.
std::optional<double> in_si(const std::string& digits, const SiUnit& unit, const std::string& what,
                            const input::Location& where, input::Diagnostics& diagnostics) {
  const auto number = plain_number(digits);
  if (number && std::isfinite(*number * unit.factor)) return *number * unit.factor;
  diagnostics.error(where, what + " \"" + digits + "\" is no finite number",
                    "write digits with a decimal point, e.g. 0.57");
  return std::nullopt;
}

void check_limits(const Datum& datum, const SiUnit& unit, const input::Location& where,
                  input::Diagnostics& diagnostics) {
  if (!datum.uncertainty.empty()) {
    const auto deviation = in_si(datum.uncertainty, unit, datum.name + ": the uncertainty", where, diagnostics);
    if (deviation && *deviation < 0.0)
      diagnostics.error(where, datum.name + ": an uncertainty below zero", "give the standard deviation");
  }
  if (datum.low.empty() != datum.high.empty())
    return diagnostics.error(where, datum.name + ": half a range", "give both limits, range = [\"1 mm\", \"2 mm\"]");
  if (datum.low.empty()) return;
  const auto low = in_si(datum.low, unit, datum.name + ": the range", where, diagnostics),
             high = in_si(datum.high, unit, datum.name + ": the range", where, diagnostics);
  if (low && high && *low > *high)
    diagnostics.error(where, datum.name + ": a range from " + datum.low + " to " + datum.high,
                      "write the smaller limit first");
}

/// "nan", "-inf", "nan g/m2": meant as a number and none.
bool is_no_finite_number(const std::string& text, UnitBook& units) {
  double number = 0.0;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [rest, fault] = std::from_chars(begin + (begin != end && *begin == '+'), end, number);
  if (fault == std::errc::result_out_of_range) return true;
  return fault == std::errc{} && !std::isfinite(number) && units.find(input::trimmed_copy({rest, end})).has_value();
}

/// A value with neither unit, uncertainty nor range may be a text.
bool is_number(const Datum& datum) {
  return plain_number(datum.value) || !datum.unit.empty() || !datum.uncertainty.empty() || !datum.low.empty() ||
         !datum.high.empty();
}

}  // namespace

std::vector<Kind> parents_of(Kind kind) {
  switch (kind) {
    case Kind::fibre:
      return {Kind::yarn, Kind::fabric};
    case Kind::yarn:
      return {Kind::fabric};
    case Kind::fabric:
      return {Kind::garment};
    case Kind::tissue:
      return {Kind::body};
    case Kind::garment:
    case Kind::body:
      return {Kind::project};
    default:
      return {};
  }
}

const Datum* Entity::find(const std::string& name) const {
  const auto found = std::find_if(data.begin(), data.end(), [&](const Datum& datum) { return datum.name == name; });
  return found == data.end() ? nullptr : &*found;
}

bool Entity::same_content(const Entity& other) const {
  return kind == other.kind && id == other.id && parent == other.parent && data == other.data;
}

bool same_values(const Entity& a, const Entity& b) {
  const auto sorted = [](std::vector<Datum> data) {
    for (Datum& datum : data) datum.shipped = false;
    std::stable_sort(data.begin(), data.end(), [](const Datum& x, const Datum& y) { return x.name < y.name; });
    return data;
  };
  return a.kind == b.kind && a.id == b.id && a.parent == b.parent && sorted(a.data) == sorted(b.data);
}

std::optional<double> plain_number(const std::string& text) {
  std::string rest = text;
  const std::string digits = take_number(rest);
  if (digits.empty() || digits.size() != text.size()) return std::nullopt;
  double number = 0.0;
  const char* begin = text.data() + (text[0] == '+');
  std::from_chars(begin, text.data() + text.size(), number);
  return number;
}

std::optional<Printed> printed_quantity(const std::string& text, UnitBook& units) {
  if (text.size() > longest_unit) return std::nullopt;
  std::string rest = text;
  Printed printed;
  printed.number = take_number(rest);
  if (printed.number.empty()) return std::nullopt;
  if (take(rest, "+-") || take(rest, "±")) {
    printed.uncertainty = take_number(rest);
    if (printed.uncertainty.empty()) return std::nullopt;
  }
  printed.unit = rest;
  if (!units.find(printed.unit)) return std::nullopt;
  return printed;
}

std::string quantity_text(const Datum& datum) {
  return datum.value + (datum.uncertainty.empty() ? "" : " +- " + datum.uncertainty) +
         (datum.unit.empty() ? "" : " " + datum.unit);
}

void check_id(const std::string& id, const input::Location& where, input::Diagnostics& diagnostics) {
  check_name("the ID", id, where, diagnostics);
}

void check_remark(const std::string& what, const std::string& text) {
  input::Diagnostics diagnostics;
  check_text(what, text, longest_text, {"library", 0, 0}, diagnostics);
  diagnostics.throw_if_any();
}

void check_datum(Datum& datum, UnitBook& units, const input::Location& where, input::Diagnostics& diagnostics) {
  check_name("the item", datum.name, where, diagnostics);
  if (!datum.symbol.empty()) check_text(datum.name + ": the symbol", datum.symbol, longest_name, where, diagnostics);
  check_text(datum.name, datum.value, longest_text, where, diagnostics);
  check_text(datum.name + ": the source", datum.source, longest_text, where, diagnostics);
  const auto unit = units.find(datum.unit);
  if (!unit)
    return diagnostics.error(
        where, datum.name + ": \"" + datum.unit + "\" is no unit",
        "write one such as g/m2 or gf/(cm degree); temperatures in K, without a zero of their own");
  if (datum.type == DatumType::value) {
    datum.si.reset();
    if (is_no_finite_number(datum.value, units))
      return diagnostics.error(where, datum.name + ": \"" + datum.value + "\" is no finite number",
                               "write digits with a decimal point, e.g. 0.57");
    if (!datum.value.empty() && is_number(datum))
      datum.si = in_si(datum.value, *unit, datum.name + ":", where, diagnostics);
    check_limits(datum, *unit, where, diagnostics);
  } else if (datum.value.empty()) {
    diagnostics.error(where, datum.name + ": an empty " + input::text_of(datum.type), "say what it is");
  }
}

}  // namespace snug::materials
