#include "postproc/report/compare_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "postproc/report/template.hpp"
#include "postproc/report/view.hpp"
#include "postproc/units.hpp"

namespace snug::postproc::report {

namespace {

/// Change against the first run, "+3.1 %".
std::string difference(double value, double first) {
  if (!std::isfinite(value) || !std::isfinite(first) || first == 0.0) return {};
  const double percent = 100.0 * (value - first) / std::abs(first);
  return fmt::format("{}{:.1f} %", percent < -0.05 ? "−" : percent > 0.05 ? "+" : "", std::abs(percent));
}

/// Counts wholly, other numbers to three digits.
std::string shown(double value) { return value == std::floor(value) ? plain(value) : number(value); }

/// A row with a value a run.
template <class ValueOf>
Json row_of(const std::string& name, const std::string& unit, const Runs& runs, double factor, ValueOf value_of) {
  Json cells = Json::array();
  const double first = value_of(runs.front());
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const double value = value_of(runs[r]);
    cells.push_back({{"value", shown(factor * value)}, {"difference", r == 0 ? "" : difference(value, first)}});
  }
  return {{"name", name}, {"unit", unit}, {"cells", cells}};
}

struct Figure {
  const char *name, *unit, *group, *key;  ///< group: the object of summary.json; empty: the top
  double factor;
};

}  // namespace

Json compared_figures(const Runs& runs) {
  static const Figure figures[] = {
      {"Comfort, 0 to 4", "", "comfort", "score", 1.0},
      {"Mean contact pressure", "Pa", "numbers", "mean_contact_pressure_Pa", 1.0},
      {"Largest contact pressure", "Pa", "numbers", "max_contact_pressure_Pa", 1.0},
      {"Largest displacement of the skin", "mm", "numbers", "max_skin_displacement_m", 1e3},
      {"Contact force", "N", "balance", "contact_force_N", 1.0},
      {"Contact area", "cm²", "numbers", "contact_area_m2", 1e4},
      {"Law of Laplace", "Pa", "", "mean_laplace_pressure_Pa", 1.0},
      {"Unknowns", "", "unknowns", "total", 1.0},
      {"Newton iterations", "", "", "iterations", 1.0},
      {"Time", "s", "", "seconds", 1.0},
      {"Memory", "MB", "", "peak_memory_bytes", 1e-6},
  };
  Json rows = Json::array();
  for (const Figure& figure : figures) {
    const auto value = [&](const ShownRun& run) {
      const Json* from = &run.summary;
      if (*figure.group) {
        const auto it = from->find(figure.group);
        if (it == from->end() || !it->is_object()) return std::nan("");
        from = &*it;
      }
      return value_at(*from, figure.key);
    };
    if (std::any_of(runs.begin(), runs.end(), [&](const ShownRun& run) { return std::isfinite(value(run)); }))
      rows.push_back(row_of(figure.name, figure.unit, runs, figure.factor, value));
  }
  return rows;
}

namespace {

/// Row of a list of the summary by its name; null where there is none.
const Json* named_row(const ShownRun& run, const char* list, const char* key, const std::string& name) {
  const auto it = run.summary.find(list);
  if (it == run.summary.end() || !it->is_array()) return nullptr;
  for (const Json& row : *it)
    if (row.value(key, "") == name) return &row;
  return nullptr;
}

/// Names of a list over all runs, in the order in which they come.
std::vector<std::string> names_in(const Runs& runs, const char* list, const char* key) {
  std::vector<std::string> names;
  for (const ShownRun& run : runs)
    for (const Json& row : run.summary.value(list, Json::array()))
      if (const std::string name = row.value(key, ""); std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

/// What of it differs from that of the first run in words beside.
Json cells_of(const std::vector<std::string>& texts) {
  Json cells = Json::array();
  for (const std::string& text : texts) cells.push_back({{"value", text.empty() ? "–" : text}, {"difference", ""}});
  return cells;
}

double fit_value(const ShownRun& run, double (*choose)(const std::vector<double>&)) {
  std::vector<double> ease;
  for (const Json& row : run.summary.value("fit", Json::array()))
    if (const double one = value_at(row, "ease"); std::isfinite(one)) ease.push_back(one);
  return ease.empty() ? std::nan("") : choose(ease);
}

}  // namespace

Json compared_locations(const Runs& runs) {
  Json rows = Json::array();
  for (const std::string& name : names_in(runs, "locations", "location")) {
    const auto found = [&](const ShownRun& run) { return named_row(run, "locations", "location", name); };
    Json row = row_of(name, "", runs, 1.0, [&](const ShownRun& run) { return found(run) ? value_at(*found(run), "mean_pressure_Pa") : std::nan(""); });
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Json* one = found(runs[r]);
      const double rating = one ? value_at(*one, "rating") : std::nan("");
      row["cells"][r]["mmHg"] = one ? fmt::format("{:.2f} mmHg", value_at(*one, "mean_pressure_mmHg")) : std::string();
      row["cells"][r]["rating"] = std::isfinite(rating) ? fmt::format("{:.2f} {}", rating, one->value("term", ""))
                                  : one && one->value("extrapolated", false) ? std::string("outside the trial")
                                                                             : std::string();
    }
    rows.push_back(row);
  }
  return rows;
}

Json compared_fit(const Runs& runs) {
  Json rows = Json::array();
  if (std::none_of(runs.begin(), runs.end(), [](const ShownRun& run) { return run.summary.contains("fit"); })) return rows;
  const auto mean = [](const std::vector<double>& ease) {
    double sum = 0.0;
    for (const double one : ease) sum += one;
    return sum / static_cast<double>(ease.size());
  };
  const auto least = [](const std::vector<double>& ease) { return *std::min_element(ease.begin(), ease.end()); };
  const auto most = [](const std::vector<double>& ease) { return *std::max_element(ease.begin(), ease.end()); };
  rows.push_back(row_of("Ease, mean", "%", runs, 100.0, [&](const ShownRun& run) { return fit_value(run, mean); }));
  rows.push_back(row_of("Ease, least", "%", runs, 100.0, [&](const ShownRun& run) { return fit_value(run, least); }));
  rows.push_back(row_of("Ease, most", "%", runs, 100.0, [&](const ShownRun& run) { return fit_value(run, most); }));
  for (Json& row : rows)
    for (Json& cell : row["cells"]) cell["difference"] = "";  // of a difference
  return rows;
}

Json compared_wishes(const Runs& runs) {
  Json rows = Json::array();
  for (const std::string& name : names_in(runs, "sensors", "name"))
    rows.push_back(row_of("Sensor " + name, "mmHg", runs, 1.0, [&](const ShownRun& run) {
      const Json* row = named_row(run, "sensors", "name", name);
      return row ? value_at(*row, "reading_mmHg") : std::nan("");
    }));
  for (const char* list : {"targets", "pressure_profile"})
    for (const std::string& name : names_in(runs, list, "name"))
      rows.push_back(row_of(name + ", of what is wanted", "%", runs, 100.0, [&](const ShownRun& run) {
        const Json* row = named_row(run, list, "name", name);
        return row ? value_at(*row, "found_over_wanted") : std::nan("");
      }));
  std::vector<std::pair<std::string, std::string>> verdicts;  // of a set at a location
  for (const ShownRun& run : runs)
    for (const Json& row : run.summary.value("thresholds", Json::array()))
      if (const std::pair one(row.value("set", ""), row.value("location", "")); std::find(verdicts.begin(), verdicts.end(), one) == verdicts.end()) verdicts.push_back(one);
  for (const auto& [set, location] : verdicts) {
    std::vector<std::string> texts;
    for (const ShownRun& run : runs) {
      texts.emplace_back();
      for (const Json& row : run.summary.value("thresholds", Json::array()))
        if (row.value("set", "") == set && row.value("location", "") == location) texts.back() = row.value("verdict", "");
    }
    rows.push_back({{"name", location + ", " + set}, {"unit", ""}, {"cells", cells_of(texts)}});
  }
  return rows;
}

std::vector<std::string> compared_location_names(const Runs& runs) { return names_in(runs, "locations", "location"); }

double location_pressure(const ShownRun& run, const std::string& name) {
  const Json* row = named_row(run, "locations", "location", name);
  return row ? value_at(*row, "mean_pressure_Pa") : std::nan("");
}

}  // namespace snug::postproc::report
