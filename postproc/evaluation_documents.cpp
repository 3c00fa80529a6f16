// What the wearer feels, as JSON: rows of summary.json, comfort.json, and what snug score prints.
#include <stdexcept>

#include "postproc/evaluation_document.hpp"
#include "postproc/units.hpp"

namespace snug::postproc {
namespace {

Json location_json(const LocationRow& row) {
  Json json = {{"location", row.name},
               {"area_m2", row.area},
               {"coverage", row.coverage},
               {"mean_pressure_Pa", row.mean_pressure},
               {"max_pressure_Pa", row.max_pressure},
               {"pressures_of", row.pressures_of},
               {"mean_pressure_gf_per_cm2", to_gf_cm2(row.mean_pressure)},
               {"mean_pressure_mmHg", to_mmHg(row.mean_pressure)},
               {"rating", nullptr},
               {"term", nullptr}};
  if (row.trial_high > 0.0) json["trial_pressures_Pa"] = {row.trial_low, row.trial_high}, json["extrapolated"] = row.extrapolated;
  if (!row.rating) return json;
  json["rating"] = *row.rating;
  json["term"] = row.term;
  json["significant"] = row.significant;
  json["rating_error"] = row.rating_error;
  return json;
}

Json locations_json(const Evaluation& evaluation) {
  Json json = Json::array();
  for (const LocationRow& row : evaluation.locations) json.push_back(location_json(row));
  return json;
}

Json interval_json(const ScoreInterval& interval) {
  return {{"level", interval.level},
          {"low", interval.low},
          {"high", interval.high},
          {"standard_deviation", interval.deviation},
          {"samples", interval.samples},
          {"seed", interval.seed},
          {"without_scatter", interval.without_scatter}};
}

Json thresholds_json(const Evaluation& evaluation) {
  Json json = Json::array();
  for (const ThresholdRow& row : evaluation.thresholds)
    json.push_back(
        {{"set", row.set}, {"location", row.location}, {"pressure_Pa", row.pressure}, {"verdict", row.verdict}});
  return json;
}

/// Locations whose pressure lies outside the data behind their curve.
Json extrapolated_json(const Evaluation& evaluation) {
  Json json = Json::array();
  for (const LocationRow& row : evaluation.locations)
    if (row.extrapolated) json.push_back(row.name);
  return json;
}

// The keys of both are documented in docs/comfort.md; the report reads them.
Json no_comfort_json(const Evaluation& evaluation) {
  return {{"score", nullptr},
          {"term", "none"},
          {"reason", evaluation.no_score},
          {"curves", evaluation.curves},
          {"curves_source", evaluation.curves_source},
          {"extrapolated", extrapolated_json(evaluation)},
          {"thresholds", thresholds_json(evaluation)}};
}

Json comfort_json(const Evaluation& evaluation) {
  if (!evaluation.comfort) return no_comfort_json(evaluation);
  const Comfort& comfort = *evaluation.comfort;
  Json memberships = Json::array(), rules = Json::array(), output = Json::object();
  for (const LocationMembership& membership : comfort.memberships) {
    Json degrees = Json::object();
    for (std::size_t t = 0; t < comfort.sensation_terms.size(); ++t)
      degrees[comfort.sensation_terms[t]] = membership.degrees.at(t);
    memberships.push_back({{"location", membership.location}, {"rating", membership.rating}, {"degrees", degrees}});
  }
  for (const FiredRule& rule : comfort.rules)
    rules.push_back({{"rule", rule.rule}, {"then", rule.term}, {"strength", rule.strength}});
  for (const auto& [term, degree] : comfort.output_memberships) output[term] = degree;
  return {{"score", comfort.score},
          {"term", comfort.term},
          {"scale", comfort.scale},
          {"interval", comfort.interval ? interval_json(*comfort.interval) : Json()},
          {"curves", evaluation.curves},
          {"curves_source", evaluation.curves_source},
          {"fuzzy", comfort.system},
          {"extrapolated", extrapolated_json(evaluation)},
          {"left_out", comfort.left_out},
          {"inputs_without_rating", comfort.silent},
          {"thresholds", thresholds_json(evaluation)},
          {"memberships", memberships},
          {"rules", rules},
          {"output_memberships", output}};
}

Json sensors_json(const Evaluation& evaluation) {
  Json json = Json::array();
  for (const SensorRow& row : evaluation.sensors)
    json.push_back({{"name", row.name},
                    {"at_m", {row.at.x(), row.at.y(), row.at.z()}},
                    {"diameter_m", row.diameter},
                    {"thickness_m", row.thickness},
                    {"coverage", row.coverage},
                    {"skin_pressure_Pa", row.skin_pressure},
                    {"bulge_Pa", row.bulge},
                    {"tension_N_per_m", row.tension},
                    {"reading_Pa", row.reading()},
                    {"reading_mmHg", to_mmHg(row.reading())}});
  return json;
}

Json targets_json(const Evaluation& evaluation) {
  Json json = Json::array();
  for (const TargetRow& row : evaluation.targets)
    json.push_back({{"name", row.place}, {"wanted_Pa", row.wanted}, {"found_Pa", row.found}, {"found_over_wanted", row.found / row.wanted}});
  return json;
}

}  // namespace

void add_evaluation(Json& json, const Evaluation& evaluation) {
  json["locations"] = locations_json(evaluation);
  if (!evaluation.thresholds.empty()) json["thresholds"] = thresholds_json(evaluation);
  if (!evaluation.targets.empty()) json["targets"] = targets_json(evaluation);
  if (!evaluation.sensors.empty()) json["sensors"] = sensors_json(evaluation);
  json["comfort"] = nullptr;
  if (!evaluation.no_score.empty()) json["comfort"] = {{"score", nullptr}, {"term", "none"}, {"reason", evaluation.no_score}};
  if (!evaluation.comfort) return;
  json["comfort"] = {{"score", evaluation.comfort->score}, {"term", evaluation.comfort->term}};
  if (evaluation.comfort->interval) json["comfort"]["interval"] = interval_json(*evaluation.comfort->interval);
}

bool judges(const Evaluation& evaluation) { return evaluation.comfort || !evaluation.no_score.empty() || !evaluation.thresholds.empty(); }

Json comfort_document(const Evaluation& evaluation) {
  if (!judges(evaluation)) throw std::logic_error("comfort_document: the evaluation judges nothing");
  return as_read(comfort_json(evaluation));
}

Json evaluation_document(const Evaluation& evaluation) {
  Json json = {
      {"locations", locations_json(evaluation)}, {"thresholds", thresholds_json(evaluation)}, {"comfort", nullptr}};
  if (evaluation.comfort || !evaluation.no_score.empty()) json["comfort"] = comfort_json(evaluation);
  return as_read(json);
}

std::string evaluation_json(const Evaluation& evaluation) { return text_of(evaluation_document(evaluation)); }

}  // namespace snug::postproc
