#include "solver/app/size/population_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cases/input/units.hpp"
#include "postproc/comfort/curve_library.hpp"
#include "postproc/units.hpp"

namespace snug::app {

namespace {

using postproc::to_mmHg;

/// Where the pressures are wanted and what the body and the garment measure there.
struct Places {
  std::vector<std::string> names;
  std::vector<double> wanted, body_girths;
  std::vector<mesh::FitRow> rows;
  bool warp_along = true;
};

Places places_of(const PreparedCase& prepared, int garment) {
  const solver::LaplaceTable table(prepared, garment, *prepared.jobs.target);
  Places places;
  places.warp_along = prepared.meshes.garments[garment].fit.warp_along;
  for (std::size_t i = 0; i < table.places(); ++i) {
    const input::WantedPressure& wanted = prepared.jobs.target->pressures[i];
    places.names.push_back(wanted.location.empty() ? fmt::format("{:.4g} mm", 1e3 * *wanted.height) : wanted.location);
    places.wanted.push_back(wanted.pressure);
    places.body_girths.push_back(prepared.meshes.limb.girth(table.height(i)));
    places.rows.push_back(prepared.meshes.garments[garment].fit.at(table.height(i)));
  }
  return places;
}

/// A range with what it is called.
struct NamedRange {
  solver::PressureRange range;
  std::string name;
};

input::MaterialEntry set_named(const std::string& name) {
  input::MaterialEntry entry;
  entry.name = name;
  entry.where.file = "--class";
  return entry;
}

/// The class of a set that a pressure lies in at a place; none where the set does not speak of it.
std::optional<NamedRange> class_of(const postproc::SensationCurves& set, const std::string& place, double pressure) {
  for (const postproc::PressureBand& band : set.bands)
    if ((band.location.empty() || band.location == place) && pressure >= band.low && pressure <= band.high)
      return NamedRange{{band.low, band.high}, fmt::format("{} of {}", band.name, set.name)};
  return std::nullopt;
}

std::vector<NamedRange> ranges_of(const PopulationQuestion& question, const Places& places, const PreparedCase& prepared) {
  std::vector<postproc::SensationCurves> sets;
  if (!question.classes.empty()) sets.push_back(postproc::load_bands(set_named(question.classes), prepared.description.directory));
  else if (prepared.description.comfort)
    for (const input::MaterialEntry& set : prepared.description.comfort->thresholds) sets.push_back(postproc::load_bands(set, prepared.description.directory));
  std::vector<NamedRange> ranges;
  bool any = false;
  for (std::size_t i = 0; i < places.names.size(); ++i) {
    std::optional<NamedRange> found;
    for (const postproc::SensationCurves& set : sets)
      if (!found) found = class_of(set, places.names[i], places.wanted[i]);
    any |= found.has_value();
    ranges.push_back(found.value_or(NamedRange{{(1.0 - question.inside) * places.wanted[i], (1.0 + question.inside) * places.wanted[i]}, fmt::format("within {:g} %", 100.0 * question.inside)}));
  }
  if (!any && !question.classes.empty())
    throw input::InputError({"--class", 0, 0}, fmt::format("{:.2f} mmHg at {} is in no class of \"{}\"", to_mmHg(places.wanted.front()), places.names.front(), question.classes),
                            fmt::format("snug explain \"{}\" shows its classes; want a pressure inside one, at the location that it speaks of", question.classes));
  return ranges;
}

/// "220 mm +- 15 mm" in m. Throws input::InputError.
std::pair<double, double> distribution_of(const std::string& text) {
  std::size_t at = text.find("+-"), length = 2;
  if (at == text.npos) at = text.find("±"), length = std::string("±").size();
  const input::Quantity mean = input::to_si(text.substr(0, at), "m"), deviation = at == text.npos ? input::Quantity{0.0, "none"} : input::to_si(text.substr(at + length), "m");
  if (!mean.ok() || !deviation.ok() || !(mean.value > 0.0) || !(deviation.value > 0.0) || deviation.value > 0.3 * mean.value)
    throw input::InputError({"--population", 0, 0}, fmt::format("\"{}\" is no mean girth with its standard deviation", text), "write for example \"220 mm +- 15 mm\"");
  return {mean.value, deviation.value};
}

std::vector<solver::Wearer> wearers_of(const PopulationQuestion& question, const Places& places) {
  if (!question.girths.empty()) return solver::read_wearers(question.girths, places.names, places.body_girths);
  const auto [mean, deviation] = distribution_of(question.distribution);
  return solver::normal_wearers(mean, deviation, places.body_girths);
}

std::string girths_text(const std::vector<solver::Wearer>& wearers, const solver::WornPressure& place) {
  std::string text = fmt::format("  {:>10} {:>9} {:>8} {:>10} {:>8}\n", "percentile", "girth mm", "ease %", "Pa", "mmHg");
  for (const int percent : {5, 25, 50, 75, 95}) {
    const double girth = solver::girth_below(wearers, 0.01 * percent), pressure = place.at(girth, 1.0);
    text += fmt::format("  {:>10} {:>9.1f} {:>8.1f} {:>10.0f} {:>8.2f}\n", percent, 1e3 * girth, 100.0 * (place.garment_girth(1.0) / girth - 1.0), pressure, to_mmHg(pressure));
  }
  return text;
}

std::string sizes_text(const std::vector<solver::SizeRow>& rows) {
  std::string text = fmt::format("  {:>4} {:>8} {:>10} {:>16} {:>16} {:>7} {:>8}\n", "size", "factor", "garment mm", "wearers mm", "ease %", "worn %", "inside %");
  double worn = 0.0, inside = 0.0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const solver::SizeRow& row = rows[k];
    worn += row.worn, inside += row.inside;
    text += fmt::format("  {:>4} {:>8.4f} {:>10.1f} {:>16} {:>16} {:>7.1f} {:>8.1f}\n", k + 1, row.size, 1e3 * row.garment_girth,
                        fmt::format("{:.0f} to {:.0f}", 1e3 * row.from_girth, 1e3 * row.to_girth), fmt::format("{:.1f} to {:.1f}", 100.0 * row.from_ease, 100.0 * row.to_ease),
                        100.0 * row.worn, 100.0 * row.inside);
  }
  return text + fmt::format("  {:>4} {:>8} {:>10} {:>16} {:>16} {:>7.1f} {:>8.1f}\n", "all", "", "", "", "", 100.0 * worn, 100.0 * inside);
}

Json girths_json(const std::vector<solver::Wearer>& wearers, const solver::WornPressure& place) {
  Json json = Json::array();
  for (const int percent : {5, 25, 50, 75, 95}) {
    const double girth = solver::girth_below(wearers, 0.01 * percent);
    json.push_back({{"percentile", percent}, {"girth_m", girth}, {"ease", place.garment_girth(1.0) / girth - 1.0}, {"pressure_Pa", place.at(girth, 1.0)}});
  }
  return json;
}

Json sizes_json(const std::vector<solver::SizeRow>& rows) {
  Json json = Json::array();
  for (const solver::SizeRow& row : rows)
    json.push_back({{"factor", row.size}, {"garment_girth_m", row.garment_girth}, {"from_girth_m", row.from_girth}, {"to_girth_m", row.to_girth}, {"from_ease", row.from_ease},
                    {"to_ease", row.to_ease}, {"worn_share", row.worn}, {"inside_share", row.inside}});
  return json;
}

std::string sizes_csv(const std::vector<solver::SizeRow>& rows) {
  std::string text = "size,factor,garment_girth [mm],wearers_from [mm],wearers_to [mm],ease_from [%],ease_to [%],worn_share,inside_share\n";
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const solver::SizeRow& row = rows[k];
    text += fmt::format("{},{:.6f},{:.2f},{:.2f},{:.2f},{:.3f},{:.3f},{:.6f},{:.6f}\n", k + 1, row.size, 1e3 * row.garment_girth, 1e3 * row.from_girth, 1e3 * row.to_girth,
                        100.0 * row.from_ease, 100.0 * row.to_ease, row.worn, row.inside);
  }
  return text;
}

}  // namespace

void check_population(const PopulationQuestion& question, const PreparedCase& prepared, int garment) {
  if (!question.asked()) return;
  const Places places = places_of(prepared, garment);
  ranges_of(question, places, prepared);
  wearers_of(question, places);
}

PopulationAnswer population_answer(const PopulationQuestion& question, const FoundCut& found, int garment) {
  const PreparedCase& prepared = *found.prepared;
  const Places places = places_of(prepared, garment);
  const std::vector<solver::Wearer> wearers = wearers_of(question, places);
  std::vector<solver::WornPressure> worn;
  std::vector<solver::PressureRange> ranges;
  std::string text = "\nPopulation, by the law of Laplace from the last solution\n";
  const std::vector<NamedRange> named = ranges_of(question, places, prepared);
  for (std::size_t i = 0; i < places.names.size(); ++i) {
    worn.emplace_back(prepared.model.garments[garment], places.rows[i], places.warp_along, places.body_girths[i], found.rows[i].found);
    ranges.push_back(named[i].range);
    text += std::isfinite(named[i].range.high)
                ? fmt::format("  inside at {}: {:.2f} to {:.2f} mmHg, {}\n", places.names[i], to_mmHg(named[i].range.low), to_mmHg(named[i].range.high), named[i].name)
                : fmt::format("  inside at {}: from {:.2f} mmHg, {}\n", places.names[i], to_mmHg(named[i].range.low), named[i].name);
  }
  text += fmt::format("  the cut that was found, on girths at {}:\n", places.names.front()) + girths_text(wearers, worn.front());
  const std::vector<solver::SizeRow> rows = solver::size_table(wearers, worn, places.wanted, ranges, question.sizes);
  text += fmt::format("  {} sizes, girths at {}; everybody takes the one that comes nearest:\n", question.sizes, places.names.front()) + sizes_text(rows);
  return {text, sizes_csv(rows), {{"percentiles", girths_json(wearers, worn.front())}, {"sizes", sizes_json(rows)}}};
}

}  // namespace snug::app
