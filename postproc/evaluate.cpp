#include "postproc/evaluate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
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

/// Force over cover, m2 and N.
struct Pressures {
  double covered = 0.0, force = 0.0;
  void add(double area, double normal_force) { covered += area, force += normal_force; }
};

/// Of a place: of all its cover, and of that beside the hems.
struct Cover {
  Pressures all, inside;
  void add(double area, double force, bool hem) {
    all.add(area, force);
    if (!hem) inside.add(area, force);
  }
  /// A hem is a line load and no pressure of the place, unless there is nothing but hems.
  bool hem_only() const { return all.covered > 0.0 && !(inside.covered > 0.0); }
  const Pressures& told() const { return hem_only() ? all : inside; }
};

/// From the points of the contact, each counting by the shares of the nodes about it, so that neither a place's border nor a hem's moves
/// from one row of nodes to the next. `share`: of a node's area that counts, 0 to 1.
template <class Share>
Cover cover_by_points(const RunResult& run, Share share) {
  Cover cover;
  for (const ContactSample& sample : run.samples) {
    if (sample.facet < 0 || !(sample.area > 0.0)) continue;
    const auto& facet = run.body.skin_facets[sample.facet];
    const std::array<double, 9> hats = hats_at(facet, sample.xi, sample.eta);
    double own = 0.0;
    for (std::size_t i = 0; i < facet.size(); ++i)
      if (facet[i] >= 0) own += hats[i] * share(static_cast<std::size_t>(facet[i]));
    if (own > 0.0) cover.add(own * sample.area, own * sample.force, sample.hem >= 0);
  }
  return cover;
}

/// The largest pressure is that of nodes that lie inside by half, of all where none does.
template <class Share>
LocationRow summarise(const std::string& name, const RunResult& run, const std::vector<double>& areas, Share share) {
  const BodyResult& body = run.body;
  LocationRow row;
  row.name = name;
  Cover cover;  // by nodes
  double inner = -1.0, any = 0.0, largest = 0.0;  // beside hems, and of all
  const std::vector<double>&pressure = values_of(body.fields, field::contact_pressure), &coverage = values_of(body.fields, field::coverage),
                           &hem = values_of(body.fields, field::hem);
  const std::vector<double>& beside = body.fields.has(field::largest_inside) ? body.fields[field::largest_inside] : pressure;
  for (std::size_t n = 0; n < areas.size(); ++n) {
    const double own = share(n) * areas[n];
    if (own == 0.0) continue;
    const double area = own * entry(coverage, n);
    row.area += own;
    cover.add(area, area * entry(pressure, n), entry(hem, n) != 0.0);
    largest = std::max(largest, entry(pressure, n));
    if (area <= 0.0) continue;  // a facet over the garment's edge has nodes that bear nothing
    any = std::max(any, entry(beside, n));
    if (share(n) >= 0.5) inner = std::max(inner, entry(beside, n));
  }
  if (row.area > 0) row.coverage = cover.all.covered / row.area;
  if (!run.samples.empty() && row.coverage > 0.0) cover = cover_by_points(run, share);
  if (cover.inside.covered < cover.all.covered) row.pressures_of = cover.hem_only() ? "hem" : "cover beside hems";
  if (const Pressures& told = cover.told(); told.covered > 0.0) row.mean_pressure = told.force / told.covered;
  row.max_pressure = cover.hem_only() ? largest : inner >= 0.0 ? inner : any;
  return row;
}

LocationRow of_location(std::size_t location, const RunResult& run, const std::vector<double>& areas) {
  return summarise(run.body.locations[location], run, areas, [&](std::size_t n) { return run.body.share_in(location, n); });
}

/// Mean edge of the skin's facets, m.
double mean_cell(const BodyResult& body, const std::vector<double>& areas) {
  double area = 0.0;
  for (const double one : areas) area += one;
  return body.skin_facets.empty() ? 0.0 : std::sqrt(area / static_cast<double>(body.skin_facets.size()));
}

/// Share of a node that counts round the body at a height: less the farther it is, none from a cell on.
double share_at(double height, double z, double cell) { return std::max(0.0, 1.0 - std::abs(z - height) / cell); }

LocationRow at_height(double height, const RunResult& run, const std::vector<double>& areas) {
  const BodyResult& body = run.body;
  const double cell = mean_cell(body, areas);
  return summarise(fmt::format("{:.4g} mm", 1e3 * height), run, areas, [&](std::size_t n) { return share_at(height, body.nodes[n].z(), cell); });
}

/// How much of a node's area lies in the locations of a name, 0 to 1.
double share_in_named(const BodyResult& body, const std::string& name, std::size_t node) {
  double share = 0.0;
  for (std::size_t l = 0; l < body.locations.size(); ++l)
    if (body.locations[l] == name) share += body.share_in(l, node);
  return share;
}

std::vector<double> skin_areas(const BodyResult& body) {
  const std::vector<double>* known = body.fields.find(field::skin_area);  // of the contact
  return known ? *known : nodal_areas(body.skin_facets, body.nodes.size(), nodes_now(body));
}

bool covered(const LocationRow& row) { return row.coverage > 0.0; }

void rate_row(const SensationCurves& curves, LocationRow& row) {
  const SensationCurve* curve = curves.find(row.name);
  if (!covered(row) || !curve) return;
  const Rating rating = rate(*curve, row.mean_pressure);
  row.significant = rating.significant;
  row.extrapolated = rating.extrapolated;
  row.trial_low = curve->low, row.trial_high = curve->high;
  if (row.extrapolated) return;
  row.rating = rating.value;
  row.term = rating.term;
  row.rating_error = rating.error;
  row.degrees = rating.degrees;
}

bool above_trial(const LocationRow& row) { return row.extrapolated && row.mean_pressure > row.trial_high; }

/// Why no score is made of the rows; empty where one can be.
std::string why_no_score(const std::vector<LocationRow>& rows, const std::string& curves) {
  std::vector<std::string> above;
  for (const LocationRow& row : rows)
    if (above_trial(row)) above.push_back(fmt::format("{} ({:.0f} Pa, the trial ends at {:.0f})", row.name, row.mean_pressure, row.trial_high));
  if (!above.empty()) return fmt::format("more pressure than anybody was asked about: {}", fmt::join(above, ", "));
  if (std::any_of(rows.begin(), rows.end(), [](const LocationRow& row) { return row.rating.has_value(); })) return {};
  if (std::none_of(rows.begin(), rows.end(), covered)) return "the garment presses on no location";
  const bool below = std::any_of(rows.begin(), rows.end(), [](const LocationRow& row) { return row.extrapolated; });
  return below ? "every covered location with a curve is below the pressures of the trial" : fmt::format("no covered location has a curve in \"{}\"", curves);
}

std::vector<ThresholdRow> hold_against(const std::vector<SensationCurves>& sets, const std::vector<LocationRow>& rows) {
  std::vector<ThresholdRow> result;
  for (const SensationCurves& set : sets)
    for (const LocationRow& row : rows) {
      const std::string found = covered(row) ? verdict(set, row.name, row.mean_pressure) : std::string();
      if (!found.empty()) result.push_back({set.name, row.name, row.mean_pressure, found});
    }
  return result;
}

/// Both sides of a place are one question of the trial: the worse one is the answer.
void add_rating(const LocationRow& row, const SensationCurves& curves, std::vector<LocationRating>& ratings) {
  const SensationCurve* curve = curves.find(row.name);
  const LocationRating one{!curve || same_name(curve->location, row.name) ? row.name : curve->location, *row.rating, row.rating_error, row.degrees};
  const auto same = std::find_if(ratings.begin(), ratings.end(), [&](const LocationRating& other) { return same_name(other.location, one.location); });
  if (same == ratings.end()) ratings.push_back(one);
  else if (one.rating > same->rating) *same = one;
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
  if (evidence.curves.curves.empty()) return;  // thresholds alone
  std::vector<LocationRating> ratings;
  for (LocationRow& row : evaluation.locations) {
    rate_row(evidence.curves, row);
    if (row.rating) add_rating(row, evidence.curves, ratings);
  }
  evaluation.no_score = why_no_score(evaluation.locations, evidence.curves.name);
  if (evaluation.no_score.empty()) evaluation.comfort = comfort_of(ratings, comfort, directory);
}

Evidence load_evidence(const input::ComfortSpec& comfort, const std::filesystem::path& directory) {
  Evidence evidence;
  if (comfort.curves.name != "none") evidence.curves = load_curves(comfort.curves, directory);
  for (const input::MaterialEntry& set : comfort.thresholds)
    evidence.thresholds.push_back(load_bands(set, directory));
  if (!comfort.fuzzy.name.empty()) load_fuzzy(comfort.fuzzy, {}, directory);
  return evidence;
}

/// Each state of a movement is an answer, wherever the movement ends.
static MovementRating rating_of(const MovementState& state, const std::optional<input::ComfortSpec>& comfort, const std::filesystem::path& directory) {
  Evaluation one;
  one.locations = state.locations;
  if (comfort) add_sensation(one, *comfort, directory);
  return {std::move(one.locations), std::move(one.comfort), std::move(one.no_score)};
}

Evaluation evaluate(const RunResult& run, const std::optional<input::ComfortSpec>& comfort,
                    const std::filesystem::path& directory) {
  const BodyResult& body = run.body;
  if (!body.fields.has(field::contact_pressure)) return {};  // the tier tells none
  const std::vector<double> areas = skin_areas(body);
  Evaluation evaluation;
  for (std::size_t location = 0; location < body.locations.size(); ++location)
    evaluation.locations.push_back(of_location(location, run, areas));
  if (comfort && run.status == Status::converged) add_sensation(evaluation, *comfort, directory);
  for (const MovementState& state : run.movement) evaluation.movement.push_back(rating_of(state, comfort, directory));
  return evaluation;
}

std::vector<double> counted_areas(const BodyResult& body, const input::WantedPressure& wanted) {
  std::vector<double> areas = skin_areas(body);
  const double cell = mean_cell(body, areas);
  for (std::size_t n = 0; n < areas.size(); ++n) areas[n] *= wanted.height ? share_at(*wanted.height, body.nodes[n].z(), cell) : share_in_named(body, wanted.location, n);
  return areas;
}

std::vector<TargetRow> target_rows(const RunResult& run, const std::vector<LocationRow>& locations, const input::TargetSpec& target) {
  std::vector<TargetRow> rows;
  if (run.status != Status::converged) return rows;
  const std::vector<double> areas = skin_areas(run.body);
  for (const input::WantedPressure& wanted : target.pressures) {
    const auto known = std::find_if(locations.begin(), locations.end(), [&](const LocationRow& row) { return row.name == wanted.location; });
    const LocationRow row = !wanted.height && known != locations.end() ? *known : at_height(wanted.height.value_or(0.0), run, areas);
    rows.push_back({row.name, wanted.pressure, row.mean_pressure});
  }
  return rows;
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
    row.coverage = pressure > 0.0 ? 1.0 : 0.0;  // without pressure there is no garment
    row.mean_pressure = row.max_pressure = pressure;
    evaluation.locations.push_back(std::move(row));
  }
  add_sensation(evaluation, comfort, directory);
  const bool spoken_of = std::any_of(evaluation.locations.begin(), evaluation.locations.end(), [](const LocationRow& row) { return row.trial_high > 0.0 || !covered(row); });
  if (!spoken_of && evaluation.thresholds.empty())
    throw input::InputError({}, "no location of the table has a sensation curve",
                            "use the names of the curves, such as \"Front thigh\" (snug list shows them)");
  return evaluation;
}

}  // namespace snug::postproc
