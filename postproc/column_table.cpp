#include "postproc/column_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "cases/input/csv.hpp"
#include "cases/input/table_lines.hpp"
#include "cases/input/units.hpp"
#include "postproc/listing_numbers.hpp"
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
      {"total_deformation", "USUM"}, {"u_magnitude", "USUM"}, {"displacement_magnitude", "USUM"}, {"total_displacement", "USUM"},
      {"u_u1", "UX"}, {"u_u2", "UY"}, {"u_u3", "UZ"}, {"u1", "UX"}, {"u2", "UY"}, {"u3", "UZ"}, {"u_x", "UX"}, {"u_y", "UY"}, {"u_z", "UZ"},
      {"disp_x", "UX"}, {"disp_y", "UY"}, {"disp_z", "UZ"}, {"displacement_x", "UX"}, {"displacement_y", "UY"}, {"displacement_z", "UZ"},
      {"x_displacement", "UX"}, {"y_displacement", "UY"}, {"z_displacement", "UZ"}, {"magnitude", "USUM"}, {"u_sum", "USUM"},
      {"s_s11", "SX"}, {"s_s22", "SY"}, {"s_s33", "SZ"}, {"s_s12", "SXY"}, {"s_s23", "SYZ"}, {"s_s13", "SXZ"}, {"coord_coor1", "X"}, {"coord_coor2", "Y"}, {"coord_coor3", "Z"},
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

namespace {

/// What Abaqus writes before a node number: of one value in a table that is one.
bool tells_origin(const std::string& name) {
  static const std::set<std::string> names = {"frame", "step", "odb_name", "instance_name", "part_instance", "part_instance_name", "section_point", "increment"};
  return names.contains(input::plain_name(name));
}

/// The column of node numbers: named so, behind columns of Abaqus that tell where the values come from, or the first where it has no name
/// (as indices of data frames have none) and the others have labels that are known. -1: there is none.
int node_column(const std::vector<std::string>& heads) {
  std::size_t first = 0;
  while (first < heads.size() && tells_origin(input::head_of(heads[first]).name)) ++first;
  if (first < heads.size() && is_node_head(input::head_of(heads[first]).name)) return static_cast<int>(first);
  const bool nameless = heads.size() > 1 && heads[0].empty() &&
                        std::all_of(heads.begin() + 1, heads.end(), [](const std::string& head) { return !unit_of(quantity_of(label_of(input::head_of(head).name))).empty(); });
  return nameless ? 0 : -1;
}

/// Several frames or parts in one table have the same nodes.
void refuse_several(const input::Csv& csv, std::size_t column, input::Diagnostics& diagnostics) {
  for (std::size_t r = 1; r < csv.rows.size(); ++r)
    if (csv.rows[r].cells[column] != csv.rows[0].cells[column])
      return diagnostics.error(csv.place(r, column), fmt::format("the table has several of {}: \"{}\" and \"{}\"", csv.columns[column].name, csv.rows[0].cells[column], csv.rows[r].cells[column]),
                               "write a table of one of them");
}

bool is_rule(const std::vector<std::string>& words) { return words.size() == 1 && words[0].size() > 20 && words[0].find_first_not_of('-') == std::string::npos; }

}  // namespace

std::optional<ListingTable> field_report(std::string_view text, const std::string& shown_as, input::Diagnostics& diagnostics) {
  if (text.substr(0, 2000).find("Field Output Report") == text.npos) return std::nullopt;
  const std::string plain = input::plain_text(text);
  ListingTable table;
  std::vector<std::string> before, earlier;  // the two lines before: labels, and of what
  int number = 0;
  bool rows = false;
  for (std::size_t begin = 0; begin < plain.size(); ++number) {
    const std::size_t end = std::min(plain.find('\n', begin), plain.size());
    const std::vector<std::string> words = words_of(std::string_view(plain).substr(begin, end - begin));
    begin = end + 1;
    const input::Location where{shown_as, number + 1, 1};
    if (is_rule(words) && !earlier.empty() && is_node_head(earlier[0])) {
      if (table.closed) {
        diagnostics.error(where, "there is a second table: the nodes of several parts, or of several results", "write a report of one part, in one table");
        return table;
      }
      for (std::size_t w = 1; w < earlier.size(); ++w) table.labels.push_back(label_of(earlier[w])), table.factors.push_back(0.0);
      rows = table.closed = true;
    } else if (rows && words.size() != table.labels.size() + 1) {
      rows = false;
    } else if (rows) {
      const ListingNumber node = scan_number(words[0]);
      if (!node.integer || node.value < 1.0 || node.value > 2e9) {
        diagnostics.error(where, fmt::format("\"{}\" is no node number", words[0]), "nodes count from 1");
        return table;
      }
      table.rows.push_back({.node = static_cast<int>(node.value), .line = number + 1});
      for (std::size_t w = 1; w < words.size(); ++w) table.values.push_back(scan_number(words[w]).value);
    }
    earlier = std::move(before);
    before = words;
  }
  return table.closed ? std::optional(std::move(table)) : std::nullopt;
}

std::optional<ListingTable> column_table(std::string_view text, const std::filesystem::path& file, input::Diagnostics& diagnostics) {
  const std::string head = head_line(text);
  const input::LineCells cells = input::cells_of(head, input::separator_of(head));
  const int node = node_column(cells.texts);
  if (cells.texts.size() < 2 || node < 0) return std::nullopt;
  const input::Csv csv = input::read_csv(file, diagnostics);
  ListingTable table;
  if (csv.columns.empty()) return table;
  std::vector<std::vector<double>> columns;
  for (int c = 0; c < node; ++c) refuse_several(csv, static_cast<std::size_t>(c), diagnostics);
  const std::vector<double> nodes = input::column_numbers(csv, static_cast<std::size_t>(node), diagnostics);
  for (std::size_t c = static_cast<std::size_t>(node) + 1; c < csv.columns.size(); ++c) {
    table.labels.push_back(label_of(csv.columns[c].name));
    table.factors.push_back(factor_of(csv.columns[c], table.labels.back(), diagnostics));
    columns.push_back(input::column_numbers(csv, c, diagnostics));
  }
  if (diagnostics.any()) return table;
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    const bool whole = nodes[r] >= 1.0 && nodes[r] < 2e9 && nodes[r] == std::floor(nodes[r]);
    if (!whole) {
      diagnostics.error(csv.place(r, static_cast<std::size_t>(node)), fmt::format("\"{}\" is no node number", csv.rows[r].cells[static_cast<std::size_t>(node)]), "nodes count from 1");
      return table;
    }
    table.rows.push_back({.node = static_cast<int>(nodes[r]), .line = csv.rows[r].line});
    for (const auto& column : columns) table.values.push_back(column[r]);
  }
  table.closed = true;
  return table;
}

}  // namespace snug::postproc
