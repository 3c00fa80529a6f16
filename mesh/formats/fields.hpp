// Lines of comma-separated fields with their places.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/input/diagnostics.hpp"
#include "cases/input/text.hpp"

namespace snug::mesh {

struct TextField {
  std::string_view text;  ///< trimmed
  int column = 1;
};

/// Fields between commas; `offset` columns stand before `line`.
std::vector<TextField> fields_of(std::string_view line, int offset = 0);

/// A line of text under a reader.
struct FieldLine {
  const std::string& file;
  int number;
  std::vector<TextField> fields;
  input::Diagnostics& diagnostics;

  std::string_view text(std::size_t field) const { return field < fields.size() ? fields[field].text : std::string_view(); }
  bool empty(std::size_t field) const { return text(field).empty(); }
  input::Location at(std::size_t field) const;
  /// A finite number (a blank field is `otherwise`); what is none is reported and gives `otherwise`.
  double number_at(std::size_t field, double otherwise = 0.0) const;
  int integer_at(std::size_t field, int otherwise = 0) const;
  void error(std::size_t field, std::string found, std::string remedy) const;
};

/// A finite number, also in Fortran's forms 1.D0 and 0.7-100; nothing where the whole text is none.
std::optional<double> number_of(std::string_view text);
std::optional<int> integer_of(std::string_view text);
std::string upper_case(std::string_view text);
using input::trimmed;

}  // namespace snug::mesh
