// The text of a table as spreadsheets and machines save it, brought to lines of cells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace snug::input {

/// UTF-16 (with its mark, or told by its zero bytes) and Windows' Latin text as UTF-8; UTF-8 without its mark; CR and CR LF as LF.
std::string plain_text(std::string_view bytes);

/// The separator of a head line: tabs, else semicolons, else commas; those in double quotes do not count.
char separator_of(std::string_view head);

/// Cells of a line; a separator inside double quotes belongs to the cell, "" there is one quote. Cells are trimmed.
struct LineCells {
  std::vector<std::string> texts;
  std::vector<int> columns;  ///< where each begins, from 1
};
LineCells cells_of(const std::string& line, char separator);

/// Name and unit of a head: "girth [mm]", "girth (mm)", "girth in mm", "girth / mm".
struct HeadText {
  std::string name, unit;
};
HeadText head_of(const std::string& text);

/// A unit of tables as the last word of a name, "girth_mm", "girth cm"; without one the name as it is.
HeadText split_unit(const std::string& name);

/// A name as names are compared: small letters, one _ for blanks, hyphens and points.
std::string plain_name(std::string_view name);

}  // namespace snug::input
