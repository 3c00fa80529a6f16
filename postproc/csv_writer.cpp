#include "postproc/csv_writer.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace snug::postproc {

std::string without_formula(const std::string& text) {
  const bool formula = !text.empty() && std::string("=+-@\t\r").find(text[0]) != std::string::npos;
  return formula ? "'" + text : text;
}

std::string csv_cell(const std::string& given, std::string_view separators) {
  const std::string text = without_formula(given);
  if (text.find_first_of("\"\n\r") == std::string::npos && text.find_first_of(separators) == std::string::npos) return text;
  std::string quoted = "\"";
  for (char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

CsvWriter::CsvWriter(std::ostream& out, CsvStyle style)
    : out_(out), separator_(style == CsvStyle::semicolon ? ';' : style == CsvStyle::tab ? '\t' : ','), decimal_(style == CsvStyle::semicolon ? ',' : '.') {}

CsvWriter& CsvWriter::columns(std::string_view names) {
  while (true) {
    const std::size_t end = names.find(',');
    cell(names.substr(0, end));
    if (end == std::string_view::npos) return *this;
    names.remove_prefix(end + 1);
  }
}

CsvWriter& CsvWriter::text(const std::string& text) { return cell(csv_cell(text, ",;\t")); }
CsvWriter& CsvWriter::number(double value, int digits) { return decimal(fmt::format("{:.{}g}", value, digits)); }
CsvWriter& CsvWriter::fixed(double value, int places) { return decimal(fmt::format("{:.{}f}", value, places)); }

CsvWriter& CsvWriter::empty(int cells) {
  for (int n = 0; n < cells; ++n) cell({});
  return *this;
}

void CsvWriter::end_row() {
  out_ << '\n';
  first_ = true;
}

CsvWriter& CsvWriter::cell(std::string_view written) {
  if (!first_) out_ << separator_;
  first_ = false;
  out_ << written;
  return *this;
}

CsvWriter& CsvWriter::decimal(std::string written) {
  std::replace(written.begin(), written.end(), '.', decimal_);
  return cell(written);
}

}  // namespace snug::postproc
