#include "materials/fabric/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/csv.hpp"
#include "cases/input/units.hpp"

namespace snug::materials {

namespace {

using input::InputError;

constexpr std::size_t most_knots = 40;
constexpr double gf_per_cm = 0.980665;  // N/m

/// The largest index of the loading branch.
std::size_t end_of_loading(const std::vector<CurvePoint>& points) {
  return std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.force < b.force; }) - points.begin();
}

/// Forces that never fall, nearest in the mean square: adjacent violators are pooled (Barlow et al., Statistical Inference under Order
/// Restrictions, 1972, sec. 1.2). Points of the same strain are one.
std::vector<CurvePoint> rising(const std::vector<CurvePoint>& points) {
  struct Pool {
    double strain, force, count;
  };
  std::vector<Pool> pools;
  for (const CurvePoint& point : points) {
    pools.push_back({point.strain, point.force, 1.0});
    while (pools.size() > 1 && (pools.back().force <= pools[pools.size() - 2].force || pools.back().strain <= pools[pools.size() - 2].strain)) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& into = pools.back();
      const double count = into.count + last.count;
      into = {(into.strain * into.count + last.strain * last.count) / count, (into.force * into.count + last.force * last.count) / count, count};
    }
  }
  std::vector<CurvePoint> result;
  for (const Pool& pool : pools) result.push_back({pool.strain, pool.force});
  return result;
}

/// As many as describe a curve: means of neighbours, the last point kept.
std::vector<CurvePoint> thinned(const std::vector<CurvePoint>& points) {
  if (points.size() <= most_knots) return points;
  std::vector<CurvePoint> few;
  for (std::size_t k = 0; k + 1 < most_knots; ++k) {
    const std::size_t begin = k * (points.size() - 1) / (most_knots - 1), end = (k + 1) * (points.size() - 1) / (most_knots - 1);
    CurvePoint mean;
    for (std::size_t p = begin; p < end; ++p) mean.strain += points[p].strain / static_cast<double>(end - begin), mean.force += points[p].force / static_cast<double>(end - begin);
    few.push_back(mean);
  }
  few.push_back(points.back());
  return few;
}

/// The first of these names that the table has, or -1.
int column_of(const input::Csv& csv, const std::vector<std::string>& names) {
  for (const std::string& name : names)
    if (const int column = csv.find(name); column >= 0) return column;
  return -1;
}

/// The column in SI, times `scale` where its unit is that of `si`, or as it is where it is that of `other`.
std::vector<double> column_in(const input::Csv& csv, int column, const std::string& si, double scale, const std::string& other, const char* key,
                              input::Diagnostics& diagnostics) {
  const input::Csv::Column& head = csv.columns[column];
  double factor = 1.0;
  if (input::unit_factor(head.unit, other, factor)) return input::numbers(csv, head.name, other, diagnostics);
  std::vector<double> values = input::numbers(csv, head.name, si, diagnostics);
  if (!values.empty() && !(scale > 0.0))
    diagnostics.error(head.where, fmt::format("{} is {} here", head.name, input::dimension_name(si)), fmt::format("add {} to the fabric in case.toml, e.g. {} = \"{}\"", key, key, "50 mm"));
  for (double& value : values) value *= scale > 0.0 ? 1.0 / scale : 1.0;
  return values;
}

std::vector<CurvePoint> points_of(const std::filesystem::path& file, double width, double gauge_length) {
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  diagnostics.throw_if_any();
  const int relative = column_of(csv, {"strain", "tensile_strain", "elongation", "extension_strain", "engineering_strain", "nominal_strain", "e"});
  const int absolute = column_of(csv, {"extension", "displacement", "crosshead", "elongation_length"});
  const int strain = relative >= 0 ? relative : absolute;
  const int force = column_of(csv, {"force", "load", "tensile_force", "standard_force", "tension", "f"});
  if (strain < 0 || force < 0)
    throw InputError({csv.file, csv.columns[0].where.line, 1}, fmt::format("the table has no column {}", strain < 0 ? "strain or extension" : "force or load"),
                     "name them so, e.g. strain [%], force [N]");
  if (csv.columns[strain].unit.empty() && relative >= 0)
    throw InputError(csv.columns[strain].where, fmt::format("{} has no unit", csv.columns[strain].name), "write strain [%], or strain [1] where 1 is 100 %");
  const std::vector<double> strains = column_in(csv, strain, "m", gauge_length, "1", "gauge_length", diagnostics);
  const std::vector<double> forces = column_in(csv, force, "N", width, "N/m", "width", diagnostics);
  diagnostics.throw_if_any();
  std::vector<CurvePoint> points;
  for (std::size_t r = 0; r < strains.size(); ++r) points.push_back({strains[r], forces[r]});
  return points;
}

Fabric assembled(const TensionCurve& warp, const TensionCurve& weft, double shear, const Sheet& sheet) {
  Fabric fabric = LinearFabric{.warp = 1.0, .weft = 1.0, .shear = shear, .sheet = sheet}.fabric();
  fabric.warp = warp, fabric.weft = weft;
  fabric.coupling = sheet.poisson * std::min(warp.smallest_stiffness(), weft.smallest_stiffness());
  return fabric;
}

}  // namespace

TensionCurve curve_through(const std::vector<CurvePoint>& points, const input::Location& where) {
  const std::string form = "give elongations that rise from 0 and the force of each, two rows at least";
  if (points.size() < 2) throw InputError(where, fmt::format("the curve has {} points", points.size()), form);
  const std::size_t last = end_of_loading(points);
  std::vector<CurvePoint> loading(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  const double start_force = loading.front().force, start_strain = loading.front().strain;
  for (CurvePoint& point : loading)  // a pretension, and the slack that is taken up before it
    if (start_strain > 0.0 || start_force > 0.0) point.force = std::max(0.0, point.force - (start_strain > 0.0 ? 0.0 : start_force));
  if (start_strain > 0.0) loading.insert(loading.begin(), CurvePoint{});
  const std::vector<CurvePoint> knots = thinned(rising(loading));
  if (knots.size() < 2 || !(knots.back().strain > 0.0) || !(knots.back().force > 0.0))
    throw InputError(where, fmt::format("the force does not rise over the elongation ({} points up to the largest force)", loading.size()), form);
  std::vector<double> strain = {0.0}, force = {0.0};
  for (const CurvePoint& knot : knots)
    if (knot.strain > strain.back() && knot.force > force.back()) strain.push_back(knot.strain), force.push_back(knot.force);
  return TensionCurve::through(strain, force);
}

CurveFabric CurveFabric::with_points(const input::Location& where) const {
  CurveFabric full = *this;
  for (const auto& [key, file, points] : {std::tuple{"warp", &full.warp, &full.warp_points}, std::tuple{"weft", &full.weft, &full.weft_points}}) {
    if (file->empty() == points->empty())
      throw InputError(where, fmt::format("the curve of the {} is {}", key, points->empty() ? "missing" : "given twice"),
                       fmt::format("name a table, {0} = \"{0}.csv\", or give {0}_points", key));
    if (points->empty()) *points = points_of(*file, width.value_or(0.0), gauge_length.value_or(0.0));
    curve_through(*points, file->empty() ? where : input::Location{file->string(), 0, 0});
    file->clear();
  }
  full.width = full.gauge_length = std::nullopt;
  return full;
}

Fabric CurveFabric::fabric() const { return assembled(curve_through(warp_points, {}), curve_through(weft_points, {}), shear, sheet); }

std::vector<CurvePoint> FastTension::points() const {
  std::vector<CurvePoint> points = {{}};
  if (E5) points.push_back({*E5 / 100.0, 5.0 * gf_per_cm});
  if (E20) points.push_back({*E20 / 100.0, 20.0 * gf_per_cm});
  points.push_back({E100 / 100.0, 100.0 * gf_per_cm});
  return points;
}

Fabric FastFabric::fabric() const {
  return assembled(curve_through(tension.points(), {}), curve_through((weft ? *weft : tension).points(), {}), shear(), sheet);
}

input::Table with_forces_per_width(const input::Table& table, input::Diagnostics& diagnostics) {
  input::Table result = table;
  const input::Value* given = table.find("thickness");
  const input::Quantity thickness = given && given->text() ? input::to_si(*given->text(), "m") : input::Quantity{0.0, "missing"};
  for (const char* key : {"warp", "weft", "shear", "k1", "k3", "Fm"}) {
    input::Value* value = result.find(key);
    if (!value || !value->text()) continue;
    const input::Quantity stress = input::to_si(*value->text(), "Pa");
    if (!stress.ok()) continue;
    if (!thickness.ok() || !(thickness.value > 0.0))
      diagnostics.error(value->where, fmt::format("{} = \"{}\" is a stress", key, *value->text()), "give the thickness of the fabric too, or the force per width, e.g. \"500 gf/cm\"");
    else
      value->data = fmt::format("{} N/m", stress.value * thickness.value);
  }
  return result;
}

}  // namespace snug::materials
