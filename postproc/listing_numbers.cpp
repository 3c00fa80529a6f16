#include "postproc/listing_numbers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>

#include "cases/input/text.hpp"

namespace snug::postproc {
namespace {

bool is_sign(char c) { return c == '+' || c == '-'; }

char at(std::string_view text, std::size_t place) { return place < text.size() ? text[place] : '\0'; }

std::size_t digits_from(std::string_view text, std::size_t place) {
  std::size_t count = 0;
  while (input::is_digit(at(text, place + count))) ++count;
  return count;
}

/// Length of an exponent at `place`, or 0. A digit run that ends in a point gives its last digit to the next number.
std::size_t exponent_length(std::string_view text, std::size_t place) {
  const char c = at(text, place);
  if (is_sign(c)) {  // Fortran leaves the E out where the exponent has three digits
    const std::size_t digits = digits_from(text, place + 1);
    return digits == 3 && at(text, place + 4) != '.' ? 4 : 0;
  }
  if (c != 'E' && c != 'e' && c != 'D' && c != 'd') return 0;
  const std::size_t sign = is_sign(at(text, place + 1)) ? 1 : 0;
  std::size_t digits = digits_from(text, place + 1 + sign);
  if (digits > 1 && at(text, place + 1 + sign + digits) == '.') --digits;
  return digits >= 1 && digits <= 3 ? 1 + sign + digits : 0;
}

bool begins_with_word(std::string_view text, std::string_view word) {
  if (text.size() < word.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if ((text[i] | 0x20) != word[i]) return false;
  const char next = at(text, word.size());
  return !((next | 0x20) >= 'a' && (next | 0x20) <= 'z');
}

/// NaN, Inf or Infinity after a sign of length `sign`.
ListingNumber word_number(std::string_view text, std::size_t sign) {
  ListingNumber number;
  const std::string_view word = text.substr(sign);
  const double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [name, value] : std::array<std::pair<std::string_view, double>, 3>{
           {{"nan", std::numeric_limits<double>::quiet_NaN()}, {"infinity", infinity}, {"inf", infinity}}})
    if (begins_with_word(word, name)) {
      number.value = at(text, 0) == '-' ? -value : value;
      number.length = sign + name.size();
      return number;
    }
  return number;
}

/// A run of stars: fields are 13 or 12 wide.
ListingNumber overflown(std::string_view text) {
  const std::size_t stars = std::min(text.find_first_not_of('*'), text.size());
  ListingNumber number;
  if (stars < 3) return number;
  number.value = std::numeric_limits<double>::quiet_NaN();
  number.length = stars;
  number.fields = static_cast<int>(stars % 13 == 0 ? stars / 13 : stars % 12 == 0 ? stars / 12 : 1);
  return number;
}

/// Value of mantissa and exponent as they stand; beyond the range of a double it is zero or infinite.
double value_of(std::string_view mantissa, std::string_view exponent) {
  std::array<char, 64> buffer;
  if (at(mantissa, 0) == '+') mantissa.remove_prefix(1);
  mantissa = mantissa.substr(0, buffer.size() - 8);  // digits beyond a double's precision
  char* end = std::copy(mantissa.begin(), mantissa.end(), buffer.begin());
  if (!exponent.empty()) {
    if (!is_sign(exponent[0])) exponent.remove_prefix(1);
    *end++ = 'e';
    end = std::copy(exponent.begin(), exponent.end(), end);
  }
  double value = 0.0;
  const auto result = std::from_chars(buffer.data(), end, value);
  if (result.ec != std::errc::result_out_of_range) return value;
  const double sign = at(mantissa, 0) == '-' ? -1.0 : 1.0;
  return at(exponent, 0) == '-' ? 0.0 : sign * std::numeric_limits<double>::infinity();
}

}  // namespace

ListingNumber scan_number(std::string_view text) {
  if (at(text, 0) == '*') return overflown(text);
  const std::size_t sign = is_sign(at(text, 0)) ? 1 : 0;
  const std::size_t before = digits_from(text, sign);
  std::size_t end = sign + before;
  const bool point = at(text, end) == '.';
  const std::size_t after = point ? digits_from(text, end + 1) : 0;
  if (before + after == 0) return word_number(text, sign);
  end += (point ? 1 : 0) + after;
  ListingNumber number;
  const std::size_t exponent = point || !is_sign(at(text, end)) ? exponent_length(text, end) : 0;
  number.integer = !point && exponent == 0;
  number.value = value_of(text.substr(0, end), text.substr(end, exponent));
  number.length = end + exponent;
  return number;
}

std::vector<std::string> words_of(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  std::vector<std::string> words;
  for (std::size_t at = 0; (at = text.find_first_not_of(blanks, at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    words.emplace_back(text.substr(at, end - at));
    at = end;
  }
  return words;
}

}  // namespace snug::postproc
