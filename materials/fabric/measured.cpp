#include "materials/fabric/measured.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/units.hpp"
#include "materials/fabric/raw_test.hpp"

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

std::vector<CurvePoint> points_of(const std::filesystem::path& file, double width, double gauge_length) {
  const auto remedy = [](const char* key) { return fmt::format("add {0} to the fabric in case.toml, e.g. {0} = \"50 mm\"", key); };
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  diagnostics.throw_if_any();
  std::vector<CurvePoint> points;
  for (const Sample& sample : tensile_test(csv, {width, gauge_length, remedy("width"), remedy("gauge_length")}).samples) points.push_back({sample.x, sample.y});
  for (std::size_t p = end_of_loading(points) + 1; p < points.size(); ++p)  // slack strips and offsets of the way back
    points[p] = {std::max(0.0, points[p].strain), std::max(0.0, points[p].force)};
  return points;
}

/// Several cycles in one table would become one curve that belongs to none of them.
void refuse_cycles(const std::vector<CurvePoint>& loading, const input::Location& where) {
  constexpr double noise = 0.1;  // of the largest strain
  double furthest = 0.0;
  for (const CurvePoint& point : loading) {
    furthest = std::max(furthest, point.strain);
    if (point.strain < furthest - noise * loading.back().strain)
      throw InputError(where, fmt::format("the elongation goes back from {:.3g} % to {:.3g} % before the force is largest", 100.0 * furthest, 100.0 * point.strain),
                       "give one cycle: the rows from rest to the largest force, and those back to rest");
  }
}

/// Of a second cycle behind the first it would not be said that it is left out.
void refuse_further_cycles(const std::vector<CurvePoint>& points, std::size_t turn, const input::Location& where) {
  constexpr double noise = 0.1;  // of the largest strain
  double least = points[turn].strain;
  for (std::size_t p = turn + 1; p < points.size(); ++p) {
    least = std::min(least, points[p].strain);
    if (least < (1.0 - noise) * points[turn].strain && points[p].strain > least + noise * points[turn].strain && points[p].force > noise * points[turn].force)
      throw InputError(where, fmt::format("behind the largest force the elongation falls to {:.3g} % and rises to {:.3g} % again", 100.0 * least, 100.0 * points[p].strain),
                       "give one cycle: the rows from rest to the largest force, and those back to rest");
  }
}

/// What a force counts from: a strip that is held under a pretension at no strain.
double pretension(const std::vector<CurvePoint>& points) { return points.front().strain > 0.0 ? 0.0 : std::max(0.0, points.front().force); }

Fabric assembled(const TensionCurve& warp, const TensionCurve& weft, double shear, const Sheet& sheet) {
  Fabric fabric = LinearFabric{.warp = 1.0, .weft = 1.0, .shear = shear, .sheet = sheet}.fabric();
  fabric.warp = warp, fabric.weft = weft;
  fabric.coupling = sheet.poisson * std::min(warp.smallest_stiffness(), weft.smallest_stiffness());
  return fabric;
}

/// Rest, and the knots that rise from there in strain and force.
std::vector<CurvePoint> from_rest(const std::vector<CurvePoint>& knots, double least_force) {
  std::vector<CurvePoint> rising = {{}};
  for (const CurvePoint& knot : knots)
    if (knot.strain > rising.back().strain && knot.force > rising.back().force && knot.force >= least_force) rising.push_back(knot);
  return rising;
}

std::vector<CurvePoint> loading_knots(const std::vector<CurvePoint>& points, const input::Location& where) {
  const std::string form = "give elongations that rise from 0 and the force of each, two rows at least";
  if (points.size() < 2) throw InputError(where, fmt::format("the curve has {} points", points.size()), form);
  const std::size_t last = end_of_loading(points);
  std::vector<CurvePoint> loading(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  refuse_cycles(loading, where);
  refuse_further_cycles(points, last, where);
  const double start_force = loading.front().force, start_strain = loading.front().strain;
  for (CurvePoint& point : loading)  // a pretension, and the slack that is taken up before it
    if (start_strain > 0.0 || start_force > 0.0) point.force = std::max(0.0, point.force - (start_strain > 0.0 ? 0.0 : start_force));
  if (start_strain > 0.0) loading.insert(loading.begin(), CurvePoint{});
  const std::vector<CurvePoint> knots = thinned(rising(loading));
  if (knots.size() < 2 || !(knots.back().strain > 0.0) || !(knots.back().force > 0.0))
    throw InputError(where, fmt::format("the force does not rise over the elongation ({} points up to the largest force)", loading.size()), form);
  return from_rest(knots, 0.0);
}

/// None where the force does not come back.
std::vector<CurvePoint> unloading_knots(const std::vector<CurvePoint>& points) {
  constexpr double at_rest = 0.02, first = 0.01;  // of the largest force
  const std::size_t turn = end_of_loading(points);
  const double offset = pretension(points), largest = points[turn].force - offset;
  std::vector<CurvePoint> back;
  for (std::size_t p = turn; p < points.size(); ++p) {
    back.push_back({points[p].strain, points[p].force - offset});
    if (back.back().force <= 0.0) break;
  }
  if (back.size() < 3 || back.back().force > at_rest * largest) return {};
  std::reverse(back.begin(), back.end());
  return from_rest(thinned(rising(back)), first * largest);
}

TensionCurve through(const std::vector<CurvePoint>& knots) {
  std::vector<double> strain, force;
  for (const CurvePoint& knot : knots) strain.push_back(knot.strain), force.push_back(knot.force);
  return TensionCurve::through(strain, force);
}

}  // namespace

TensionCurve curve_through(const std::vector<CurvePoint>& points, const input::Location& where) { return through(loading_knots(points, where)); }

std::optional<TensionCurve> unloading_curve_through(const std::vector<CurvePoint>& points) {
  const std::vector<CurvePoint> knots = unloading_knots(points);
  return knots.size() < 2 ? std::nullopt : std::optional(through(knots).continued_as(curve_through(points, {})));
}

std::vector<CurvePoint> knots_of(const std::vector<CurvePoint>& points, const input::Location& where) {
  std::vector<CurvePoint> knots = loading_knots(points, where);
  const std::vector<CurvePoint> back = unloading_knots(points);
  for (std::size_t k = back.size(); k-- > 0;)
    if (k + 1 < back.size()) knots.push_back(back[k]);  // the turn stands there already
  return knots;
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

std::optional<Fabric> CurveFabric::unloading_fabric() const {
  const auto along = unloading_curve_through(warp_points), across = unloading_curve_through(weft_points);
  if (!along || !across) return std::nullopt;
  return assembled(*along, *across, shear, sheet);
}

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
