#include "cases/input/diagnostics.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

namespace snug::input {

std::string to_string(const Diagnostic& diagnostic) {
  std::string text = diagnostic.where.file;
  if (diagnostic.where.line > 0)
    text += ":" + std::to_string(diagnostic.where.line) + ":" + std::to_string(diagnostic.where.column);
  if (!text.empty()) text += ": ";
  text += "error: " + diagnostic.found;
  if (!diagnostic.remedy.empty()) text += "; " + diagnostic.remedy;
  return text;
}

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
  for (const Diagnostic& error : errors) text += (text.empty() ? "" : "\n") + to_string(error);
  return text;
}

}  // namespace

InputError::InputError(std::vector<Diagnostic> errors)
    : std::runtime_error(lines(errors)), errors_(std::move(errors)) {}

InputError::InputError(Location where, std::string found, std::string remedy)
    : InputError(std::vector<Diagnostic>{{std::move(where), std::move(found), std::move(remedy)}}) {}

}  // namespace snug::input
