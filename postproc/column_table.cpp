#include "postproc/column_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cases/input/csv.hpp"
#include "cases/input/table_lines.hpp"
#include "cases/input/units.hpp"
#include "postproc/nodal_field.hpp"

namespace snug::postproc {

namespace {

bool is_node_head(const std::string& name) {
  static const std::set<std::string> names = {"node", "nodes", "node_number", "nodenumber", "node_no", "node_id", "nodeid", "node_label", "nnum"};
  return names.contains(input::plain_name(name));
}

/// Ansys' label for what a column is called; the name in capitals where nothing is known.
std::string label_of(const std::string& name) {
  static const std::map<std::string, std::string> labels = {
      {"total_deformation", "USUM"}, {"u_sum", "USUM"}, {"u_magnitude", "USUM"}, {"displacement_magnitude", "USUM"}, {"total_displacement", "USUM"},
      {"u_u1", "UX"}, {"u_u2", "UY"}, {"u_u3", "UZ"}, {"u1", "UX"}, {"u2", "UY"}, {"u3", "UZ"}, {"u_x", "UX"}, {"u_y", "UY"}, {"u_z", "UZ"},
      {"x_deformation", "UX"}, {"y_deformation", "UY"}, {"z_deformation", "UZ"},
      {"equivalent_(von_mises)_stress", "SEQV"}, {"equivalent_stress", "SEQV"}, {"von_mises_stress", "SEQV"}, {"s_mises", "SEQV"}, {"mises", "SEQV"},
      {"maximum_principal_stress", "S1"}, {"middle_principal_stress", "S2"}, {"minimum_principal_stress", "S3"}, {"stress_intensity", "SINT"},
      {"x_location", "X"}, {"y_location", "Y"}, {"z_location", "Z"}, {"x_coordinate", "X"}, {"y_coordinate", "Y"}, {"z_coordinate", "Z"}};
  const auto known = labels.find(input::plain_name(name));
  if (known != labels.end()) return known->second;
  std::string label = name;
  std::transform(label.begin(), label.end(), label.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return label;
}

std::string head_line(std::string_view text) {
  const std::string plain = input::plain_text(text.substr(0, std::min<std::size_t>(text.size(), 4096)));
  for (std::size_t begin = 0; begin < plain.size();) {
    const std::size_t end = std::min(plain.find('\n', begin), plain.size());
    const std::string line = plain.substr(begin, end - begin);
    if (line.find_first_not_of(" \t") != std::string::npos && line[line.find_first_not_of(" \t")] != '#') return line;
    begin = end + 1;
  }
  return {};
}

/// Size in SI of the unit of a column's head; 0 where it gives none.
double factor_of(const input::Csv::Column& column, const std::string& label, input::Diagnostics& diagnostics) {
  if (column.unit.empty()) return 0.0;
  const std::string due = unit_of(quantity_of(label));
  double factor = 0.0;
  if (!due.empty() && !input::unit_factor(column.unit, due, factor))
    diagnostics.error(column.where, fmt::format("[{}] of the column {} is not {}", column.unit, column.name, input::dimension_name(due)), "correct the unit in the head");
  return factor;
}

}  // namespace

std::optional<ListingTable> column_table(std::string_view text, const std::filesystem::path& file, input::Diagnostics& diagnostics) {
  const std::string head = head_line(text);
  const input::LineCells cells = input::cells_of(head, input::separator_of(head));
  if (cells.texts.size() < 2 || !is_node_head(input::head_of(cells.texts[0]).name)) return std::nullopt;
  const input::Csv csv = input::read_csv(file, diagnostics);
  ListingTable table;
  if (csv.columns.empty()) return table;
  std::vector<std::vector<double>> columns;
  const std::vector<double> nodes = input::numbers(csv, csv.columns[0].name, "", diagnostics);
  for (std::size_t c = 1; c < csv.columns.size(); ++c) {
    table.labels.push_back(label_of(csv.columns[c].name));
    table.factors.push_back(factor_of(csv.columns[c], table.labels.back(), diagnostics));
    columns.push_back(input::column_numbers(csv, c, diagnostics));
  }
  if (diagnostics.any()) return table;
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    const bool whole = nodes[r] >= 1.0 && nodes[r] < 2e9 && nodes[r] == std::floor(nodes[r]);
    if (!whole) {
      diagnostics.error(csv.place(r, 0), fmt::format("\"{}\" is no node number", csv.rows[r].cells[0]), "nodes count from 1");
      return table;
    }
    table.rows.push_back({.node = static_cast<int>(nodes[r]), .line = csv.rows[r].line});
    for (const auto& column : columns) table.values.push_back(column[r]);
  }
  table.closed = true;
  return table;
}

}  // namespace snug::postproc
