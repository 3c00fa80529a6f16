#include "postproc/comfort/curve_library.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "cases/input/csv.hpp"
#include "cases/input/reader.hpp"
#include "cases/input/suggestion.hpp"
#include "postproc/comfort/curve_fit.hpp"
#include "postproc/comfort/curve_input.hpp"
#include "postproc/comfort/pressure_table.hpp"
#include "postproc/comfort/shipped_data.hpp"

namespace snug::postproc {
namespace {

namespace fs = std::filesystem;

constexpr double not_given = std::numeric_limits<double>::quiet_NaN();

using TableOf = std::function<input::Csv(const std::string& name, input::Diagnostics&)>;

// ---- shapes

void require(const CurveInput& from, bool given, const std::string& what, input::Diagnostics& diagnostics) {
  if (!given)
    diagnostics.error(from.where, fmt::format("the {} curve of {} has no {}", from.shape, from.location, what),
                      "add " + what);
}

CurveShape line_of(const CurveInput& from, input::Diagnostics& diagnostics) {
  require(from, from.intercept.has_value(), "intercept", diagnostics);
  require(from, from.slope.has_value(), "slope", diagnostics);
  return Line{from.intercept.value_or(0.0), from.slope.value_or(0.0)};
}

CurveShape polyline_of(const CurveInput& from, input::Diagnostics& diagnostics) {
  const auto& p = from.pressures;
  const bool grows = std::adjacent_find(p.begin(), p.end(), std::greater_equal<>()) == p.end();
  if (p.size() < 2 || p.size() != from.ratings.size() || !grows)
    diagnostics.error(from.where, fmt::format("the piecewise curve of {} has no proper corners", from.location),
                      "give pressures, two or more and growing, and as many ratings");
  return Polyline{p, from.ratings};
}

CurveShape logistic_of(const CurveInput& from, input::Diagnostics& diagnostics) {
  require(from, from.middle.has_value(), "middle", diagnostics);
  require(from, from.width.has_value(), "width", diagnostics);
  return Logistic{from.lowest.value_or(lowest_rating), from.highest.value_or(highest_rating), from.middle.value_or(0.0),
                  from.width.value_or(1.0)};
}

SensationCurve curve_of(const CurveInput& from, input::Diagnostics& diagnostics) {
  SensationCurve curve;
  curve.location = from.location;
  curve.shape = from.shape == "linear"      ? line_of(from, diagnostics)
                : from.shape == "piecewise" ? polyline_of(from, diagnostics)
                                            : logistic_of(from, diagnostics);
  curve.parameters = from.shape == "piecewise" ? std::max<int>(2, static_cast<int>(from.pressures.size())) : 2;
  curve.low = from.range[0];
  curve.high = from.range[1];
  if (!(curve.low < curve.high))
    diagnostics.error(from.where, fmt::format("the range of {} does not grow", from.location),
                      "write range = [\"LOW\", \"HIGH\"]");
  curve.points = from.points;
  curve.scatter = from.scatter.value_or(not_given);
  curve.mean_rating = from.mean_rating.value_or(not_given);
  curve.mean_scatter = from.mean_scatter.value_or(not_given);
  curve.p_value = from.p_value.value_or(not_given);
  curve.significant = !(curve.p_value >= significance_level);
  curve.r_squared = from.r_squared.value_or(not_given);
  curve.largest_residual = from.largest_residual.value_or(not_given);
  curve.slope_error = from.slope_error.value_or(not_given);
  curve.intercept_error = from.intercept_error.value_or(not_given);
  curve.mean_pressure = from.mean_pressure.value_or(0.0);
  const double spread = from.pressure_spread.value_or(0.0);
  curve.pressure_squares = spread * spread * std::max(0, curve.points - 1);
  if (!curve.significant && !std::isfinite(curve.mean_rating))
    diagnostics.error(from.where,
                      fmt::format("the curve of {} is not significant and has no mean_rating", from.location),
                      "add mean_rating, which is used in its place");
  return curve;
}

PressureBand band_of(const BandInput& from, input::Diagnostics& diagnostics) {
  if (!(from.from < from.to))
    diagnostics.error(from.where, fmt::format("the band {} does not grow", from.name), "write from below to");
  return {from.location, from.name, from.from, from.to};
}

/// Bands of one location must not overlap, or a pressure would have two names.
void order(std::vector<PressureBand>& bands, const std::string& file, input::Diagnostics& diagnostics) {
  std::stable_sort(bands.begin(), bands.end(), [](const auto& a, const auto& b) { return a.low < b.low; });
  for (std::size_t i = 0; i < bands.size(); ++i)
    for (std::size_t j = i + 1; j < bands.size(); ++j)
      if (same_name(bands[i].location, bands[j].location) && bands[j].low < bands[i].high)
        diagnostics.error({file, 0, 0}, fmt::format("the bands {} and {} overlap", bands[i].name, bands[j].name),
                          "keep one of them, or put them into files of their own");
}

SensationCurves read_set(const input::Table& table, const std::string& file, const TableOf& table_of) {
  input::Diagnostics diagnostics;
  const auto from = input::read<CurvesInput>(table, diagnostics);
  diagnostics.throw_if_any();
  SensationCurves set;
  if (!from.observations.empty()) {
    const input::Csv observed = table_of(from.observations, diagnostics);
    diagnostics.throw_if_any();
    set = fit_curves(observed, from.shape);
  }
  const bool rates = !from.curves.empty() || !from.observations.empty();
  const auto stated = [&](const std::string& text, const char* key, const char* example) {
    if (rates && text.empty())
      diagnostics.error(table.where, fmt::format("curves without {}", key), fmt::format("write {} = \"{}\", or that it is not known", key, example));
    return text.empty() ? std::string("not stated") : text;
  };
  set.name = from.name;
  set.source = from.source;
  set.patch = stated(from.patch, "patch", "5 cm2");
  set.population = stated(from.population, "population", "14 women, 20 to 31 years");
  set.notes = from.notes;
  for (const CurveInput& curve : from.curves) {
    if (set.find(curve.location))
      diagnostics.error(curve.where, fmt::format("a second curve of {}", curve.location), "keep one a location");
    set.curves.push_back(curve_of(curve, diagnostics));
  }
  for (const BandInput& band : from.bands) set.bands.push_back(band_of(band, diagnostics));
  order(set.bands, file, diagnostics);
  if (set.curves.empty() && set.bands.empty())
    diagnostics.error({file, 0, 0}, "the file has neither curves nor bands",
                      "add [[curves]], [[bands]] or observations = \"FILE.csv\"");
  diagnostics.throw_if_any();
  return set;
}

input::Csv shipped_table(const std::string& name, input::Diagnostics&) {
  return shipped_csv(shipped_text(name), "postproc/data/" + name);
}

SensationCurves read_file(const fs::path& file) {
  input::Diagnostics diagnostics;
  if (file.extension() == ".csv") {
    const input::Csv table = input::read_csv(file, diagnostics);
    diagnostics.throw_if_any();
    return fit_curves(table);
  }
  const input::Table table = input::parse_file(file, diagnostics);
  diagnostics.throw_if_any();
  return read_set(table, file.string(), [&](const std::string& name, input::Diagnostics& errors) {
    return input::read_csv(file.parent_path() / name, errors);
  });
}

SensationCurves read_inline(const input::MaterialEntry& reference, const fs::path& directory) {
  return read_set(reference.table, reference.where.file, [&](const std::string& name, input::Diagnostics& errors) {
    return input::read_csv(directory / name, errors);
  });
}

std::string names_of(const std::vector<SensationCurves>& sets, bool curves) {
  std::vector<std::string> names;
  for (const SensationCurves& set : sets)
    if (!(curves ? set.curves.empty() : set.bands.empty())) names.push_back('"' + set.name + '"');
  return input::joined(names);
}

input::InputError lacks(const input::MaterialEntry& reference, const std::string& found, bool curves) {
  const std::string files = curves ? "a TOML or CSV file" : "a TOML file";
  return {reference.where, found,
          fmt::format("there are {}, or write the path of {}", names_of(shipped_curves(), curves), files)};
}

}  // namespace

std::vector<SensationCurves> shipped_curves() {
  std::vector<SensationCurves> sets;
  for (const ShippedFile& file : shipped_files()) {
    if (!file.name.ends_with(".toml")) continue;
    const std::string shown = "postproc/data/" + std::string(file.name);
    input::Diagnostics diagnostics;
    const input::Table table = input::parse_text(std::string(file.text), {shown, 1, 1}, diagnostics);
    diagnostics.throw_if_any();
    sets.push_back(read_set(table, shown, shipped_table));
  }
  std::sort(sets.begin(), sets.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  return sets;
}

SensationCurves find_curves(const input::MaterialEntry& reference, const fs::path& directory) {
  if (reference.is_inline()) return read_inline(reference, directory);
  std::vector<SensationCurves> sets = shipped_curves();
  for (SensationCurves& set : sets)
    if (same_name(set.name, reference.name)) return std::move(set);
  const fs::path file = directory / reference.name;
  if (!reference.name.empty() && fs::is_regular_file(file)) return read_file(file);
  std::vector<std::string> names;
  for (const SensationCurves& set : sets) names.push_back('"' + set.name + '"');
  throw input::InputError(reference.where, fmt::format("there are no curves or bands \"{}\"", reference.name),
                          fmt::format("there are {}, or write the path of a TOML or CSV file", input::joined(names)));
}

SensationCurves load_curves(const input::MaterialEntry& reference, const fs::path& directory) {
  SensationCurves set = find_curves(reference, directory);
  if (set.curves.empty()) throw lacks(reference, fmt::format("\"{}\" has no sensation curves", set.name), true);
  return set;
}

SensationCurves load_bands(const input::MaterialEntry& reference, const fs::path& directory) {
  SensationCurves set = find_curves(reference, directory);
  if (set.bands.empty()) throw lacks(reference, fmt::format("\"{}\" has no pressure bands", set.name), false);
  return set;
}

}  // namespace snug::postproc
