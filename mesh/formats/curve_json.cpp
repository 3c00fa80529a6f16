#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "cases/input/suggestion.hpp"
#include "cases/input/units.hpp"
#include "mesh/formats/curve_set.hpp"
#include "mesh/formats/json_values.hpp"

namespace snug::mesh {

namespace {

using curves::BForm;
using curves::BSplineCurve;
using curves::BSplineSurface;
using curves::Net;
using input::Table;
using input::Value;

const std::string format_name = "snug curves";

/// Reads the values of one shape; what is wrong is collected, and the shape left out.
class Shape {
 public:
  Shape(const Table& table, double unit, input::Diagnostics& diagnostics, const std::vector<std::string>& keys)
      : table_(table), unit_(unit), diagnostics_(diagnostics) {
    for (const input::Entry& entry : table.entries)
      if (std::find(keys.begin(), keys.end(), entry.key) == keys.end())
        wrong(entry.where, fmt::format("\"{}\" is no key here", entry.key), input::did_you_mean(entry.key, keys));
  }

  bool good() const { return good_; }
  void wrong(const input::Location& where, const std::string& found, const std::string& remedy) {
    diagnostics_.error(where, found, remedy);
    good_ = false;
  }
  bool has(const std::string& key) const { return table_.find(key) != nullptr; }
  input::Location where(const std::string& key) const { return table_.where_is(key); }

  std::string name() {
    const Value* value = table_.find("name");
    if (!value) return {};
    if (const std::string* text = value->text()) return *text;
    wrong(value->where, fmt::format("the name is {}", value->description()), "write a text");
    return {};
  }
  int whole(const Value& value, int least, int most) {
    const long long* number = std::get_if<long long>(&value.data);
    if (number && *number >= least && *number <= most) return static_cast<int>(*number);
    wrong(value.where, value.description(), fmt::format("write a whole number from {} to {}", least, most));
    return least;
  }
  int whole(const std::string& key, int least, int most) {
    const Value* value = needed(key);
    return value ? whole(*value, least, most) : least;
  }
  /// A list, or an empty one that is reported.
  const std::vector<Value>& list(const Value& value) {
    static const std::vector<Value> none;
    if (const auto* found = value.array()) return *found;
    wrong(value.where, fmt::format("{} where a list is due", value.description()), "write [ … ]");
    return none;
  }
  const std::vector<Value>& list(const std::string& key) {
    static const std::vector<Value> none;
    const Value* value = needed(key);
    return value ? list(*value) : none;
  }
  double number(const Value& value) {
    double storage = 0.0;
    if (const double* found = value.number(storage); found && std::isfinite(*found)) return *found;
    wrong(value.where, fmt::format("{} where a number is due", value.description()), "write a bare number");
    return 0.0;
  }
  std::vector<double> numbers(const Value& value) {
    std::vector<double> all;
    for (const Value& one : list(value)) all.push_back(number(one));
    return all;
  }
  /// Points as columns, in m, each with `least` to `most` coordinates, all with the same number.
  Eigen::MatrixXd points(const std::vector<Value>& values, int least, int most) {
    Eigen::MatrixXd points(least, values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
      const std::vector<double> one = numbers(values[i]);
      const auto size = static_cast<int>(one.size());
      if (i == 0 && size >= least && size <= most) points.resize(size, Eigen::NoChange);
      if (size != points.rows()) {
        wrong(values[i].where, fmt::format("a point of {} coordinates", size),
              fmt::format("write {} numbers for every point", points.rows()));
        return points;
      }
      points.col(static_cast<Eigen::Index>(i)) = unit_ * Eigen::Map<const Eigen::VectorXd>(one.data(), size);
    }
    if (!points.allFinite() && !values.empty())
      wrong(values.front().where, "a point beyond all bounds", "write smaller numbers");
    return points;
  }
  /// Rows of equal length one behind the other; `columns` is that length.
  std::vector<Value> rows(const std::string& key, int& columns) {
    std::vector<Value> all;
    columns = 0;
    for (const Value& row : list(key)) {
      const std::vector<Value>& values = list(row);
      if (columns == 0) columns = static_cast<int>(values.size());
      if (static_cast<int>(values.size()) != columns)
        wrong(row.where, fmt::format("a row of {} after rows of {}", values.size(), columns),
              "write rows of one length");
      all.insert(all.end(), values.begin(), values.end());
    }
    return all;
  }
  Eigen::VectorXd weights(const std::vector<Value>& values) {
    Eigen::VectorXd weights(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) weights[static_cast<Eigen::Index>(i)] = number(values[i]);
    return weights;
  }

 private:
  const Value* needed(const std::string& key) {
    const Value* value = table_.find(key);
    if (!value) wrong(table_.where, fmt::format("\"{}\" is missing", key), fmt::format("add \"{}\"", key));
    return value;
  }

  const Table& table_;
  double unit_;
  input::Diagnostics& diagnostics_;
  bool good_ = true;
};

std::vector<double> bezier_knots(int degree) {
  std::vector<double> knots(degree + 1, 0.0);
  knots.resize(2 * degree + 2, 1.0);
  return knots;
}

std::optional<BSplineCurve> curve_of(Shape& from) {
  BSplineCurve curve{from.whole("degree", 1, curves::highest_degree), {}, from.points(from.list("points"), 2, 3), {}};
  curve.weights = from.has("weights") ? from.weights(from.list("weights"))
                                      : Eigen::VectorXd(Eigen::VectorXd::Ones(curve.points.cols()));
  curve.knots = bezier_knots(curve.degree);
  if (from.has("knots")) {
    curve.knots.clear();
    for (const Value& knot : from.list("knots")) curve.knots.push_back(from.number(knot));
  }
  if (!from.good()) return std::nullopt;
  if (const std::string fault = curve.fault(); !fault.empty())
    from.wrong(from.where(from.has("knots") ? "knots" : "points"), fault,
               "a curve of degree p with N points has N weights and N + p + 1 knots that do not fall");
  return curve;
}

std::optional<BSplineSurface> surface_of(Shape& from) {
  BSplineSurface surface;
  const std::vector<Value>& degrees = from.list("degrees");
  if (from.good() && degrees.size() != 2)
    from.wrong(from.where("degrees"), fmt::format("{} degrees", degrees.size()),
               "write two, along the rows' direction and along the rows");
  if (!from.good()) return std::nullopt;
  for (int side = 0; side < 2; ++side) {
    surface.degrees[side] = from.whole(degrees[side], 1, curves::highest_degree);
    surface.knots[side] = bezier_knots(surface.degrees[side]);
  }
  if (from.has("knots")) {
    const std::vector<Value>& knots = from.list("knots");
    if (knots.size() != 2) from.wrong(from.where("knots"), fmt::format("{} lists of knots", knots.size()), "write two");
    for (std::size_t side = 0; side < 2 && from.good(); ++side) surface.knots[side] = from.numbers(knots[side]);
  }
  int columns = 0, weight_columns = 0;
  const std::vector<Value> points = from.rows("points", columns);
  surface.points = from.points(points, 3, 3);
  surface.weights = from.has("weights") ? from.weights(from.rows("weights", weight_columns))
                                        : Eigen::VectorXd(Eigen::VectorXd::Ones(surface.points.cols()));
  if (!from.good()) return std::nullopt;
  std::string fault = surface.fault();
  if (fault.empty() && columns != surface.columns())
    fault = fmt::format("rows of {} points; the second knots go with {}", columns, surface.columns());
  if (fault.empty() && weight_columns != 0 && weight_columns != columns)
    fault = fmt::format("rows of {} weights for rows of {} points", weight_columns, columns);
  if (!fault.empty())
    from.wrong(from.where(from.has("knots") ? "knots" : "points"), fault,
               "degrees p and q with N rows of M points have N + p + 1 and M + q + 1 knots");
  return surface;
}

std::optional<Net> net_of(Shape& from) {
  Net net;
  const std::vector<Value> points = from.rows("points", net.columns);
  net.points = from.points(points, 3, 3);
  if (from.has("closed")) {
    const std::vector<Value>& closed = from.list("closed");
    for (std::size_t side = 0; side < closed.size(); ++side) {
      const bool* yes = std::get_if<bool>(&closed[side].data);
      if (!yes || closed.size() != 2) {
        from.wrong(closed[side].where, closed[side].description(),
                   "write two of true and false, for the rows' direction and along the rows");
        return std::nullopt;
      }
      (side == 0 ? net.rows_closed : net.columns_closed) = *yes;
    }
  }
  if (!from.good()) return std::nullopt;
  net.rows = net.columns == 0 ? 0 : static_cast<int>(points.size()) / net.columns;
  if (net.rows < (net.rows_closed ? 3 : 2) || net.columns < (net.columns_closed ? 3 : 2))
    from.wrong(from.where("points"), fmt::format("a net of {} by {}", net.rows, net.columns),
               "a direction has two points, a closed one three at least");
  return net;
}

std::optional<BForm> form_of(Shape& from) {
  const int corners = from.whole("corners", 2, 16), degree = from.whole("degree", 1, curves::highest_degree);
  const std::vector<Value>& values = from.list("points");
  const Eigen::MatrixXd points = from.points(values, 3, 3);
  if (!from.good()) return std::nullopt;
  try {
    return BForm(corners, degree, points);
  } catch (const std::invalid_argument& error) {
    from.wrong(from.where("points"), error.what(), "write them by the multi-index, its first part falling first");
    return std::nullopt;
  }
}

template <class Kind>
void read_all(const Table& root, const char* key, const std::vector<std::string>& keys, double unit,
              input::Diagnostics& diagnostics, std::optional<Kind> (*read)(Shape&), std::vector<Named<Kind>>& into) {
  const Value* value = root.find(key);
  if (!value) return;
  if (!value->array()) {
    diagnostics.error(value->where, fmt::format("\"{}\" is {}", key, value->description()), "write a list of tables");
    return;
  }
  for (const Value& one : *value->array()) {
    if (!one.table()) {
      diagnostics.error(one.where, fmt::format("{} among \"{}\"", one.description(), key), "write a table { … }");
      continue;
    }
    Shape shape(*one.table(), unit, diagnostics, keys);
    const std::string name = shape.name();
    std::optional<Kind> found = read(shape);
    if (found && shape.good()) into.push_back({name, std::move(*found)});
  }
}

double unit_of(const Table& root, input::Diagnostics& diagnostics) {
  const Value* value = root.find("unit");
  const input::Location where = value ? value->where : root.where;
  const std::string* text = value ? value->text() : nullptr;
  const input::Quantity unit = text ? input::to_si(*text, "m") : input::Quantity{};
  if (text && unit.ok() && unit.value > 0.0 && std::isfinite(unit.value)) return unit.value;
  diagnostics.error(where,
                    text ? fmt::format("the unit \"{}\" is no length", *text) : "the unit of the lengths is missing",
                    "write \"unit\": \"1 mm\" or another length");
  return 1.0;
}

}  // namespace

CurveSet parse_curve_json(const std::string& text, const std::string& shown_as) {
  const Value value = parse_json(text, shown_as);
  const Table* root = value.table();
  const Value* format = root ? root->find("format") : nullptr;
  if (!format || !format->text() || *format->text() != format_name)
    throw input::InputError(
        format ? format->where : input::Location{shown_as, 1, 1}, "no file of curves",
        fmt::format("begin with {{\"format\": \"{}\", \"unit\": \"1 mm\", \"curves\": [ … ]}}", format_name));
  input::Diagnostics diagnostics;
  const std::vector<std::string> keys = {"format", "unit", "curves", "surfaces", "nets", "forms"};
  for (const input::Entry& entry : root->entries)
    if (std::find(keys.begin(), keys.end(), entry.key) == keys.end())
      diagnostics.error(entry.where, fmt::format("\"{}\" is no key here", entry.key),
                        input::did_you_mean(entry.key, keys));
  const double unit = unit_of(*root, diagnostics);
  CurveSet set;
  read_all(*root, "curves", {"name", "degree", "knots", "points", "weights"}, unit, diagnostics, curve_of, set.curves);
  read_all(*root, "surfaces", {"name", "degrees", "knots", "points", "weights"}, unit, diagnostics, surface_of,
           set.surfaces);
  read_all(*root, "nets", {"name", "closed", "points"}, unit, diagnostics, net_of, set.nets);
  read_all(*root, "forms", {"name", "corners", "degree", "points"}, unit, diagnostics, form_of, set.forms);
  diagnostics.throw_if_any();
  return set;
}

}  // namespace snug::mesh
