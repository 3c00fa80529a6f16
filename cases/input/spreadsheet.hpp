// Tables as spreadsheet programs keep them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cases/input/diagnostics.hpp"

namespace snug::input {

/// A row with the values that the sheet shows in its cells, from the first column on; numbers with all their digits.
struct SheetRow {
  int number = 0;  ///< from 1
  std::vector<std::string> cells;
};

/// Whether the bytes are those of a workbook of Excel 2007 and later (.xlsx): a zip file, which other programs have, too.
bool is_zip(std::string_view bytes);

/// The first sheet of an .xlsx workbook (ECMA-376, Office Open XML). Formulas give the value that is kept beside them; one without such a value and cells
/// with an error (#DIV/0!) are reported with their cell, as is what is no such workbook.
std::vector<SheetRow> sheet_rows(std::string_view bytes, const std::string& shown_as, Diagnostics& diagnostics);

}  // namespace snug::input
