#include <fmt/format.h>

#include "postproc/comparison.hpp"

namespace snug::postproc {
namespace {

std::string place_text(const NodePlace& at) {
  if (at.node == 0) return "-";
  if (!at.place.allFinite()) return fmt::format("node {}", at.node);
  return fmt::format("node {} at {:.5g} {:.5g} {:.5g} m", at.node, at.place.x(), at.place.y(), at.place.z());
}

std::string extremes_line(const char* name, const NodePlace& result, const NodePlace& reference) {
  return fmt::format("    {:<8} result {:.5g} {}; reference {:.5g} {}{}\n", name, result.value, place_text(result),
                     reference.value, place_text(reference), result.node == reference.node ? "" : " (elsewhere)");
}

std::string column_text(const ColumnComparison& column) {
  std::string text = fmt::format("\n  {} {}\n", column.label, column.unit.empty() ? "" : "[" + column.unit + "]");
  text += extremes_line("minimum", column.result_minimum, column.reference_minimum);
  text += extremes_line("maximum", column.result_maximum, column.reference_maximum);
  if (column.worst.empty()) return text + "    no node differs\n";
  text += fmt::format("    {:>12} {:>13} {:>13}  worst nodes\n", "difference", "result", "reference");
  for (const WorstNode& node : column.worst)
    text += fmt::format("    {:>12.4g} {:>13.5g} {:>13.5g}  {}\n", node.at.value, node.result, node.reference,
                        place_text(node.at));
  return text;
}

}  // namespace

std::string comparison_text(const Comparison& comparison) {
  std::string text = fmt::format("result     {}\nreference  {}\n{} nodes {}", comparison.result, comparison.reference,
                                 comparison.compared, comparison.matching);
  if (comparison.largest_gap > 0.0) text += fmt::format(", at most {:.2g} mm away", comparison.largest_gap * 1e3);
  if (comparison.missing > 0) text += fmt::format("; {} nodes have no counterpart", comparison.missing);
  text += fmt::format("\n\n  {:<12} {:>4} {:>9} {:>11} {:>11} {:>11} {:>11}\n", "column", "", "nodes", "RMS", "maximum",
                      "scale", "tolerance");
  for (const ColumnComparison& column : comparison.columns) {
    text += fmt::format("  {:<12} {:>4} {:>9} {:>11.4g} {:>11.4g} {:>11.4g} {:>11.4g}  {}\n", column.label, column.unit,
                        column.compared, column.rms, column.maximum, column.scale, column.tolerance,
                        column.within ? "within" : "OUTSIDE");
    if (column.unknown > 0)
      text += fmt::format("  {:<12} {} nodes not compared: the reference has no number there\n", "", column.unknown);
  }
  for (const ColumnComparison& column : comparison.columns) text += column_text(column);
  return text + fmt::format("\n{}\n", comparison.within()      ? "within the tolerance"
                                      : comparison.missing > 0 ? "outside the tolerance: nodes without counterpart"
                                                               : "outside the tolerance");
}

}  // namespace snug::postproc
