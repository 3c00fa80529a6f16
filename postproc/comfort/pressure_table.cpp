#include "postproc/comfort/pressure_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>

#include "postproc/units.hpp"

namespace snug::postproc {
namespace {

struct PressureHead {
  const char* name;
  double pascal;
};
constexpr PressureHead plain_heads[] = {
    {"pressure_Pa", 1.0}, {"pressure_gf_per_cm2", pascal_per_gf_cm2}, {"pressure_mmHg", pascal_per_mmHg}};

std::vector<double> checked(const input::Csv& table, std::size_t column, std::vector<double> pressures,
                            input::Diagnostics& diagnostics) {
  bool good = true;
  for (std::size_t row = 0; row < pressures.size(); ++row) {
    if (std::isfinite(pressures[row]) && pressures[row] >= 0) continue;
    good = false;
    diagnostics.error(table.place(row, column), fmt::format("a pressure of {}", table.rows[row].cells[column]),
                      "write contact pressures: finite and not negative");
  }
  return good ? pressures : std::vector<double>{};
}

}  // namespace

std::vector<double> pressures_of(const input::Csv& table, input::Diagnostics& diagnostics) {
  for (const auto& [name, pascal] : plain_heads) {
    const int column = table.find(name);
    if (column < 0) continue;
    std::vector<double> values = input::numbers(table, name, "", diagnostics);
    for (double& value : values) value *= pascal;
    return checked(table, column, std::move(values), diagnostics);
  }
  const int column = table.find("pressure");
  if (column >= 0) return checked(table, column, input::numbers(table, "pressure", "Pa", diagnostics), diagnostics);
  if (!table.columns.empty())
    diagnostics.error({table.file, table.columns[0].where.line, 1}, "there is no column of pressures",
                      "name one pressure_Pa, pressure_gf_per_cm2 or pressure_mmHg");
  return {};
}

bool same_name(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

input::Csv shipped_csv(std::string_view text, const std::string& name) {
  input::Csv table{.file = name, .columns = {}, .rows = {}};
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.empty() || line[0] == '#') continue;
    input::Csv::Row row{.line = number, .cells = {}, .columns = {}};
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.cells.push_back(cell);
    row.columns.assign(row.cells.size(), 1);
    if (!table.columns.empty()) {
      table.rows.push_back(std::move(row));
      continue;
    }
    for (const std::string& head : row.cells) table.columns.push_back({head, "", {name, number, 1}});
  }
  return table;
}

}  // namespace snug::postproc
