#include "cases/input/table_lines.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include "cases/input/text.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

constexpr std::string_view blanks = " \t\r";

void append_utf8(std::uint32_t code, std::string& text) {
  const auto put = [&](std::uint32_t value) { text += static_cast<char>(value); };
  if (code < 0x80) return put(code);
  if (code < 0x800) return put(0xC0 | code >> 6), put(0x80 | (code & 0x3F));
  if (code < 0x10000) return put(0xE0 | code >> 12), put(0x80 | (code >> 6 & 0x3F)), put(0x80 | (code & 0x3F));
  put(0xF0 | code >> 18), put(0x80 | (code >> 12 & 0x3F)), put(0x80 | (code >> 6 & 0x3F)), put(0x80 | (code & 0x3F));
}

std::string from_utf16(std::string_view bytes, bool big_endian) {
  const auto unit = [&](std::size_t at) {
    const auto a = static_cast<unsigned char>(bytes[at]), b = static_cast<unsigned char>(bytes[at + 1]);
    return static_cast<std::uint32_t>(big_endian ? a << 8 | b : b << 8 | a);
  };
  std::string text;
  for (std::size_t at = 0; at + 1 < bytes.size(); at += 2) {
    std::uint32_t code = unit(at);
    if (code >= 0xD800 && code < 0xDC00 && at + 3 < bytes.size()) code = 0x10000 + ((code - 0xD800) << 10) + (unit(at += 2) - 0xDC00);
    append_utf8(code, text);
  }
  return text;
}

/// Every other byte of Latin text in UTF-16 is zero.
bool zeros_alternate(std::string_view bytes, std::size_t first) {
  const std::size_t looked_at = std::min<std::size_t>(bytes.size(), 64);
  if (looked_at < 4) return false;
  for (std::size_t at = first; at < looked_at; at += 2)
    if (bytes[at] != '\0') return false;
  return bytes[1 - first] != '\0';
}

bool is_utf8(std::string_view text) {
  int due = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (due > 0) {
      if ((byte & 0xC0) != 0x80) return false;
      --due;
    } else if (byte >= 0x80) {
      due = (byte & 0xE0) == 0xC0 ? 1 : (byte & 0xF0) == 0xE0 ? 2 : (byte & 0xF8) == 0xF0 ? 3 : -1;
      if (due < 0) return false;
    }
  }
  return due == 0;
}

std::string in_utf8(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE")) return from_utf16(bytes.substr(2), false);
  if (bytes.starts_with("\xFE\xFF")) return from_utf16(bytes.substr(2), true);
  if (zeros_alternate(bytes, 1)) return from_utf16(bytes, false);
  if (zeros_alternate(bytes, 0)) return from_utf16(bytes, true);
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  if (is_utf8(bytes)) return std::string(bytes);
  std::string text;
  for (const char c : bytes) append_utf8(static_cast<unsigned char>(c), text);
  return text;
}

/// Bytes of a blank that does not break or is narrow, as text programs put before units; 0: there is none.
std::size_t wide_blank(const std::string& text, std::size_t at) {
  for (const std::string_view blank : {"\u00a0", "\u202f", "\u2009", "\u2007"})
    if (text.compare(at, blank.size(), blank) == 0) return blank.size();
  return 0;
}

}  // namespace

std::string plain_text(std::string_view bytes) {
  const std::string text = in_utf8(bytes);
  std::string lines;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (const std::size_t wide = wide_blank(text, at)) {
      lines += ' ', at += wide - 1;
    } else if (text[at] != '\r') lines += text[at];
    else if (at + 1 == text.size() || text[at + 1] != '\n') lines += '\n';
  }
  return lines;
}

char separator_of(std::string_view head) {
  bool quoted = false, tab = false, semicolon = false, begins = true;
  for (const char c : head) {
    if (c == '"' && (quoted || begins)) quoted = !quoted;
    tab |= !quoted && c == '\t', semicolon |= !quoted && c == ';';
    begins = c == '\t' || c == ';' || c == ',' || (begins && c == ' ');
  }
  return tab ? '\t' : semicolon ? ';' : ',';
}

LineCells cells_of(const std::string& line, char separator) {
  LineCells cells{{""}, {1}};
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && (quoted || trimmed(cells.texts.back()).empty())) {  // inside a cell it is a character: girth (")
      if (quoted && i + 1 < line.size() && line[i + 1] == '"') cells.texts.back() += line[i++];
      else quoted = !quoted;
    } else if (line[i] == separator && !quoted) {
      cells.texts.emplace_back();
      cells.columns.push_back(static_cast<int>(i) + 2);
    } else {
      cells.texts.back() += line[i];
    }
  }
  for (std::size_t c = 0; c < cells.texts.size(); ++c) {
    const auto before = cells.texts[c].find_first_not_of(" \t");
    if (before != std::string::npos) cells.columns[c] += static_cast<int>(before);
    cells.texts[c] = trimmed_copy(cells.texts[c]);
  }
  return cells;
}

HeadText head_of(const std::string& text) {
  for (const auto& [opens, closes] : {std::pair{'[', ']'}, std::pair{'(', ')'}}) {
    const auto open = opens == '(' ? text.rfind(opens) : text.find(opens), close = text.rfind(closes);
    if (open != text.npos && close != text.npos && close > open && (opens == '[' || close + 1 == text.size()))
      return {trimmed_copy(text.substr(0, open)), trimmed_copy(text.substr(open + 1, close - open - 1))};
  }
  double factor = 1.0;
  for (const char* between : {" in ", "/"}) {
    const auto at = text.rfind(between);
    if (at == text.npos || at == 0) continue;
    const std::string unit = trimmed_copy(text.substr(at + std::string(between).size()));
    for (const char* dimension : {"m", "N", "Pa", "rad", "s"})
      if (unit_factor(unit, dimension, factor)) return {trimmed_copy(text.substr(0, at)), unit};
  }
  return {text, ""};
}

HeadText split_unit(const std::string& name) {
  static const std::array<std::string_view, 22> units = {"mm", "cm", "m",  "in",  "inch", "inches", "N",    "cN",  "mN", "kN",   "gf",
                                                         "kgf", "%", "Pa", "kPa", "MPa",  "mmHg",   "hPa", "deg", "s", "percent", "lbf"};
  const auto at = name.find_last_of(" _");
  if (at == name.npos || at == 0 || std::find(units.begin(), units.end(), name.substr(at + 1)) == units.end()) return {name, ""};
  return {trimmed_copy(name.substr(0, at)), name.substr(at + 1)};
}

std::string plain_name(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const bool gap = blanks.find(c) != blanks.npos || c == '-' || c == '.' || c == '_';
    if (!gap) plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (!plain.empty() && plain.back() != '_') plain += '_';
  }
  while (!plain.empty() && plain.back() == '_') plain.pop_back();
  return plain;
}

}  // namespace snug::input
