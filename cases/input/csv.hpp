// Tables of numbers and texts with a head line: height [mm], girth [mm], name
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::input {

/// A CSV file as read: UTF-8, UTF-16 or Windows' Latin text, columns between commas, semicolons or tabs as in the head, decimal
/// commas where commas do not separate; or the first sheet of an .xlsx workbook (spreadsheet.hpp). Lines that are empty or begin with # are skipped; fields may stand in double quotes.
struct Csv {
  struct Column {
    std::string name;  ///< "girth"
    std::string unit;  ///< "mm" of "girth [mm]"; empty when the head gives none
    Location where;
  };
  struct Row {
    int line = 0;
    std::vector<std::string> cells;  ///< trimmed; as many as there are columns
    std::vector<int> columns;        ///< where each cell begins, from 1
  };
  std::string file;  ///< as shown in errors
  char separator = ',';  ///< none ('\0') of a workbook
  bool decimal_comma = false;
  std::vector<Column> columns;
  std::vector<Row> rows;

  /// Index of the column `name`, also in other capitals or with blanks for _, or -1.
  int find(const std::string& name) const;
  Location place(std::size_t row, std::size_t column) const;
};

/// Reads a CSV file or a workbook. A missing file, a missing head and rows of another length are reported; such rows are left out.
Csv read_csv(const std::filesystem::path& path, Diagnostics& diagnostics, const std::string& shown_as = {});

/// Columns without a unit whose names are a known one and a unit, "girth_mm" or "girth cm", get both.
void take_units_from_names(Csv& csv, const std::vector<std::string>& known);

/// The numbers of a column in SI. `si_unit` empty: plain numbers, and a unit in the head is an error; otherwise the
/// head must give a unit of that dimension: "girth [mm]", "girth (mm)", "girth in mm". Reports what is wrong and gives an empty vector
/// when the column is missing or not all numbers.
std::vector<double> numbers(const Csv& csv, const std::string& column, const std::string& si_unit,
                            Diagnostics& diagnostics);

/// The numbers of a column as they stand, by its index.
std::vector<double> column_numbers(const Csv& csv, std::size_t index, Diagnostics& diagnostics);

/// The same for a column that may be missing (then nothing is reported).
std::optional<std::vector<double>> optional_numbers(const Csv& csv, const std::string& column,
                                                    const std::string& si_unit, Diagnostics& diagnostics);

/// The texts of a column; reports a missing column.
std::vector<std::string> texts(const Csv& csv, const std::string& column, Diagnostics& diagnostics);

}  // namespace snug::input
