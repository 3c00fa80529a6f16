// Tables for spreadsheets, written with the separator and the decimal sign that a spreadsheet expects.
#pragma once

#include <array>
#include <ostream>
#include <string>
#include <string_view>

namespace snug::postproc {

/// comma: 1.5,2; semicolon, as spreadsheets have it where decimals have commas: 1,5;2; tab: 1.5, a tab, 2.
enum class CsvStyle { comma, semicolon, tab };
constexpr auto texts_of(CsvStyle) { return std::array{"comma", "semicolon", "tab"}; }

/// `text` behind an apostrophe where a spreadsheet would take it for a formula and run it (it begins with = + - @).
std::string without_formula(const std::string& text);

/// `text` without a formula, in quotes where a quote, a line end or one of the separators in it asks for them: the comma of files for
/// programs, those of all styles in tables for people.
std::string csv_cell(const std::string& text, std::string_view separators = ",");

/// Writes a table cell by cell.
class CsvWriter {
 public:
  explicit CsvWriter(std::ostream& out, CsvStyle style = CsvStyle::comma);

  CsvWriter& columns(std::string_view names);           ///< of a head: with commas between, as in the default style
  CsvWriter& text(const std::string& text);
  CsvWriter& number(double value, int digits = 6);      ///< so many significant digits at most
  CsvWriter& fixed(double value, int places);           ///< so many places behind the decimal sign
  CsvWriter& empty(int cells = 1);
  void end_row();

 private:
  CsvWriter& cell(std::string_view written);
  CsvWriter& decimal(std::string written);

  std::ostream& out_;
  char separator_, decimal_;
  bool first_ = true;  ///< of its row
};

}  // namespace snug::postproc
