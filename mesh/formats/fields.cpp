#include "mesh/formats/fields.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace snug::mesh {

std::vector<TextField> fields_of(std::string_view line, int offset) {
  std::vector<TextField> fields;
  for (std::size_t begin = 0;; ) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    const std::string_view raw = line.substr(begin, end - begin), text = trimmed(raw);
    fields.push_back({text, offset + 1 + static_cast<int>(text.empty() ? begin : text.data() - line.data())});
    if (end == line.size()) return fields;
    begin = end + 1;
  }
}

std::optional<double> number_of(std::string_view text) {
  std::string plain(text);
  if (!plain.empty() && plain.front() == '+') plain.erase(0, 1);
  std::replace_if(plain.begin(), plain.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E');
  const auto sign = plain.find_last_of("+-");  // Fortran leaves the E out before exponents of three digits
  if (sign != plain.npos && sign > 0 && plain.find_first_of("Ee") == plain.npos) plain.insert(sign, "E");
  double value = 0.0;
  const auto [rest, fault] = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (rest != plain.data() + plain.size() || plain.empty()) return std::nullopt;
  if (fault == std::errc::result_out_of_range) return plain.find('-', 1) != plain.npos ? std::optional(0.0) : std::nullopt;
  if (fault != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<int> integer_of(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  int value = 0;
  const auto [rest, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault == std::errc() && rest == text.data() + text.size()) return value;
  const auto number = number_of(text);  // 3. and 3.0 are meant as 3
  if (number && std::abs(*number) < 2e9 && std::trunc(*number) == *number) return static_cast<int>(*number);
  return std::nullopt;
}

std::string upper_case(std::string_view text) {
  std::string upper(text);
  std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) { return std::toupper(c); });
  return upper;
}

input::Location FieldLine::at(std::size_t field) const {
  return {file, number, fields.empty() ? 1 : fields[std::min(field, fields.size() - 1)].column};
}

double FieldLine::number_at(std::size_t field, double otherwise) const {
  if (empty(field)) return otherwise;
  if (const auto value = number_of(text(field))) return *value;
  error(field, fmt::format("\"{}\" is no number", text(field).substr(0, 20)),
        "write the number itself; names stand for numbers only in APDL, where they are set before (NAME=VALUE)");
  return otherwise;
}

int FieldLine::integer_at(std::size_t field, int otherwise) const {
  if (empty(field)) return otherwise;
  if (const auto value = integer_of(text(field))) return *value;
  error(field, fmt::format("\"{}\" is no whole number", text(field).substr(0, 20)),
        "write the number itself; names stand for numbers only in APDL, where they are set before (NAME=VALUE)");
  return otherwise;
}

void FieldLine::error(std::size_t field, std::string found, std::string remedy) const {
  diagnostics.error(at(field), std::move(found), std::move(remedy));
}

}  // namespace snug::mesh
