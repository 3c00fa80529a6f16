#include "solver/app/batch/variants.hpp"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdlib>
#include <set>
#include <sstream>

#include "cases/input/diagnostics.hpp"
#include "cases/input/text.hpp"

namespace snug::app {

namespace {

constexpr int most_values = 1000;

input::InputError wrong(const std::string& text, const std::string& found, const std::string& remedy) { return {{"--sweep " + text, 0, 0}, found, remedy}; }

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

/// "190 mm" as 190 and "mm".
std::optional<std::pair<double, std::string>> measured(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const std::string unit = input::trimmed_copy(end);
  const bool names_a_unit = unit.empty() || std::isalpha(static_cast<unsigned char>(unit[0])) || unit[0] == '%';  // "001-01" is a fabric
  if (end == text.c_str() || !std::isfinite(value) || !names_a_unit) return std::nullopt;
  return std::pair{value, unit};
}

std::string with_unit(double value, const std::string& unit) { return fmt::format("{:.9g}{}{}", value, unit.empty() ? "" : " ", unit); }

Sweep steps_of(const std::string& text, const std::string& key, const std::vector<std::string>& parts) {
  const char* like = "write for example garment.pattern.flat_circumference=\"190 mm:220 mm:4\"";
  const auto from = measured(input::trimmed_copy(parts[0])), to = measured(input::trimmed_copy(parts[1])), count = measured(input::trimmed_copy(parts[2]));
  if (!from || !to) throw wrong(text, fmt::format("\"{}\" is no number", !from ? parts[0] : parts[1]), like);
  const std::string unit = to->second.empty() ? from->second : to->second;
  if (!from->second.empty() && from->second != unit) throw wrong(text, fmt::format("it goes from {} to {}", from->second, unit), "give both ends in one unit");
  if (!count || !count->second.empty() || count->first != std::floor(count->first) || count->first < 2 || count->first > most_values)
    throw wrong(text, fmt::format("\"{}\" is no count of values", parts[2]), fmt::format("give a whole number from 2 to {}; {}", most_values, like));
  Sweep sweep{key, {}, {}, unit};
  for (int i = 0, n = static_cast<int>(count->first); i < n; ++i) {
    sweep.numbers.push_back(from->first + (to->first - from->first) * i / (n - 1));
    sweep.values.push_back(with_unit(sweep.numbers.back(), unit));
  }
  return sweep;
}

}  // namespace

Sweep sweep_of(const std::string& text) {
  const auto equals = text.find('=');
  const std::string key = input::trimmed_copy(text.substr(0, equals)), values = equals == text.npos ? "" : text.substr(equals + 1);
  if (key.empty() || input::trimmed(values).empty()) throw wrong(text, "there is no KEY=FROM:TO:N", "write for example --sweep \"garment.pattern.flat_circumference=190 mm:220 mm:4\", or KEY=A,B,C");
  if (const std::vector<std::string> parts = split(values, ':'); parts.size() == 3) return steps_of(text, key, parts);
  Sweep sweep{key, {}, {}, {}};
  for (const std::string& value : split(values, ',')) {
    if (input::trimmed(value).empty()) throw wrong(text, "a value is empty", "write KEY=A,B,C");
    sweep.values.push_back(input::trimmed_copy(value));
    if (const auto number = measured(sweep.values.back())) sweep.numbers.push_back(number->first), sweep.unit = number->second;
  }
  const auto as_number = [&](std::size_t i) { return with_unit(sweep.numbers[i], sweep.unit); };
  bool numbers = sweep.numbers.size() == sweep.values.size();
  for (std::size_t i = 0; numbers && i < sweep.values.size(); ++i) numbers = measured(as_number(i)) == measured(sweep.values[i]);
  if (!numbers) sweep.numbers.clear(), sweep.unit.clear();
  return sweep;
}

std::vector<input::StudyVariant> combinations(const std::vector<Sweep>& sweeps) {
  std::vector<input::StudyVariant> all = {{"", {}}};
  for (const Sweep& sweep : sweeps) {
    std::vector<input::StudyVariant> product;
    for (const input::StudyVariant& one : all)
      for (const std::string& value : sweep.values) {
        input::StudyVariant next = one;
        next.set.push_back(sweep.key + "=" + value);
        const std::string last = sweep.key.substr(sweep.key.rfind('.') + 1);
        next.name += (one.name.empty() ? "" : ", ") + last + " " + value;
        product.push_back(std::move(next));
      }
    all = std::move(product);
  }
  return all;
}

std::vector<std::string> folder_names(const std::vector<std::string>& names) {
  std::vector<std::string> folders;
  std::set<std::string> taken;
  for (const std::string& name : names) {
    std::string plain;
    for (const unsigned char c : name) {
      const bool keeps = std::isalnum(c) || c == '.' || c == '_' || c == '-' || c >= 0x80;
      if (keeps) plain += static_cast<char>(c);
      else if (!plain.empty() && plain.back() != '-') plain += '-';
    }
    while (!plain.empty() && (plain.back() == '-' || plain.back() == '.')) plain.pop_back();
    while (!plain.empty() && plain.front() == '.') plain.erase(0, 1);
    if (plain.empty()) plain = "run";
    std::string folder = plain;
    for (int n = 2; !taken.insert(folder).second; ++n) folder = fmt::format("{}-{}", plain, n);
    folders.push_back(folder);
  }
  return folders;
}

}  // namespace snug::app
