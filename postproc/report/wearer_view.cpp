// Locations and comfort: what the garment means for the wearer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "postproc/report/view.hpp"
#include "postproc/units.hpp"

namespace snug::postproc::report {

namespace {

constexpr double rating_end = 4.0;

std::string percent(double share) { return fmt::format("{:.1f}", 100.0 * std::clamp(share, 0.0, 1.0)); }

std::string note_of(const Json& row) {
  std::string note;
  if (!row.value("significant", true) && std::isfinite(value_at(row, "rating"))) note = "the trial found no effect of pressure here; the rating is its mean";
  if (row.value("extrapolated", false)) note += std::string(note.empty() ? "" : "; ") + "outside the trial’s pressures, nobody was asked: no rating";
  if (row.value("pressures_of", "") == "hem") note += std::string(note.empty() ? "" : "; ") + "a hem: no pressure beside it";
  return note;
}

/// Marks of a scale written as "0 comfortable, 2 acceptable, 4 uncomfortable".
struct Scale {
  std::vector<std::pair<double, std::string>> marks;
  double share(double value) const {
    const double low = marks.front().first, high = marks.back().first;
    return high > low ? std::clamp((value - low) / (high - low), 0.0, 1.0) : 0.0;
  }
};

Scale scale_of(const Json& comfort) {
  Scale scale;
  std::istringstream text(comfort.value("scale", ""));
  for (std::string mark; std::getline(text, mark, ',');) {
    std::istringstream one(mark);
    double value = 0.0;
    if (one >> value) scale.marks.emplace_back(value, mark.substr(mark.find_first_not_of(' ')));
  }
  if (scale.marks.empty()) scale.marks = {{0.0, "0"}, {4.0, "4"}};
  return scale;
}

std::string listed(const Json& names) {
  std::string text;
  for (const Json& name : names) text += (text.empty() ? "" : ", ") + name.get<std::string>();
  return text;
}

Json interval_view(const Json& comfort, const Scale& scale) {
  const auto it = comfort.find("interval");
  if (it == comfort.end() || !it->is_object()) return nullptr;
  const double low = value_at(*it, "low"), high = value_at(*it, "high");
  if (!std::isfinite(low) || !std::isfinite(high)) return nullptr;
  return {{"from", fmt::format("{:.2f}", low)},
          {"to", fmt::format("{:.2f}", high)},
          {"from_percent", percent(scale.share(low))},
          {"width_percent", percent(scale.share(high) - scale.share(low))},
          {"level", fmt::format("{:.0f}", 100.0 * value_at(*it, "level"))},
          {"without_scatter", listed(it->value("without_scatter", Json::array()))}};
}

Json rules_view(const Json& comfort) {
  std::vector<Json> rules;
  for (const Json& rule : comfort.value("rules", Json::array())) rules.push_back(rule);
  std::stable_sort(rules.begin(), rules.end(),
                   [](const Json& a, const Json& b) { return value_at(a, "strength") > value_at(b, "strength"); });
  Json view = Json::array();
  for (const Json& rule : rules) {
    const double strength = value_at(rule, "strength");
    view.push_back({{"rule", rule.value("rule", "")},
                    {"strength", fmt::format("{:.3f}", strength)},
                    {"percent", percent(strength)},
                    {"weak", strength < 0.05}});
  }
  return view;
}

Json memberships_view(const Json& comfort) {
  Json rows = Json::array();
  for (const Json& membership : comfort.value("memberships", Json::array())) {
    Json degrees = Json::array();
    const Json given = membership.value("degrees", Json::object());
    for (const auto& [term, degree] : given.items())
      degrees.push_back(
          {{"value", fmt::format("{:.2f}", degree.get<double>())}, {"percent", percent(degree.get<double>())}});
    rows.push_back({{"location", membership.value("location", "")},
                    {"rating", fmt::format("{:.2f}", value_at(membership, "rating"))},
                    {"degrees", degrees}});
  }
  return rows;
}

Json terms_view(const Json& comfort) {
  Json terms = Json::array();
  if (comfort.contains("memberships") && !comfort["memberships"].empty()) {
    const Json degrees = comfort["memberships"][0].value("degrees", Json::object());
    for (const auto& [term, degree] : degrees.items()) terms.push_back({{"term", term}});
  }
  return terms;
}

}  // namespace

Json locations_view(const ShownRun& run) {
  Json rows = Json::array();
  for (const Json& row : run.summary.value("locations", Json::array())) {
    const auto shown = [&](const char* key, double factor = 1.0) { return number(factor * value_at(row, key)); };
    Json view = {{"location", row.value("location", "")},
                 {"area", shown("area_m2", 1e4)},
                 {"coverage", percent(value_at(row, "coverage"))},
                 {"mean_Pa", shown("mean_pressure_Pa")},
                 {"mean_gf", shown("mean_pressure_gf_per_cm2")},
                 {"mean_mmHg", shown("mean_pressure_mmHg")},
                 {"max_Pa", shown("max_pressure_Pa")},
                 {"note", note_of(row)}};
    const double rating = value_at(row, "rating");
    view["rated"] = std::isfinite(rating);
    view["unrated"] = row.value("extrapolated", false) ? "outside the trial" : "no curve or no cover";
    if (std::isfinite(rating)) {
      view["rating"] = fmt::format("{:.2f}", rating);
      const double error = value_at(row, "rating_error");
      view["error"] = std::isfinite(error) ? fmt::format("± {:.2f}", error) : "";
      view["percent"] = percent(rating / rating_end);
      view["term"] = row.value("term", "");
    }
    rows.push_back(view);
  }
  return rows;
}

Json thresholds_view(const ShownRun& run) {
  const Json& of = run.summary.contains("thresholds") || !run.comfort.is_object() ? run.summary : run.comfort;
  Json rows = Json::array();
  for (const Json& row : of.value("thresholds", Json::array()))
    rows.push_back({{"set", row.value("set", "")},
                    {"location", row.value("location", "")},
                    {"pressure", number(value_at(row, "pressure_Pa"))},
                    {"mmHg", number(to_mmHg(value_at(row, "pressure_Pa")))},
                    {"verdict", row.value("verdict", "")}});
  return rows;
}

Json profile_view(const ShownRun& run) {
  Json rows = Json::array();
  for (const char* key : {"pressure_profile", "targets"})
    for (const Json& row : run.summary.value(key, Json::array()))
      rows.push_back({{"name", row.value("name", "")},
                      {"wanted", number(value_at(row, "wanted_Pa"))},
                      {"found", number(value_at(row, "found_Pa"))},
                      {"mmHg", number(to_mmHg(value_at(row, "found_Pa")))},
                      {"share", fmt::format("{:.1f}", 100.0 * value_at(row, "found_over_wanted"))}});
  return rows;
}

Json sensors_view(const ShownRun& run) {
  Json rows = Json::array();
  for (const Json& row : run.summary.value("sensors", Json::array())) {
    const double bulge = value_at(row, "bulge_Pa");
    rows.push_back({{"name", row.value("name", "")},
                    {"diameter", number(1e3 * value_at(row, "diameter_m"))},
                    {"coverage", percent(value_at(row, "coverage"))},
                    {"skin", number(value_at(row, "skin_pressure_Pa"))},
                    {"bulge", std::isfinite(bulge) ? number(bulge) : "–"},
                    {"reading", number(value_at(row, "reading_Pa"))},
                    {"mmHg", number(value_at(row, "reading_mmHg"))}});
  }
  return rows;
}

Json comfort_view(const ShownRun& run) {
  const Json& comfort = run.comfort;
  const double score = comfort.is_object() ? value_at(comfort, "score") : std::nan("");
  if (!std::isfinite(score)) return nullptr;
  Json outputs = Json::array();
  const Json memberships = comfort.value("output_memberships", Json::object());
  for (const auto& [term, degree] : memberships.items())
    outputs.push_back({{"term", term},
                       {"value", fmt::format("{:.2f}", degree.get<double>())},
                       {"percent", percent(degree.get<double>())}});
  const Scale scale = scale_of(comfort);
  Json marks = Json::array();
  for (const auto& [value, name] : scale.marks) marks.push_back({{"name", name}, {"percent", percent(scale.share(value))}});
  return {{"score", fmt::format("{:.2f}", score)},
          {"percent", percent(scale.share(score))},
          {"scale", comfort.value("scale", "")},
          {"marks", marks},
          {"interval", interval_view(comfort, scale)},
          {"source", comfort.value("curves_source", "")},
          {"left_out", listed(comfort.value("left_out", Json::array()))},
          {"silent", listed(comfort.value("inputs_without_rating", Json::array()))},
          {"term", comfort.value("term", "")},
          {"curves", comfort.value("curves", "")},
          {"outputs", outputs},
          {"terms", terms_view(comfort)},
          {"memberships", memberships_view(comfort)},
          {"rules", rules_view(comfort)}};
}

}  // namespace snug::postproc::report
