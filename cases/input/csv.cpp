#include "cases/input/csv.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <sstream>

#include "cases/input/files.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// Splits one line at its commas; a comma inside double quotes belongs to the cell, "" there is one quote.
Csv::Row split(const std::string& line, int number) {
  Csv::Row row{.line = number, .cells = {""}, .columns = {1}};
  bool inside_quotes = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') {
      if (inside_quotes && i + 1 < line.size() && line[i + 1] == '"') {
        row.cells.back() += line[i++];
      } else {
        inside_quotes = !inside_quotes;
      }
    } else if (line[i] == ',' && !inside_quotes) {
      row.cells.emplace_back();
      row.columns.push_back(static_cast<int>(i) + 2);
    } else {
      row.cells.back() += line[i];
    }
  }
  for (std::size_t c = 0; c < row.cells.size(); ++c) {
    const auto blanks = row.cells[c].find_first_not_of(" \t");
    if (blanks != std::string::npos) row.columns[c] += static_cast<int>(blanks);
    row.cells[c] = trimmed(row.cells[c]);
  }
  return row;
}

Csv::Column column_of(const std::string& head, const Location& where) {
  const auto open = head.find('['), close = head.rfind(']');
  if (open == std::string::npos || close == std::string::npos || close < open) return {head, "", where};
  return {trimmed(head.substr(0, open)), trimmed(head.substr(open + 1, close - open - 1)), where};
}

void add_row(Csv& csv, Csv::Row row, Diagnostics& diagnostics) {
  if (csv.columns.empty()) {
    for (std::size_t c = 0; c < row.cells.size(); ++c)
      csv.columns.push_back(column_of(row.cells[c], {csv.file, row.line, row.columns[c]}));
  } else if (row.cells.size() != csv.columns.size()) {
    diagnostics.error({csv.file, row.line, 1},
                      fmt::format("{} cells where the head has {} columns", row.cells.size(), csv.columns.size()),
                      "give one cell a column, separated by commas");
  } else {
    csv.rows.push_back(std::move(row));
  }
}

/// Size in SI of the unit that the head gives in brackets.
bool factor_of(const Csv::Column& column, const std::string& si_unit, double& factor, Diagnostics& diagnostics) {
  factor = 1.0;
  if (si_unit.empty()) {
    if (column.unit.empty()) return true;
    diagnostics.error(column.where, fmt::format("the column {} has the unit [{}]", column.name, column.unit),
                      "this column is a plain number: leave the unit out");
    return false;
  }
  const std::string remedy =
      fmt::format("give {} in the head, e.g. {} [{}]", dimension_name(si_unit), column.name, si_unit);
  if (column.unit.empty()) {
    diagnostics.error(column.where, fmt::format("the column {} has no unit", column.name), remedy);
    return false;
  }
  if (unit_factor(column.unit, si_unit, factor)) return true;
  diagnostics.error(column.where,
                    fmt::format("[{}] of the column {} is not {}", column.unit, column.name, dimension_name(si_unit)),
                    remedy);
  return false;
}

bool parse_number(const std::string& text, double& value) {
  const char* begin = text.data();
  const char* end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  const auto [rest, fault] = std::from_chars(begin, end, value);
  return fault == std::errc{} && rest == end && std::isfinite(value);
}

std::vector<std::string> names(const Csv& csv) {
  std::vector<std::string> result;
  for (const Csv::Column& column : csv.columns) result.push_back(column.name);
  return result;
}

void report_missing(const Csv& csv, const std::string& column, Diagnostics& diagnostics) {
  if (csv.columns.empty()) return;  // the file itself is already reported
  diagnostics.error({csv.file, csv.columns[0].where.line, 1}, "the column " + column + " is missing",
                    "add it to the head; there are: " + joined(names(csv)));
}

}  // namespace

int Csv::find(const std::string& name) const {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].name == name) return static_cast<int>(c);
  return -1;
}

Location Csv::place(std::size_t row, std::size_t column) const {
  return {file, rows[row].line, rows[row].columns[column]};
}

Csv read_csv(const std::filesystem::path& path, Diagnostics& diagnostics, const std::string& shown_as) {
  Csv csv{.file = shown_as.empty() ? path.string() : shown_as, .columns = {}, .rows = {}};
  std::istringstream file;
  try {
    file.str(read_file(path, {.shown_as = csv.file, .most = std::uintmax_t{1} << 28}));
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.errors()) diagnostics.error(one.where, one.found, one.remedy);
    return csv;
  }
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (number == 1 && line.rfind("\xEF\xBB\xBF", 0) == 0) line.erase(0, 3);  // byte order mark of some spreadsheets
    const std::string content = trimmed(line);
    if (!content.empty() && content[0] != '#') add_row(csv, split(line, number), diagnostics);
  }
  if (csv.rows.empty() && !diagnostics.any())
    diagnostics.error({csv.file, 0, 0}, "the table has no rows", "give a head line and one line a row");
  return csv;
}

std::vector<double> numbers(const Csv& csv, const std::string& column, const std::string& si_unit,
                            Diagnostics& diagnostics) {
  const int index = csv.find(column);
  double factor = 1.0;
  if (index < 0) {
    report_missing(csv, column, diagnostics);
    return {};
  }
  if (!factor_of(csv.columns[index], si_unit, factor, diagnostics)) return {};
  std::vector<double> values;
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    double value = 0.0;
    if (parse_number(csv.rows[r].cells[index], value)) {
      values.push_back(value * factor);
    } else {
      diagnostics.error(csv.place(r, index),
                        fmt::format("\"{}\" in the column {} is no number", csv.rows[r].cells[index], column),
                        "give a number with a decimal point and without a unit");
    }
  }
  return values.size() == csv.rows.size() ? values : std::vector<double>{};
}

std::optional<std::vector<double>> optional_numbers(const Csv& csv, const std::string& column,
                                                    const std::string& si_unit, Diagnostics& diagnostics) {
  if (csv.find(column) < 0) return std::nullopt;
  return numbers(csv, column, si_unit, diagnostics);
}

std::vector<std::string> texts(const Csv& csv, const std::string& column, Diagnostics& diagnostics) {
  const int index = csv.find(column);
  if (index < 0) {
    report_missing(csv, column, diagnostics);
    return {};
  }
  std::vector<std::string> values;
  for (const Csv::Row& row : csv.rows) values.push_back(row.cells[index]);
  return values;
}

}  // namespace snug::input
