#include "cases/input/units.hpp"

#include <udunits2.h>

#include <array>
#include <charconv>
#include <memory>
#include <string>

namespace snug::input {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// The unit system of udunits, read once; it never changes afterwards.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);  // we report ourselves, with place and remedy
    return ut_read_xml(nullptr);
  }();
  return system;
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\v' || c == '\f' || c == '\r'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

/// One blank where there were several, none round a slash.
std::string with_single_blanks(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (is_blank(c)) {
      if (result.empty() || (result.back() != ' ' && result.back() != '/')) result += ' ';
      continue;
    }
    if (c == '/' && !result.empty() && result.back() == ' ') result.pop_back();
    result += c;
  }
  return result;
}

/// The words deg and dyn are degree and dyne.
std::string with_long_words(const std::string& text) {
  std::string result, word;
  for (const char c : text + ' ') {
    if (is_letter(c) || (c >= '0' && c <= '9')) {
      word += c;
      continue;
    }
    result += (word == "deg" ? "degree" : word == "dyn" ? "dyne" : word) + c;
    word.clear();
  }
  result.pop_back();
  return result;
}

constexpr std::size_t longest_unit = 200;  // characters

/// The user's spelling as udunits wants it: every product sign is a space, every minus and square a plain one.
std::string plain(std::string unit) {
  const std::array<std::pair<const char*, const char*>, 8> spellings = {
      {{"·", " "}, {"×", " "}, {"*", " "}, {"−", "-"}, {"²", "2"}, {"³", "3"}, {"°", "degree"}, {"µ", "u"}}};
  for (const auto& [from, to] : spellings)
    for (std::size_t at; (at = unit.find(from)) != std::string::npos;) unit.replace(at, std::string(from).size(), to);
  return with_long_words(with_single_blanks(unit));
}

Unit parse_unit(const std::string& text) { return Unit(ut_parse(unit_system(), plain(text).c_str(), UT_UTF8)); }

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

struct Dimension {
  const char *unit, *name, *example;
};

const std::array<Dimension, 13> dimensions = {{{"m", "a length", "0.57 mm"},
                                               {"m2", "an area", "25 cm2"},
                                               {"Pa", "a pressure", "20 gf/cm2"},
                                               {"N", "a force", "12 N"},
                                               {"N/m", "a force per length", "500 gf/cm"},
                                               {"rad", "an angle", "35 deg"},
                                               {"kg/m2", "a mass per area", "180 g/m2"},
                                               {"kg/m3", "a density", "1100 kg/m3"},
                                               {"J/m2", "an energy per area", "8.5 gf cm/cm2"},
                                               {"N/(m rad)", "a force per length and angle", "0.77 gf/(cm degree)"},
                                               {"N m", "a bending stiffness per width", "0.05 gf cm2/cm"},
                                               {"s", "a time", "2 s"},
                                               {"1/m", "a curvature", "2.5 1/cm"}}};

}  // namespace

bool unit_factor(const std::string& unit, const std::string& si_unit, double& factor) {
  const std::string name = trimmed(unit);
  if (name.size() > longest_unit) return false;
  if (name.empty() || std::string("0123456789.+-").find(name[0]) != std::string::npos) {
    if (name.substr(0, 2) != "1/") return false;
  }
  const Unit from = parse_unit(name), to = parse_unit(si_unit);
  if (!from || !to || !ut_are_convertible(from.get(), to.get())) return false;
  std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(from.get(), to.get()), &cv_free);
  if (!converter) return false;
  factor = cv_convert_double(converter.get(), 1.0);
  return true;
}

Quantity to_si(const std::string& text, const std::string& si_unit) {
  const std::string trimmed_text = trimmed(text);
  if (trimmed_text.size() > 200)
    return {0.0, "a text of " + std::to_string(text.size()) + " characters is no quantity"};
  const char* begin = trimmed_text.data();
  const char* end = begin + trimmed_text.size();
  if (begin != end && *begin == '+') ++begin;
  double number = 0.0;
  const auto [rest, fault] = std::from_chars(begin, end, number);
  if (fault != std::errc{}) return {0.0, "\"" + text + "\" does not begin with a number"};
  const std::string unit = trimmed({rest, end});
  if (unit.empty()) return {0.0, "\"" + text + "\" has no unit"};
  double factor = 1.0;
  if (unit_factor(unit, si_unit, factor)) return {number * factor, {}};
  if (!parse_unit(unit)) return {0.0, "\"" + unit + "\" in \"" + text + "\" is not a unit"};
  return {0.0, "\"" + text + "\" is not " + dimension_name(si_unit)};
}

std::string dimension_name(const std::string& si_unit) {
  for (const Dimension& dimension : dimensions)
    if (si_unit == dimension.unit) return dimension.name;
  return "a quantity in " + si_unit;
}

std::string example_quantity(const std::string& si_unit) {
  for (const Dimension& dimension : dimensions)
    if (si_unit == dimension.unit) return dimension.example;
  return "1 " + si_unit;
}

}  // namespace snug::input
