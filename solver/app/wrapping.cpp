#include "solver/app/wrapping.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

namespace snug::app {

namespace {

/// Where the last column of a row begins, in bytes; nothing where the row has none.
std::size_t last_column(const std::string& line) {
  const std::size_t first = line.find_first_not_of(' '), gap = line.rfind("  ");
  if (first == line.npos || gap == line.npos || gap < first) return line.npos;
  return line.find_first_not_of(' ', gap);
}

/// How far in a line goes on; nothing where it is a row of a table, which would no longer be one.
std::size_t hanging_indent(const std::string& line, std::size_t width) {
  const std::size_t column = last_column(line);
  const std::size_t first = line.find_first_not_of(' ');
  if (column == line.npos) return first >= 16 && first <= width / 2 ? first : std::min(first + 4, width / 2);
  const std::size_t indent = columns_of(line.substr(0, column));
  return indent <= width / 2 ? indent : line.npos;
}

/// Between blanks; a number and its unit are one.
std::vector<std::string> words_of(const std::string& text) {
  constexpr std::size_t longest_unit = 6;  // "gf/cm2", with a comma "Pa,"
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    const bool after_number = !words.empty() && !words.back().empty() && std::isdigit(static_cast<unsigned char>(words.back().back()));
    if (after_number && !word.empty() && word.size() <= longest_unit && (std::isalpha(static_cast<unsigned char>(word[0])) || word[0] == '%')) words.back() += " " + word;
    else words.push_back(word);
    begin = end + 1;
  }
  return words;
}

std::string wrapped_line(const std::string& line, std::size_t width) {
  if (columns_of(line) <= width) return line;
  const std::size_t indent = hanging_indent(line, width);
  if (indent == line.npos) return line;
  const std::size_t column = last_column(line), from = column == line.npos ? line.find_first_not_of(' ') : column;
  std::string text = line.substr(0, from);
  std::size_t used = columns_of(text);
  bool at_start = true;
  for (const std::string& word : words_of(line.substr(from))) {
    const std::size_t needed = columns_of(word);
    if (!at_start && used + 1 + needed > width) {
      text += "\n" + std::string(indent, ' ');
      used = indent;
    } else if (!at_start) {
      text += ' ', ++used;
    }
    text += word, used += needed;
    at_start = false;
  }
  return text;
}

}  // namespace

std::size_t columns_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string wrapped(const std::string& text, std::size_t width) {
  if (width == 0) return text;
  std::string result;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    result += wrapped_line(text.substr(begin, end - begin), width);
    if (end < text.size()) result += '\n';
    begin = end + 1;
  }
  return result;
}

}  // namespace snug::app
