#include <fmt/format.h>

#include <cmath>

#include "postproc/comparison.hpp"

namespace snug::postproc {
namespace {

/// A coordinate that is zero but for round-off is written as zero.
double rounded(double coordinate) { return std::abs(coordinate) < 1e-9 ? 0.0 : coordinate; }

std::string place_text(const NodePlace& at) {
  if (at.node == 0) return "-";
  if (!at.place.allFinite()) return fmt::format("node {}", at.node);
  return fmt::format("node {} at ({:.4g}, {:.4g}, {:.4g}) m", at.node, rounded(at.place.x()), rounded(at.place.y()),
                     rounded(at.place.z()));
}

std::string head(const ColumnComparison& column) {
  return column.label + (column.unit.empty() ? "" : " [" + column.unit + "]");
}

std::string summary_table(const Comparison& comparison) {
  std::string text = fmt::format("\n  {:<14} {:>11} {:>11} {:>11} {:>11}\n", "difference of", "RMS", "maximum",
                                 "tolerance", "scale");
  for (const ColumnComparison& column : comparison.columns) {
    text += fmt::format("  {:<14} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g}  {}\n", head(column), column.rms,
                        column.maximum, column.tolerance, column.scale, column.within ? "within" : "OUTSIDE");
    if (column.unknown > 0)
      text += fmt::format("  {:<14} {} nodes not compared: the reference has no number there\n", "", column.unknown);
  }
  return text;
}

std::string extreme_line(const std::string& column, const char* name, const NodePlace& result,
                         const NodePlace& reference) {
  const std::string where = result.node == reference.node ? "at the same node" : place_text(reference);
  return fmt::format("  {:<14} {:<4} {:>12.5g}  {:<40} {:>12.5g}  {}\n", column, name, result.value,
                     place_text(result), reference.value, where);
}

std::string extremes_table(const Comparison& comparison) {
  std::string text = fmt::format("\n  {:<14} {:<4} {:>12}  {:<40} {:>12}\n", "extremes of", "", "result", "",
                                 "reference");
  for (const ColumnComparison& column : comparison.columns)
    text += extreme_line(head(column), "min", column.result_minimum, column.reference_minimum) +
            extreme_line("", "max", column.result_maximum, column.reference_maximum);
  return text;
}

std::string worst_table(const ColumnComparison& column) {
  if (column.worst.empty()) return fmt::format("\n  {}: no node differs\n", head(column));
  std::string text = fmt::format("\n  worst nodes of {:<10} {:>12} {:>12} {:>12}\n", head(column), "difference", "result",
                                 "reference");
  for (const WorstNode& node : column.worst)
    text += fmt::format("  {:<25} {:>12.4g} {:>12.5g} {:>12.5g}  {}\n", "", node.at.value, node.result, node.reference,
                        place_text(node.at));
  return text;
}

}  // namespace

std::string comparison_text(const Comparison& comparison, Detail detail) {
  std::string text = fmt::format("result     {}\nreference  {}\n{} nodes {}", comparison.result, comparison.reference,
                                 comparison.compared, comparison.matching);
  if (comparison.largest_gap > 0.0) text += fmt::format(", at most {:.2g} mm away", comparison.largest_gap * 1e3);
  if (comparison.missing > 0) text += fmt::format("; {} nodes have no counterpart", comparison.missing);
  for (const std::string& note : comparison.notes) text += fmt::format("\nnote       {}", note);
  text += '\n' + summary_table(comparison) + extremes_table(comparison);
  int kept_back = 0;
  for (const ColumnComparison& column : comparison.columns)
    if (detail == Detail::all || !column.within)
      text += worst_table(column);
    else if (!column.worst.empty())
      ++kept_back;
  if (kept_back > 0)
    text += fmt::format("\n  {} columns differ within their tolerance: their worst nodes are listed with --all\n", kept_back);
  return text + fmt::format("\n{}\n", comparison.within()      ? "within the tolerance"
                                      : comparison.missing > 0 ? "outside the tolerance: nodes without counterpart"
                                                               : "outside the tolerance");
}

}  // namespace snug::postproc
