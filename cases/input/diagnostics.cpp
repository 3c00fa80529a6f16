#include "cases/input/diagnostics.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace snug::input {

namespace {

/// Texts of a user's files stand in messages: control characters, which a terminal would obey, are written out.
std::string harmless(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (code >= ' ' && code != 0x7f)
      result += c;
    else if (c == '\n' || c == '\t')
      result += ' ';
    else
      result += std::string("\\x") + "0123456789abcdef"[code / 16] + "0123456789abcdef"[code % 16];
  }
  return result;
}

/// The beginning and the end of what is too long to read.
std::string shown(const std::string& text, std::size_t most) {
  if (text.size() <= most) return harmless(text);
  const auto cut = [&](std::size_t at) {  // not inside a character of several bytes
    while (at > 0 && (static_cast<unsigned char>(text[at]) & 0xC0) == 0x80) --at;
    return at;
  };
  const std::size_t begin = cut(most * 3 / 4), end = cut(text.size() - most / 4);
  return harmless(text.substr(0, begin)) + " … (" + std::to_string(end - begin) + " more characters) … " + harmless(text.substr(end));
}

constexpr std::size_t longest_found = 600, longest_remedy = 3000, longest_file = 1000, most_errors = 100;

std::string told(const Diagnostic& diagnostic, const char* weight) {
  std::string text = shown(diagnostic.where.file, longest_file);
  if (diagnostic.where.line > 0)
    text += ":" + std::to_string(diagnostic.where.line) + ":" + std::to_string(diagnostic.where.column);
  if (!text.empty()) text += ": ";
  text += weight + (": " + shown(diagnostic.found, longest_found));
  if (!diagnostic.remedy.empty()) text += "; " + shown(diagnostic.remedy, longest_remedy);
  return text;
}

}  // namespace

std::string to_string(const Diagnostic& diagnostic) { return told(diagnostic, "error"); }
std::string warning_text(const Diagnostic& diagnostic) { return told(diagnostic, "warning"); }

void Diagnostics::error(Location where, std::string found, std::string remedy) {
  errors_.push_back({std::move(where), std::move(found), std::move(remedy)});
}

void Diagnostics::throw_if_any() const {
  if (!any()) return;
  std::vector<Diagnostic> in_order = errors_;
  std::stable_sort(in_order.begin(), in_order.end(), [](const Diagnostic& a, const Diagnostic& b) {
    return std::tie(a.where.file, a.where.line, a.where.column) < std::tie(b.where.file, b.where.line, b.where.column);
  });
  throw InputError(std::move(in_order));
}

namespace {

std::string lines(const std::vector<Diagnostic>& errors) {
  std::string text;
  for (std::size_t n = 0; n < errors.size() && n < most_errors; ++n) text += (text.empty() ? "" : "\n") + to_string(errors[n]);
  if (errors.size() > most_errors) text += "\nand " + std::to_string(errors.size() - most_errors) + " more errors";
  return text;
}

}  // namespace

InputError::InputError(std::vector<Diagnostic> errors)
    : std::runtime_error(lines(errors)), errors_(std::move(errors)) {}

InputError::InputError(Location where, std::string found, std::string remedy)
    : InputError(std::vector<Diagnostic>{{std::move(where), std::move(found), std::move(remedy)}}) {}

}  // namespace snug::input
