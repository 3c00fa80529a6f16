#include "cases/input/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "cases/input/text.hpp"

namespace snug::input {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;

/// The unit system of udunits, read once; it never changes afterwards. To udunits an angle is a plain number, so that a force
/// per length would pass for a force per length and angle; here an angle is a dimension of its own, of which the words are ours.
ut_system* unit_system() {
  static ut_system* const system = [] {
    ut_set_error_message_handler(ut_ignore);  // we report ourselves, with place and remedy
    ut_system* const units = ut_read_xml(nullptr);
    const Unit radian(ut_new_base_unit(units)), degree(ut_scale(std::numbers::pi / 180.0, radian.get()));
    ut_map_name_to_unit("angle_in_radians", UT_ASCII, radian.get());
    ut_map_name_to_unit("angle_in_degrees", UT_ASCII, degree.get());
    return units;
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

/// Words of textile sheets that udunits does not have, or has as something else.
std::string long_word(const std::string& word) {
  static const std::map<std::string, std::string> words = {
      {"deg", "angle_in_degrees"},    {"degs", "angle_in_degrees"},   {"degree", "angle_in_degrees"}, {"degrees", "angle_in_degrees"},
      {"rad", "angle_in_radians"},    {"radian", "angle_in_radians"}, {"radians", "angle_in_radians"}, {"mrad", "1e-3 angle_in_radians"},
      {"dyn", "dyne"},                {"gsm", "g/m2"},                {"GSM", "g/m2"},                {"gm", "g"},
      {"oz", "lb/16"},                {"lbs", "lb"}};
  const auto known = words.find(word);
  if (known != words.end()) return known->second;
  const auto small = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return word.size() == 4 && std::equal(word.begin(), word.end(), "mmhg", [&](char a, char b) { return small(a) == b; }) ? "mmHg" : word;
}

/// Words are letters with the digits between them; those at the end are an exponent ("deg2", "cm2").
std::string with_long_words(const std::string& text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_letter(text[end])) ++end;
    if (end == at) {
      result += text[at++];
      continue;
    }
    const std::string word = long_word(text.substr(at, end - at));
    if (word == "per") {  // "N/cm per 10 %"
      while (!result.empty() && result.back() == ' ') result.pop_back();
      result += '/';
      for (at = end; at < text.size() && text[at] == ' '; ++at) {}
      continue;
    }
    result += word.find_first_of(" /") == word.npos ? word : "(" + word + ")";
    at = end;
  }
  return result;
}

constexpr std::size_t longest_unit = 200;  // characters

/// The user's spelling as udunits wants it: every product sign is a space, every minus, square and exponent a plain one.
std::string plain(std::string unit) {
  static const std::vector<std::pair<std::string, std::string>> spellings = {
      {"·", " "}, {"⋅", " "}, {"∙", " "}, {"•", " "}, {"×", " "}, {"*", " "},  // products
      {"\u00a0", " "}, {"\u202f", " "}, {"\u2009", " "},                      // blanks that printers use
      {"−", "-"}, {"–", "-"}, {"⁻", "-"}, {"¹", "1"}, {"²", "2"}, {"³", "3"},
      {"°", "deg"}, {"º", "deg"}, {"˚", "deg"}, {"µ", "u"}, {"μ", "u"}, {"∕", "/"}, {"⁄", "/"}, {"\"", "inch"}, {"″", "inch"},
      {" . ", " "}, {". ", " "}, {" .d", " d"}, {" .c", " c"}, {" .m", " m"}};  // points that stand apart
  for (const auto& [from, to] : spellings)
    for (std::size_t at; (at = unit.find(from)) != std::string::npos;) unit.replace(at, from.size(), to);
  while (!unit.empty() && unit.back() == '.') unit.pop_back();
  return with_long_words(with_single_blanks(unit));
}

Unit parsed(const std::string& text) { return Unit(ut_parse(unit_system(), text.c_str(), UT_UTF8)); }

/// A number right behind the last slash begins what is divided by: "N/cm/10 %" is a force per length at a tenth of stretch, in no sheet a
/// tenth of it in percent.
bool divides_by_a_number(const std::string& text) {
  const auto slash = text.rfind('/');
  return slash != text.npos && slash + 1 < text.size() && (text[slash + 1] == '.' || (text[slash + 1] >= '0' && text[slash + 1] <= '9'));
}

/// Everything behind the last slash as one divisor: "gf/cm deg" as "gf/(cm deg)". Empty where that is nothing else.
std::string all_below(const std::string& text) {
  const auto slash = text.rfind('/');
  if (slash == text.npos || text.find_first_of("()", slash) != text.npos) return {};
  return text.substr(0, slash + 1) + "(" + text.substr(slash + 1) + ")";
}

Unit parse_unit(const std::string& text) { return parsed(plain(text)); }

struct Dimension {
  const char *unit, *name, *example;
};

const std::array<Dimension, 15> dimensions = {{{"%", "a percentage", "40 %"},
                                               {"1", "a ratio", "0.4 1"},
                                               {"m", "a length", "0.57 mm"},
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

bool is_unit_name(const std::string& name) {
  if (name.empty() || name.size() > longest_unit) return false;
  return std::string("0123456789.+-").find(name[0]) == std::string::npos || name.substr(0, 2) == "1/";
}

bool factor_between(const Unit& from, const Unit& to, double& factor) {
  if (!from || !to || !ut_are_convertible(from.get(), to.get())) return false;
  std::unique_ptr<cv_converter, decltype(&cv_free)> converter(ut_get_converter(from.get(), to.get()), &cv_free);
  if (!converter) return false;
  factor = cv_convert_double(converter.get(), 1.0);
  // udunits also leads from a unit to its reciprocal (2 1/m is 0.5 m) and over offsets (degC): neither is a factor
  return std::abs(cv_convert_double(converter.get(), 2.0) - 2.0 * factor) <= 1e-12 * std::abs(factor);
}

/// What a unit of another dimension is easily taken for, with the way out; empty where nothing is known.
std::string likely_slip(const std::string& unit, const std::string& si_unit, double number) {
  double factor = 1.0;
  const std::string per_angle = "N/(m rad)";
  if (si_unit == per_angle && unit_factor(unit, "N/m", factor))
    return ", but a force per length: a shear stiffness of KES is one per angle, e.g. \"0.77 gf/(cm degree)\"; per radian write \"N/(m rad)\"";
  if (si_unit == "N/m" && unit_factor(unit, per_angle, factor))
    return ", but one per angle: per radian it is \"" + fmt::format("{:.6g}", number * factor) + " N/m\"";
  const auto as_force = [&] {  // older sheets print g for gf
    std::string word, result;
    for (const char c : unit + ' ') {
      if (is_letter(c)) {
        word += c;
        continue;
      }
      result += (word == "g" ? "gf" : word == "kg" ? "kgf" : word == "lb" || word == "lbs" ? "lbf" : word) + c, word.clear();
    }
    return trimmed_copy(result);
  };
  if (as_force() != unit && unit_factor(as_force(), si_unit, factor)) return (unit.find("lb") == unit.npos ? ": g is a mass, the force of a gram is gf: write \"" : ": lb is a mass, its force is lbf: write \"") + as_force() + "\"";
  return {};
}

/// What stands behind a number (which ends at `end`) and makes two of it: a decimal comma, a range, a deviation. Empty: nothing.
std::string slip_in_number(const std::string& text, std::size_t end) {
  if (text[end] == ',' && end + 1 < text.size() && is_digit(text[end + 1])) {
    std::string pointed = text;
    pointed[end] = '.';
    return ": \"" + text.substr(end) + "\" is not a unit: decimals take a point, \"" + pointed + "\", and thousands no sign";
  }
  const char* const range = " is a range, and one number is due here: give its middle, or the end that counts";
  if (end > 0 && text[end - 1] == '.' && text[end] == '.') return range;
  const std::size_t after = text.find_first_not_of(" \t", end);
  for (const char* sign : {"+-", "+/-", "±", "...", "..", "–", "-", "to "}) {
    const std::string_view between(sign);
    if (text.compare(after, between.size(), between) != 0) continue;
    const std::size_t next = text.find_first_not_of(" \t", after + between.size());
    if (next == text.npos || !is_digit(text[next])) return {};
    const bool deviation = between[0] == '+' || between == "±";
    return deviation ? " is a value with its deviation, and one number is due here: leave the deviation out" : range;
  }
  return {};
}

}  // namespace

bool unit_factor(const std::string& unit, const std::string& si_unit, double& factor) {
  const std::string name = trimmed_copy(unit);
  if (!is_unit_name(name)) return false;
  const Unit to = parse_unit(si_unit);
  const std::string text = plain(name), divided = all_below(text);
  // Sheets print gf/cm·deg for gf/(cm·deg) and N/5 cm for N/(5 cm): read so where only this has the dimension, or a number is divided by.
  const auto as_one_divisor = [&] { return !divided.empty() && factor_between(parsed(divided), to, factor); };
  if (divides_by_a_number(text) && as_one_divisor()) return true;
  return factor_between(parsed(text), to, factor) || as_one_divisor();
}

Quantity to_si(const std::string& text, const std::string& si_unit) {
  const std::string trimmed_text = trimmed_copy(text);
  if (trimmed_text.size() > 200)
    return {0.0, "a text of " + std::to_string(text.size()) + " characters is no quantity"};
  const char* begin = trimmed_text.data();
  const char* end = begin + trimmed_text.size();
  if (begin != end && *begin == '+') ++begin;
  double number = 0.0;
  const auto [rest, fault] = std::from_chars(begin, end, number);
  if (fault != std::errc{}) return {0.0, "\"" + text + "\" does not begin with a number"};
  const std::string unit = trimmed_copy({rest, end});
  if (unit.empty()) return {0.0, "\"" + text + "\" has no unit"};
  if (const std::string slip = slip_in_number(trimmed_text, rest - trimmed_text.data()); !slip.empty()) return {0.0, "\"" + text + "\"" + slip};
  double factor = 1.0;
  if (unit_factor(unit, si_unit, factor)) return {number * factor, {}};
  if (!parse_unit(unit)) return {0.0, "\"" + unit + "\" in \"" + text + "\" is not a unit"};
  return {0.0, "\"" + text + "\" is not " + dimension_name(si_unit) + likely_slip(unit, si_unit, number)};
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
