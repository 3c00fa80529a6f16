// What readers ask of a text, whatever its format.
#pragma once

#include <string>
#include <string_view>

namespace snug::input {

/// Text without the blanks at both ends; a view into `text`.
inline std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\n\f\v";
  const auto first = text.find_first_not_of(blanks);
  return first == text.npos ? std::string_view() : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The same as a text of its own.
inline std::string trimmed_copy(std::string_view text) { return std::string(trimmed(text)); }

inline bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace snug::input
