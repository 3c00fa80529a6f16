#include "postproc/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "postproc/field_cells.hpp"

namespace snug::postproc {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();
constexpr double share_of_cell = 0.05, share_of_box = 1e-4;
constexpr std::size_t worst_shown = 10;

/// Nodes and the values of both sides there.
struct Matched {
  std::string how;
  std::vector<int> nodes;
  std::vector<Eigen::Vector3d> places;
  NodalField result, reference;  ///< at `nodes`
  std::shared_ptr<const FieldCells> cells;
  int missing = 0;
  double largest_gap = 0.0;
};

double diagonal_of(const NodalField& field) {
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Eigen::Vector3d& x : field.places) {
    if (!x.allFinite()) continue;
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return (high - low).allFinite() ? (high - low).norm() : 0.0;
}

/// Index of each node of `of` in `in`, or -1. Both are in ascending order.
std::vector<int> indices_of(const std::vector<int>& of, const std::vector<int>& in) {
  std::vector<int> indices;
  auto at = in.begin();
  for (const int node : of) {
    at = std::lower_bound(at, in.end(), node);
    indices.push_back(at != in.end() && *at == node ? static_cast<int>(at - in.begin()) : -1);
  }
  return indices;
}

NodalField rows_of(const NodalField& field, const std::vector<int>& indices) {
  NodalField rows;
  for (const int n : indices) rows.nodes.push_back(field.nodes[n]);
  if (!field.places.empty())
    for (const int n : indices) rows.places.push_back(field.places[n]);
  for (const NodalColumn& column : field.columns) {
    NodalColumn& to = rows.columns.emplace_back(NodalColumn{column.label, {}, column.asked});
    for (const int n : indices) to.values.push_back(column.values[n]);
  }
  return rows;
}

bool same_places(const NodalField& a, const NodalField& b) {
  const std::vector<int> indices = indices_of(a.nodes, b.nodes);
  const double tolerance = share_of_box * diagonal_of(a);
  int common = 0;
  for (std::size_t n = 0; n < indices.size(); ++n) {
    if (indices[n] < 0) continue;
    const Eigen::Vector3d distance = a.places[n] - b.places[indices[n]];
    if (!distance.allFinite()) continue;
    if (distance.norm() > tolerance) return false;
    ++common;
  }
  return common > 0;
}

Matched match_by_number(const NodalField& result, const NodalField& reference) {
  const std::vector<int> found = indices_of(reference.nodes, result.nodes);
  std::vector<int> in_result, in_reference;
  for (std::size_t n = 0; n < found.size(); ++n) {
    if (found[n] < 0) continue;
    in_result.push_back(found[n]);
    in_reference.push_back(static_cast<int>(n));
  }
  Matched matched;
  matched.how = "by node number";
  matched.result = rows_of(result, in_result);
  matched.reference = rows_of(reference, in_reference);
  matched.nodes = matched.reference.nodes;
  matched.places = result.places.empty() ? matched.reference.places : matched.result.places;
  matched.missing = static_cast<int>(reference.nodes.size() - in_result.size());
  const bool all = in_result.size() == result.nodes.size();
  if (all) matched.cells = result.cells;
  return matched;
}

/// Values of `from` at the `points`, weighted as the places say.
NodalField interpolated(const NodalField& from, const std::vector<CellPlace>& places) {
  NodalField at;
  at.nodes.resize(places.size());
  for (const NodalColumn& column : from.columns) {
    NodalColumn& to = at.columns.emplace_back(NodalColumn{column.label, {}, column.asked});
    for (const CellPlace& place : places) {
      double value = 0.0;
      for (std::size_t n = 0; n < place.nodes.size(); ++n) value += place.weights[n] * column.values[place.nodes[n]];
      to.values.push_back(value);
    }
  }
  if (from.cells) set_invariants(at);
  return at;
}

std::vector<CellPlace> places_in(const NodalField& from, const std::vector<Eigen::Vector3d>& points) {
  if (!from.cells) return nearest_nodes(from, points);
  std::vector<CellPlace> places;
  for (const Eigen::Vector3d& point : points)
    places.push_back(point.allFinite() ? from.cells->place_of(point) : CellPlace{});
  return places;
}

Matched match_by_coordinates(const NodalField& result, const NodalField& reference, std::optional<double> within) {
  const bool look_up_result = !result.cells && reference.cells;  // only the reference has cells
  const NodalField& base = look_up_result ? result : reference;
  const NodalField& from = look_up_result ? reference : result;
  const std::vector<CellPlace> all = places_in(from, base.places);
  const double box = share_of_box * diagonal_of(reference);
  std::vector<CellPlace> kept;
  std::vector<int> indices;
  Matched matched;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const double allowed = within.value_or(from.cells ? std::max(share_of_cell * all[n].cell_size, box) : box);
    if (all[n].nodes.empty() || !(all[n].gap <= allowed)) continue;
    matched.largest_gap = std::max(matched.largest_gap, all[n].gap);
    kept.push_back(all[n]);
    indices.push_back(static_cast<int>(n));
  }
  NodalField at_base = rows_of(base, indices);
  matched.how = fmt::format(
      "by coordinates, {} at the nodes of the {}",
      from.cells ? "interpolated in the cells of the " + std::string(look_up_result ? "reference" : "result")
                 : "nearest node of the result",
      look_up_result ? "result" : "reference");
  matched.nodes = at_base.nodes;
  matched.places = at_base.places;
  matched.missing = static_cast<int>(all.size() - kept.size());
  if (matched.missing == 0) matched.cells = base.cells;
  NodalField other = interpolated(from, kept);
  matched.result = look_up_result ? std::move(at_base) : std::move(other);
  matched.reference = look_up_result ? std::move(other) : std::move(at_base);
  return matched;
}

/// Two listings of coordinates are compared column by column, like values.
NodalField with_coordinates_as_columns(NodalField field) {
  if (!field.places.empty())
    for (const auto& [label, axis] : {std::pair{"X", 0}, std::pair{"Y", 1}, std::pair{"Z", 2}}) {
      NodalColumn& column = field.columns.emplace_back(NodalColumn{label, {}});
      for (const Eigen::Vector3d& x : field.places) column.values.push_back(x[axis]);
    }
  return field;
}

Matched match(const NodalField& result, const NodalField& reference, const ComparisonOptions& options) {
  const bool places = !result.places.empty() && !reference.places.empty();
  Matching matching = options.matching;
  if (matching == Matching::by_coordinates && !places)
    throw input::InputError({(result.places.empty() ? result : reference).name, 0, 0},
                            "the coordinates of its nodes are not known",
                            "give them (NLIST, nodes.lis), or compare by number");
  if (matching == Matching::automatic)
    matching = !places || same_places(result, reference) ? Matching::by_number : Matching::by_coordinates;
  Matched matched = matching == Matching::by_number ? match_by_number(result, reference)
                                                    : match_by_coordinates(result, reference, options.within);
  if (matched.nodes.empty())
    throw input::InputError({reference.name, 0, 0},
                            fmt::format("none of its nodes has a counterpart in {} ({})", result.name, matched.how),
                            "look at numbers, coordinates and their unit (--length-unit)");
  return matched;
}

std::vector<std::string> columns_to_compare(const NodalField& result, const NodalField& reference,
                                            const ComparisonOptions& options) {
  std::vector<std::string> labels = options.columns, lacking;
  if (labels.empty())
    for (const NodalColumn& column : reference.columns)
      if (!column.asked) labels.push_back(column.label);
  for (const NodalField* field : {&result, &reference})
    for (const std::string& label : labels)
      if (!field->find(label)) {
        std::string known;
        for (const NodalColumn& column : field->columns) known += (known.empty() ? "" : ", ") + column.label;
        throw input::InputError({field->name, 0, 0}, fmt::format("it has no column {}", label),
                                fmt::format("it has {}; name those to compare with --columns", known));
      }
  return labels;
}

/// "shear_traction" of "shear_traction X".
std::string field_name(const std::string& label) { return label.substr(0, label.find(' ')); }

/// Largest magnitude of the reference in the columns of the same quantity; of a field that is asked for by name, in its own.
double scale_of(const NodalField& reference, const NodalColumn& of) {
  double scale = 0.0;
  const auto alike = [&](const NodalColumn& column) {
    if (of.asked || column.asked) return of.asked && column.asked && field_name(column.label) == field_name(of.label);
    return quantity_of(column.label) == quantity_of(of.label);
  };
  for (const NodalColumn& column : reference.columns)
    if (alike(column))
      for (const double value : column.values)
        if (std::isfinite(value)) scale = std::max(scale, std::abs(value));
  return scale;
}

/// The node at which `values` is smallest (sign = 1) or largest (sign = -1).
NodePlace extreme(const Matched& matched, const std::vector<double>& values, double sign) {
  NodePlace best{.value = no_value};
  for (std::size_t n = 0; n < values.size(); ++n) {
    if (!std::isfinite(values[n]) || (best.node > 0 && sign * values[n] >= sign * best.value)) continue;
    best.node = matched.nodes[n];
    best.value = values[n];
    if (!matched.places.empty()) best.place = matched.places[n];
  }
  return best;
}

const Tolerance& tolerance_of(const ComparisonOptions& options, Quantity quantity) {
  return quantity == Quantity::stress  ? options.stress
         : quantity == Quantity::other ? options.other
                                       : options.displacement;
}

ColumnComparison compare_column(const Matched& matched, const std::string& label, const ComparisonOptions& options,
                                std::vector<double>& difference) {
  const Quantity quantity = quantity_of(label);
  const std::vector<double>&result = matched.result.find(label)->values,
        &reference = matched.reference.find(label)->values;
  ColumnComparison column;
  column.label = label;
  const NodalColumn& compared = *matched.reference.find(label);
  column.unit = compared.asked ? std::string(meaning_of(field_name(label)).unit) : unit_of(quantity);
  column.scale = scale_of(matched.reference, compared);
  const Tolerance& tolerance = tolerance_of(options, quantity);
  column.tolerance = tolerance.relative * column.scale + tolerance.absolute;
  difference.assign(result.size(), no_value);
  double squares = 0.0;
  std::vector<std::size_t> differing;
  for (std::size_t n = 0; n < result.size(); ++n) {
    if (!std::isfinite(reference[n])) {
      ++column.unknown;
      continue;
    }
    ++column.compared;
    const double d = std::isfinite(result[n]) ? result[n] - reference[n] : std::numeric_limits<double>::infinity();
    difference[n] = d;
    squares += d * d;
    column.maximum = std::max(column.maximum, std::abs(d));
    if (d != 0.0) differing.push_back(n);
  }
  column.rms = column.compared > 0 ? std::sqrt(squares / column.compared) : no_value;
  column.within = column.compared > 0 && column.maximum <= column.tolerance;
  const std::size_t shown = std::min(worst_shown, differing.size());
  std::partial_sort(differing.begin(), differing.begin() + static_cast<std::ptrdiff_t>(shown), differing.end(),
                    [&](std::size_t a, std::size_t b) {
                      const double da = std::abs(difference[a]), db = std::abs(difference[b]);
                      return da != db ? da > db : a < b;
                    });
  for (std::size_t i = 0; i < shown; ++i) {
    const std::size_t n = differing[i];
    WorstNode& worst = column.worst.emplace_back();
    worst.at.node = matched.nodes[n];
    worst.at.value = difference[n];
    if (!matched.places.empty()) worst.at.place = matched.places[n];
    worst.result = result[n];
    worst.reference = reference[n];
  }
  column.result_minimum = extreme(matched, result, 1);
  column.result_maximum = extreme(matched, result, -1);
  column.reference_minimum = extreme(matched, reference, 1);
  column.reference_maximum = extreme(matched, reference, -1);
  return column;
}

/// Values of all columns a hundred times and more too large or too small: likely another unit.
std::string unit_hint(const Comparison& comparison) {
  struct Range {
    double low = std::numeric_limits<double>::max(), high = -low;
  };
  std::map<std::string, Range> powers;  // of ten, by unit
  for (const ColumnComparison& column : comparison.columns) {
    const auto largest = [](const NodePlace& low, const NodePlace& high) { return std::max(std::abs(low.value), std::abs(high.value)); };
    const double result = largest(column.result_minimum, column.result_maximum), reference = largest(column.reference_minimum, column.reference_maximum);
    if (column.unit.empty() || !(result > 0.0) || !(reference > 0.0) || reference < 1e-3 * column.scale) continue;
    Range& range = powers[column.unit];
    const double power = std::log10(reference / result);
    range = {std::min(range.low, power), std::max(range.high, power)};
  }
  for (const auto& [unit, range] : powers) {
    const double power = 0.5 * (range.low + range.high);
    if (range.high - range.low > 1.0 || (range.low < 1.8 && range.high > -1.8)) continue;
    const char* option = unit == "Pa" ? "--stress-unit" : "--length-unit";
    const char* example = unit == "Pa" ? (power < -4.5 ? "MPa" : power < 0.0 ? "kPa" : "Pa") : power > 2.4 ? "mm" : power > 0.0 ? "cm" : "m";
    return fmt::format("the values of the reference are about {:.0g} times those of the result: another unit? ({} {})", std::pow(10.0, power), option, example);
  }
  return {};
}

}  // namespace

bool Comparison::within() const {
  return missing == 0 && std::all_of(columns.begin(), columns.end(), [](const auto& column) { return column.within; });
}

Comparison compare(const NodalField& given_result, const NodalField& given_reference,
                   const ComparisonOptions& options) {
  const bool coordinates_only = given_reference.columns.empty();
  const NodalField result = coordinates_only ? with_coordinates_as_columns(given_result) : given_result;
  const NodalField reference = coordinates_only ? with_coordinates_as_columns(given_reference) : given_reference;
  const std::vector<std::string> labels = columns_to_compare(result, reference, options);
  const Matched matched = match(result, reference, options);
  Comparison comparison;
  comparison.result = result.name;
  comparison.reference = reference.name;
  comparison.matching = matched.how;
  for (const auto& [who, field] : {std::pair{"result", &result}, std::pair{"reference", &reference}})
    for (const std::string& note : field->notes) comparison.notes.push_back(fmt::format("{}: {}", who, note));
  comparison.compared = static_cast<int>(matched.nodes.size());
  comparison.missing = matched.missing;
  comparison.largest_gap = matched.largest_gap;
  NodalField& difference = comparison.difference;
  difference.nodes = matched.nodes;
  difference.places = matched.places;
  difference.cells = matched.cells;
  for (const std::string& label : labels) {
    std::vector<double> values;
    comparison.columns.push_back(compare_column(matched, label, options, values));
    difference.columns.push_back({label + " result", matched.result.find(label)->values});
    difference.columns.push_back({label + " reference", matched.reference.find(label)->values});
    difference.columns.push_back({label + " difference", std::move(values)});
  }
  if (const std::string hint = unit_hint(comparison); !hint.empty()) comparison.notes.push_back(hint);
  return comparison;
}

}  // namespace snug::postproc
