#include "postproc/evaluate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "postproc/comfort/curve_library.hpp"
#include "postproc/comfort/pressure_table.hpp"
#include "postproc/skin_pressure.hpp"

namespace snug::postproc {
namespace {

/// Entry n of a field that may be left out.
double entry(const std::vector<double>& field, std::size_t n) { return n < field.size() ? field[n] : 0.0; }

/// The values of a field; none where the result does not have it.
const std::vector<double>& values_of(const Fields& fields, const FieldName<double>& name) {
  static const std::vector<double> none;
  const std::vector<double>* values = fields.find(name);
  return values ? *values : none;
}

/// Mean over the cover and largest nodal value of a field of pressure.
struct Pressures {
  double covered = 0.0, force = 0.0, largest = 0.0;
  void add(double area, double pressure) {
    covered += area, force += area * pressure;
    largest = std::max(largest, pressure);
  }
};

/// A hem is a line load and no pressure of the location, unless there is nothing but hems.
LocationRow summarise(const BodyResult& body, int location, const std::vector<double>& areas) {
  LocationRow row;
  row.name = body.locations[location];
  Pressures all, inside;
  double largest = 0.0;  // beside hems
  const std::vector<double>&pressure = values_of(body.fields, field::contact_pressure), &coverage = values_of(body.fields, field::coverage),
                           &hem = values_of(body.fields, field::hem);
  const std::vector<double>& beside = body.fields.has(field::largest_inside) ? body.fields[field::largest_inside] : pressure;
  for (std::size_t n = 0; n < body.node_location.size(); ++n) {
    if (body.node_location[n] != location) continue;
    const double area = areas[n] * entry(coverage, n);
    row.area += areas[n];
    all.add(area, entry(pressure, n));
    if (entry(hem, n) == 0.0) inside.add(area, entry(pressure, n));
    if (area > 0.0) largest = std::max(largest, entry(beside, n));  // a facet over the garment's edge has nodes that bear nothing
  }
  if (row.area > 0) row.coverage = all.covered / row.area;
  const bool hem_only = all.covered > 0.0 && !(inside.covered > 0.0);
  if (inside.covered < all.covered) row.pressures_of = hem_only ? "hem" : "cover beside hems";
  const Pressures& told = hem_only ? all : inside;
  if (told.covered > 0.0) row.mean_pressure = told.force / told.covered;
  row.max_pressure = hem_only ? all.largest : largest;
  return row;
}

void rate_row(const SensationCurves& curves, LocationRow& row) {
  const SensationCurve* curve = curves.find(row.name);
  if (row.coverage <= 0 || !curve) return;
  const Rating rating = rate(*curve, row.mean_pressure);
  row.rating = rating.value;
  row.term = rating.term;
  row.significant = rating.significant;
  row.extrapolated = rating.extrapolated;
  row.rating_error = rating.error;
  row.degrees = rating.degrees;
}

std::vector<ThresholdRow> hold_against(const std::vector<SensationCurves>& sets, const std::vector<LocationRow>& rows) {
  std::vector<ThresholdRow> result;
  for (const SensationCurves& set : sets)
    for (const LocationRow& row : rows) {
      const std::string found = row.coverage > 0 ? verdict(set, row.name, row.mean_pressure) : std::string();
      if (!found.empty()) result.push_back({set.name, row.name, row.mean_pressure, found});
    }
  return result;
}

/// Comfort of the rated locations; none when no rule of the system speaks of them.
std::optional<Comfort> comfort_of(const std::vector<LocationRating>& ratings, const input::ComfortSpec& spec,
                                  const std::filesystem::path& directory) {
  std::vector<std::string> names;
  for (const LocationRating& rating : ratings) names.push_back(rating.location);
  const FuzzySystem system = load_fuzzy(spec.fuzzy, names, directory);
  try {
    return judge(ratings, system, {spec.samples, spec.seed});
  } catch (const std::invalid_argument& fault) {
    throw input::InputError(spec.fuzzy.where,
                            fmt::format("the fuzzy system \"{}\" cannot judge: {}", system.name, fault.what()),
                            fmt::format("name its inputs like the locations: {}", fmt::join(names, ", ")));
  }
}

}  // namespace

void add_sensation(Evaluation& evaluation, const input::ComfortSpec& comfort, const std::filesystem::path& directory) {
  const Evidence evidence = load_evidence(comfort, directory);
  evaluation.curves = evidence.curves.name;
  evaluation.curves_source = evidence.curves.source;
  evaluation.thresholds = hold_against(evidence.thresholds, evaluation.locations);
  std::vector<LocationRating> ratings;
  for (LocationRow& row : evaluation.locations) {
    rate_row(evidence.curves, row);
    if (row.rating) ratings.push_back({row.name, *row.rating, row.rating_error, row.degrees});
  }
  if (!ratings.empty()) evaluation.comfort = comfort_of(ratings, comfort, directory);
}

Evidence load_evidence(const input::ComfortSpec& comfort, const std::filesystem::path& directory) {
  Evidence evidence{load_curves(comfort.curves, directory), {}};
  for (const input::MaterialEntry& set : comfort.thresholds)
    evidence.thresholds.push_back(load_bands(set, directory));
  if (!comfort.fuzzy.name.empty()) load_fuzzy(comfort.fuzzy, {}, directory);
  return evidence;
}

Evaluation evaluate(const RunResult& run, const std::optional<input::ComfortSpec>& comfort,
                    const std::filesystem::path& directory) {
  const BodyResult& body = run.body;
  if (!body.fields.has(field::contact_pressure)) return {};  // the tier tells none
  const std::vector<double>* known = body.fields.find(field::skin_area);  // of the contact
  const std::vector<double> areas = known ? *known : nodal_areas(body.skin_facets, body.nodes.size(), nodes_now(body));
  Evaluation evaluation;
  for (std::size_t location = 0; location < body.locations.size(); ++location)
    evaluation.locations.push_back(summarise(body, static_cast<int>(location), areas));
  if (comfort && run.status == Status::converged) add_sensation(evaluation, *comfort, directory);
  return evaluation;
}

std::vector<LocationPressure> read_pressures(const std::filesystem::path& file) {
  input::Diagnostics diagnostics;
  const input::Csv table = input::read_csv(file, diagnostics);
  const std::vector<std::string> names = input::texts(table, "location", diagnostics);
  const std::vector<double> pressures = pressures_of(table, diagnostics);
  diagnostics.throw_if_any();
  std::vector<LocationPressure> result;
  for (std::size_t row = 0; row < names.size(); ++row) {
    const auto twice = [&](const LocationPressure& other) { return same_name(other.location, names[row]); };
    if (std::any_of(result.begin(), result.end(), twice))
      diagnostics.error(table.place(row, table.find("location")),
                        fmt::format("location '{}' a second time", names[row]),
                        "write one row a location, one file a garment");
    result.push_back({names[row], pressures[row]});
  }
  diagnostics.throw_if_any();
  return result;
}

Evaluation score(const std::vector<LocationPressure>& pressures, const input::ComfortSpec& comfort,
                 const std::filesystem::path& directory) {
  Evaluation evaluation;
  for (const auto& [location, pressure] : pressures) {
    LocationRow row;
    row.name = location;
    row.coverage = 1.0;
    row.mean_pressure = row.max_pressure = pressure;
    evaluation.locations.push_back(std::move(row));
  }
  add_sensation(evaluation, comfort, directory);
  if (!evaluation.comfort)
    throw input::InputError({}, "no location of the table has a sensation curve",
                            "use the names of the curves, such as \"Front thigh\" (snug list shows them)");
  return evaluation;
}

}  // namespace snug::postproc
