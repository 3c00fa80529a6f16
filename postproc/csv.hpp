// Comma-separated tables with a heading row: the wear trial, users' curves and users' pressures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::postproc {

/// A table of text cells. Blank lines and lines that start with # are skipped.
struct CsvTable {
  std::string file;                             ///< for messages
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows;   ///< as long as `heads` each
  std::vector<int> lines;                       ///< line in the file of each row, from 1

  std::optional<std::size_t> column(std::string_view head) const;
  /// The cell as a finite number. Throws InputError with file and line otherwise.
  double number(std::size_t row, std::size_t column) const;
  input::Location where(std::size_t row) const { return {file, lines.at(row), 0}; }
};

/// Throws InputError on a missing heading or a row of another length.
CsvTable parse_csv(std::string_view text, std::string file);
/// Throws InputError when the file cannot be read.
CsvTable read_csv(const std::filesystem::path& file);

/// Pressure of every row in Pa, from the first of the columns pressure_Pa, pressure_gf_per_cm2, pressure_mmHg.
/// Throws InputError when there is none or a pressure is negative.
std::vector<double> pressure_column(const CsvTable& table);

/// `text` in quotes where a comma, quote or line end in it asks for them.
std::string csv_cell(const std::string& text);

}  // namespace snug::postproc
