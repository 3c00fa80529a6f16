// Locations and comfort: what the garment means for the wearer.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

constexpr double scale_end = 4.0;  // of ratings and of the comfort score

std::string percent(double share) { return fmt::format("{:.1f}", 100.0 * std::clamp(share, 0.0, 1.0)); }

std::string note_of(const Json& row) {
  std::string note;
  if (!row.value("significant", true)) note = "the trial found no effect of pressure here; the rating is its mean";
  if (row.value("extrapolated", false)) note += std::string(note.empty() ? "" : "; ") + "outside the trial's pressures";
  return note;
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

/// Where the score may lie, as text and as places on the track of the gauge; null when the run did not sample it.
Json interval_view(const Json& comfort) {
  const Json interval = comfort.value("interval", Json());
  if (!interval.is_object()) return nullptr;
  const double low = value_at(interval, "low"), high = value_at(interval, "high");
  if (!std::isfinite(low) || !std::isfinite(high)) return nullptr;
  return {{"from", fmt::format("{:.2f}", low)},
          {"to", fmt::format("{:.2f}", high)},
          {"from_percent", percent(low / scale_end)},
          {"width_percent", percent((high - low) / scale_end)},
          {"meaning", fmt::format("{:.0f} % of draws about the curves", 100.0 * value_at(interval, "level"))}};
}

}  // namespace

Json locations_view(const RunFiles& run) {
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
    if (std::isfinite(rating)) {
      view["rating"] = fmt::format("{:.2f}", rating);
      view["percent"] = percent(rating / scale_end);
      view["term"] = row.value("term", "");
    }
    rows.push_back(view);
  }
  return rows;
}

Json comfort_view(const RunFiles& run) {
  const Json& comfort = run.comfort;
  const double score = comfort.is_object() ? value_at(comfort, "score") : std::nan("");
  if (!std::isfinite(score)) return nullptr;
  Json outputs = Json::array();
  const Json memberships = comfort.value("output_memberships", Json::object());
  for (const auto& [term, degree] : memberships.items())
    outputs.push_back({{"term", term},
                       {"value", fmt::format("{:.2f}", degree.get<double>())},
                       {"percent", percent(degree.get<double>())}});
  return {{"score", fmt::format("{:.2f}", score)}, {"percent", percent(score / scale_end)},
          {"term", comfort.value("term", "")},     {"curves", comfort.value("curves", "")},
          {"interval", interval_view(comfort)},    {"outputs", outputs},
          {"terms", terms_view(comfort)},          {"memberships", memberships_view(comfort)},
          {"rules", rules_view(comfort)}};
}

}  // namespace snug::postproc::report
