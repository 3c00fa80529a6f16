// Nodal values against reference values: statistics of every column, the worst nodes, and where the extremes are.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "postproc/nodal_field.hpp"

namespace snug::postproc {

enum class Matching { automatic, by_number, by_coordinates };

/// What may differ. A column passes when no node differs by more than relative * scale + absolute; the scale is the
/// largest magnitude that the reference has in the columns of the same quantity (so that a component which should be
/// zero is measured against the displacement, not against its own rounding).
struct Tolerance {
  double relative = 0.0;
  double absolute = 0.0;  ///< m, Pa
};

/// Five digits are printed: half a unit of the last of them is at most 5e-5 of the value.
inline constexpr double printed_precision = 5e-5;

struct ComparisonOptions {
  Matching matching = Matching::automatic;
  Tolerance displacement{printed_precision, 0.0}, stress{printed_precision, 0.0}, other{printed_precision, 0.0};
  std::vector<std::string> columns;  ///< to compare; empty: every column of the reference
  std::optional<double> within;      ///< m, how far a node may lie from its counterpart; left out: see compare()
};

struct NodePlace {
  int node = 0;
  Eigen::Vector3d place = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());  ///< m; NaN: not known
  double value = 0.0;
};

struct WorstNode {
  NodePlace at;  ///< value: result minus reference
  double result = 0.0, reference = 0.0;
};

struct ColumnComparison {
  std::string label, unit;
  int compared = 0;
  int unknown = 0;                  ///< nodes at which the reference prints no number (************)
  double rms = 0.0, maximum = 0.0;  ///< of the difference; infinite where the result has no number
  double scale = 0.0, tolerance = 0.0;
  bool within = true;
  std::vector<WorstNode> worst;  ///< at most ten that differ, the worst first
  NodePlace result_minimum, result_maximum, reference_minimum, reference_maximum;
};

struct Comparison {
  std::string result, reference;  ///< names
  std::vector<std::string> notes; ///< what is to be known of either side
  std::string matching;           ///< how nodes were matched, in words
  int compared = 0;               ///< nodes
  int missing = 0;                ///< nodes to be compared that have no counterpart
  double largest_gap = 0.0;       ///< m, from a node to its counterpart, by coordinates
  std::vector<ColumnComparison> columns;
  NodalField difference;  ///< "UX result", "UX reference", "UX difference" a column, for write_columns
  /// Every column is within its tolerance and no node is missing.
  bool within() const;
};

/// Compares `result` with `reference`.
///
/// By number: nodes of the same number. By coordinates: where a side has cells, the other side's nodes are looked up
/// in them and values interpolated with the cells' shape functions (the result's cells, if both have some), invariants
/// from interpolated components; a node counts as missing when it lies farther from the cells than `within`, 5 % of the
/// size of the nearest cell if left out. Without cells a node's counterpart is the nearest node within `within`, 1e-4
/// of the diagonal of the reference if left out (coordinates are printed with five digits). Automatic: by number when
/// the coordinates of either side are unknown or those of equal numbers agree, else by coordinates.
///
/// Throws input::InputError: a column of the reference that the result lacks, no node in common, coordinates needed.
Comparison compare(const NodalField& result, const NodalField& reference, const ComparisonOptions& options = {});

/// Whose worst nodes are listed: those of columns outside their tolerance, or of all.
enum class Detail { outside, all };

/// Statistics and extremes of every column and the worst nodes, for a terminal.
std::string comparison_text(const Comparison& comparison, Detail detail = Detail::all);

}  // namespace snug::postproc
