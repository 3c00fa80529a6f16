#include "cases/input/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <sstream>

#include "cases/input/files.hpp"
#include "cases/input/spreadsheet.hpp"
#include "cases/input/suggestion.hpp"
#include "cases/input/table_lines.hpp"
#include "cases/input/text.hpp"
#include "cases/input/units.hpp"

namespace snug::input {

namespace {

Csv::Row row_of(const std::string& line, int number, char separator) {
  LineCells cells = cells_of(line, separator);
  return {.line = number, .cells = std::move(cells.texts), .columns = std::move(cells.columns)};
}

/// Spreadsheets leave empty cells at the end of lines, and lines of them at the end of a table.
void drop_empty_end(Csv::Row& row, std::size_t keep) {
  while (row.cells.size() > keep && row.cells.back().empty()) row.cells.pop_back(), row.columns.pop_back();
}

/// A line above the head: one text in a row of several cells, as spreadsheets have the name of a table over its columns.
bool is_title(const Csv::Row& row) {
  return row.cells.size() > 1 && !row.cells[0].empty() && std::all_of(row.cells.begin() + 1, row.cells.end(), [](const std::string& cell) { return cell.empty(); });
}

void add_row(Csv& csv, Csv::Row row, Diagnostics& diagnostics) {
  if (csv.columns.empty()) {
    if (is_title(row)) return;
    drop_empty_end(row, 1);
    for (std::size_t c = 0; c < row.cells.size(); ++c) {
      const HeadText head = head_of(row.cells[c]);
      csv.columns.push_back({head.name, head.unit, {csv.file, row.line, row.columns[c]}});
    }
    return;
  }
  if (row.cells.size() > 1 && std::all_of(row.cells.begin(), row.cells.end(), [](const std::string& cell) { return cell.empty(); })) return;
  drop_empty_end(row, csv.columns.size());
  if (row.cells.size() == csv.columns.size()) return csv.rows.push_back(std::move(row));
  if (csv.separator == '\0')
    return diagnostics.error({csv.file, row.line, 1}, fmt::format("{} cells where the head has {} columns", row.cells.size(), csv.columns.size()),
                             "give every column a head, and keep what is beside the table on another sheet");
  const char* separator = csv.separator == ';' ? "semicolons" : csv.separator == '\t' ? "tabs" : "commas";
  diagnostics.error({csv.file, row.line, 1}, fmt::format("{} cells where the head has {} columns", row.cells.size(), csv.columns.size()),
                    fmt::format("give one cell a column, separated by {} as the head is{}", separator,
                                csv.separator == ',' && row.cells.size() > csv.columns.size() ? "; with decimal commas separate by semicolons or tabs" : ""));
}

/// Where commas do not separate, or stand in quotes, they may be decimal points. "1,234" alone could be a thousand; a file without semicolons
/// must show by some other number which it is.
enum class Comma { none, decimal, unclear };

Comma comma_of(const Csv& csv) {
  bool commas = false, shown = csv.separator == ';';
  for (const Csv::Row& row : csv.rows)
    for (const std::string& cell : row.cells) {
      const auto comma = cell.find(',');
      if (comma == std::string::npos || cell.find_first_not_of("+-0123456789,Ee") != std::string::npos || cell.find(',', comma + 1) != std::string::npos) continue;
      commas = true;
      const std::size_t digits = cell.find_first_not_of("0123456789", comma + 1);
      shown |= std::min(digits, cell.size()) - comma - 1 != 3 || cell.find_first_of("123456789") > comma;
    }
  return !commas ? Comma::none : shown ? Comma::decimal : Comma::unclear;
}

/// Size in SI of the unit that the head gives in brackets.
bool factor_of(const Csv::Column& column, const std::string& si_unit, double& factor, Diagnostics& diagnostics) {
  factor = 1.0;
  if (si_unit.empty()) {
    if (column.unit.empty() || column.unit == "1" || column.unit == "-") return true;
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

bool parse_cell(const Csv& csv, std::string text, double& value) {
  if (csv.decimal_comma && text.find('.') == std::string::npos) std::replace(text.begin(), text.end(), ',', '.');
  return parse_number(text, value);
}

std::vector<std::string> names(const Csv& csv) {
  std::vector<std::string> result;
  for (const Csv::Column& column : csv.columns) result.push_back(column.name);
  return result;
}

/// Of two columns of one name nobody knows which is meant.
bool is_there_twice(const Csv& csv, std::size_t index, Diagnostics& diagnostics) {
  for (std::size_t c = index + 1; c < csv.columns.size(); ++c)
    if (plain_name(csv.columns[c].name) == plain_name(csv.columns[index].name)) {
      diagnostics.error(csv.columns[c].where, fmt::format("the column {} is there twice", csv.columns[index].name),
                        "keep the one that counts: one table a specimen, one column a quantity");
      return true;
    }
  return false;
}

void report_missing(const Csv& csv, const std::string& column, Diagnostics& diagnostics) {
  if (csv.columns.empty()) return;  // the file itself is already reported
  diagnostics.error({csv.file, csv.columns[0].where.line, 1}, "the column " + column + " is missing",
                    "add it to the head; there are: " + joined(names(csv)));
}

}  // namespace

namespace {

std::string bare(const std::string& cell) {
  const bool brackets = cell.size() > 2 && ((cell.front() == '[' && cell.back() == ']') || (cell.front() == '(' && cell.back() == ')'));
  return brackets ? cell.substr(1, cell.size() - 2) : cell;
}

bool are_units(const std::vector<std::string>& cells) {
  const auto is_unit = [](const std::string& cell) {
    double factor = 0.0;
    constexpr std::array dimensions = {"m", "Pa", "N", "N/m", "s", "kg", "kg/m2", "rad"};
    return std::any_of(dimensions.begin(), dimensions.end(), [&](const char* one) { return unit_factor(bare(cell), one, factor); });
  };
  const auto is_none = [](const std::string& cell) { return cell.empty() || bare(cell) == "-" || bare(cell) == "1" || bare(cell) == "%"; };
  return std::any_of(cells.begin(), cells.end(), is_unit) && std::all_of(cells.begin(), cells.end(), [&](const std::string& cell) { return is_none(cell) || is_unit(cell); });
}

std::size_t filled(const std::vector<std::string>& cells) {
  std::size_t count = cells.size();
  while (count > 0 && cells[count - 1].empty()) --count;
  return count;
}

/// A row of data: two cells or more, nothing but numbers.
bool is_numeric(const std::vector<std::string>& cells) {
  std::size_t numbers = 0;
  for (std::string cell : cells) {
    if (cell.empty()) continue;
    std::replace(cell.begin(), cell.end(), ',', '.');
    double value = 0.0;
    if (!parse_number(cell, value)) return false;
    ++numbers;
  }
  return numbers > 1;
}

/// Instruments and people write names and dates over a table. Where the first row has fewer cells than the first row of numbers, the head is
/// the row right over these (over their units), and what stands before it is passed over.
std::size_t head_row(const std::vector<std::vector<std::string>>& rows) {
  std::size_t data = 0;
  while (data < rows.size() && !is_numeric(rows[data])) ++data;
  if (data == rows.size() || data < 2) return 0;
  const std::size_t wide = filled(rows[data]);
  if (filled(rows[0]) >= wide) return 0;
  const auto fits = [&](std::size_t row) { return filled(rows[row]) >= wide && !rows[row].empty(); };
  std::size_t head = data - 1;
  if (are_units(rows[head]) && fits(head - 1)) --head;
  return fits(head) ? head : 0;
}

/// Units may stand in a row of their own below the names: every cell of it a unit, none in the head.
void take_units_below_the_head(Csv& csv) {
  if (csv.rows.empty() || std::any_of(csv.columns.begin(), csv.columns.end(), [](const Csv::Column& column) { return !column.unit.empty(); })) return;
  const std::vector<std::string>& cells = csv.rows.front().cells;
  if (!are_units(cells)) return;
  for (std::size_t c = 0; c < cells.size(); ++c) csv.columns[c].unit = bare(cells[c]) == "1" || bare(cells[c]) == "-" ? "" : bare(cells[c]);
  csv.rows.erase(csv.rows.begin());
}

Csv finished(Csv csv, Diagnostics& diagnostics) {
  take_units_below_the_head(csv);
  const Comma comma = comma_of(csv);
  csv.decimal_comma = comma == Comma::decimal;
  if (comma == Comma::unclear)
    diagnostics.error({csv.file, csv.rows[0].line, 1}, "numbers such as 1,234 may be one point two or one thousand two hundred",
                      "write decimal points, or separate the columns by semicolons where commas are decimal");
  if (csv.rows.empty() && !diagnostics.any())
    diagnostics.error({csv.file, 0, 0}, "the table has no rows", "give a head line and one line a row");
  return csv;
}

/// Columns as the sheet counts them; rows end where the sheet has no more cells.
Csv of_sheet(std::vector<SheetRow> sheet, Csv csv, Diagnostics& diagnostics) {
  csv.separator = '\0';
  std::size_t widest = 0;
  for (const SheetRow& row : sheet) widest = std::max(widest, row.cells.size());
  std::vector<Csv::Row> rows;
  std::vector<std::vector<std::string>> cells;
  for (SheetRow& from : sheet) {
    Csv::Row row{.line = from.number, .cells = {}, .columns = {}};
    for (std::string& cell : from.cells) row.cells.push_back(trimmed_copy(cell)), row.columns.push_back(static_cast<int>(row.cells.size()));
    const bool empty = std::all_of(row.cells.begin(), row.cells.end(), [](const std::string& cell) { return cell.empty(); });
    if (empty || row.cells[0].starts_with('#')) continue;
    cells.push_back(row.cells);
    rows.push_back(std::move(row));
  }
  rows.erase(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(head_row(cells)));
  for (Csv::Row& row : rows) {
    while (row.cells.size() < (csv.columns.empty() ? widest : csv.columns.size())) row.cells.emplace_back(), row.columns.push_back(static_cast<int>(row.cells.size()));
    add_row(csv, std::move(row), diagnostics);
  }
  return finished(std::move(csv), diagnostics);
}

}  // namespace

void take_units_from_names(Csv& csv, const std::vector<std::string>& known) {
  for (Csv::Column& column : csv.columns) {
    const HeadText split = split_unit(column.name);
    if (!column.unit.empty() || split.unit.empty()) continue;
    const auto is = [&](const std::string& name) { return plain_name(name) == plain_name(split.name); };
    const auto is_whole = [&](const std::string& name) { return plain_name(name) == plain_name(column.name); };
    if (std::any_of(known.begin(), known.end(), is) && std::none_of(known.begin(), known.end(), is_whole)) column.name = split.name, column.unit = split.unit;
  }
}

int Csv::find(const std::string& name) const {
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (columns[c].name == name) return static_cast<int>(c);
  for (std::size_t c = 0; c < columns.size(); ++c)
    if (plain_name(columns[c].name) == plain_name(name)) return static_cast<int>(c);
  return -1;
}

Location Csv::place(std::size_t row, std::size_t column) const {
  return {file, rows[row].line, rows[row].columns[column]};
}

Csv read_csv(const std::filesystem::path& path, Diagnostics& diagnostics, const std::string& shown_as) {
  Csv csv{.file = shown_as.empty() ? path.string() : shown_as, .columns = {}, .rows = {}};
  std::istringstream file;
  try {
    const std::string content = read_file(path, {.shown_as = csv.file, .most = std::uintmax_t{1} << 28});
    if (content.starts_with("\xD0\xCF\x11\xE0")) {
      diagnostics.error({csv.file, 0, 0}, "this is the file of an old spreadsheet program, or one with a password", "save its sheet as .xlsx, or as CSV (separated by commas, semicolons or tabs)");
      return csv;
    }
    if (is_zip(content)) return of_sheet(sheet_rows(content, csv.file, diagnostics), std::move(csv), diagnostics);
    file.str(plain_text(content));
  } catch (const InputError& error) {
    for (const Diagnostic& one : error.errors()) diagnostics.error(one.where, one.found, one.remedy);
    return csv;
  }
  std::vector<std::pair<int, std::string>> lines;
  std::vector<std::vector<std::string>> first_rows;  // enough of them to find the head
  constexpr std::size_t longest_title = 200;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    const std::string content = trimmed_copy(line);
    if (content.empty() || content[0] == '#') continue;
    if (first_rows.size() < longest_title) first_rows.push_back(cells_of(line, separator_of(line)).texts);
    lines.emplace_back(number, std::move(line));
  }
  for (std::size_t l = head_row(first_rows); l < lines.size(); ++l) {
    if (csv.columns.empty()) csv.separator = separator_of(lines[l].second);
    add_row(csv, row_of(lines[l].second, lines[l].first, csv.separator), diagnostics);
  }
  return finished(std::move(csv), diagnostics);
}

std::vector<double> numbers(const Csv& csv, const std::string& column, const std::string& si_unit,
                            Diagnostics& diagnostics) {
  const int index = csv.find(column);
  double factor = 1.0;
  if (index < 0) {
    report_missing(csv, column, diagnostics);
    return {};
  }
  if (is_there_twice(csv, static_cast<std::size_t>(index), diagnostics) || !factor_of(csv.columns[index], si_unit, factor, diagnostics)) return {};
  std::vector<double> values = column_numbers(csv, index, diagnostics);
  for (double& value : values) value *= factor;
  return values;
}

std::vector<double> column_numbers(const Csv& csv, std::size_t index, Diagnostics& diagnostics) {
  std::vector<double> values;
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    double value = 0.0;
    if (parse_cell(csv, csv.rows[r].cells[index], value))
      values.push_back(value);
    else if (csv.rows[r].cells[index].empty())
      diagnostics.error(csv.place(r, index), fmt::format("the cell of the column {} is empty", csv.columns[index].name), "give its number, or leave the row out");
    else
      diagnostics.error(csv.place(r, index), fmt::format("\"{}\" in the column {} is no number", csv.rows[r].cells[index], csv.columns[index].name),
                        "give a number with a decimal point and without a unit, or leave the row out");
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
