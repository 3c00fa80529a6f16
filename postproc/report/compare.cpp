// Several runs side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "postproc/csv_writer.hpp"
#include "postproc/report/assets.hpp"
#include "postproc/report/compare_rows.hpp"
#include "postproc/report/page.hpp"
#include "postproc/report/template.hpp"
#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

namespace fs = std::filesystem;

constexpr double map_width = 520.0;  // px

/// "garment.fabric" -> "\"N85L15\"" of the lines of case.echo.toml; tables of a list are counted:
/// body.layers.2.material.
std::vector<std::pair<std::string, std::string>> settings_of(const std::string& echo) {
  std::vector<std::pair<std::string, std::string>> settings;
  std::map<std::string, int> counts;
  std::string section, line;
  for (std::istringstream lines(echo); std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      const bool listed = line.starts_with("[[");
      section = line.substr(listed ? 2 : 1, line.find(']') - (listed ? 2 : 1));
      if (listed) section += fmt::format(".{}", ++counts[section]);
      continue;
    }
    const std::size_t equals = line.find(" = ");
    if (equals != std::string::npos)
      settings.emplace_back((section.empty() ? "" : section + ".") + line.substr(0, equals), line.substr(equals + 3));
  }
  return settings;
}

Json settings_rows(const Runs& runs) {
  std::vector<std::string> keys;
  std::vector<std::map<std::string, std::string>> values(runs.size());
  for (std::size_t r = 0; r < runs.size(); ++r)
    for (const auto& [key, value] : settings_of(runs[r].echo)) {
      values[r][key] = value;
      if (std::find(keys.begin(), keys.end(), key) == keys.end()) keys.push_back(key);
    }
  Json rows = Json::array();
  for (const std::string& key : keys) {
    Json cells = Json::array();
    bool same = true;
    for (auto& of_run : values) {
      same = same && of_run[key] == values.front()[key];
      cells.push_back({{"value", of_run[key].empty() ? "–" : of_run[key]}});
    }
    if (!same) rows.push_back({{"key", key}, {"cells", cells}});
  }
  return rows;
}

/// Runs that are called the same get a number.
void make_names_distinct(Runs& runs) {
  std::map<std::string, int> count, seen;
  for (const ShownRun& run : runs) ++count[run.name];
  for (ShownRun& run : runs)
    if (count[run.name] > 1) run.name += fmt::format(" ({})", ++seen[run.name]);
}

Json maps_view(const Runs& runs) {
  std::vector<const Skin*> skins;
  for (const ShownRun& run : runs)
    if (run.skin) skins.push_back(&*run.skin);
  const PressureScale scale = pressure_scale(skins);
  Json maps = Json::array();
  for (const ShownRun& run : runs) {
    Json map = map_view(run, scale, map_width);
    if (map.is_null()) continue;
    map["id"] = fmt::format("map-{}", maps.size());
    map["name"] = run.name;
    maps.push_back(map);
  }
  return maps;
}

}  // namespace

namespace {

Json missing_view(const Comparison& comparison) {
  Json rows = Json::array();
  for (const Comparison::Missing& one : comparison.missing) rows.push_back({{"name", one.name}, {"message", one.message}});
  return rows;
}

Runs read_runs(const Comparison& comparison) {
  Runs runs;
  for (const Comparison::Run& one : comparison.runs) {
    runs.push_back(read_shown(one.out));
    if (!one.name.empty()) runs.back().name = one.name;
  }
  make_names_distinct(runs);
  return runs;
}

void put_list(Json& view, const char* name, Json rows) {
  view[std::string("has_") + name] = !rows.empty();
  view[name] = std::move(rows);
}

/// What the sections of a comparison show.
Json view_of(const Runs& runs, const Comparison& comparison) {
  Json view = {{"count", std::to_string(runs.size())}, {"first", runs.front().name}, {"style", style()}};
  Json names = Json::array(), comforts = Json::array(), warnings = Json::array(), none = Json::array();
  std::string title;
  for (const ShownRun& run : runs) {
    title += (title.empty() ? "" : " · ") + run.name;
    names.push_back({{"name", run.name}});
    if (run.summary.value("status", "") != "converged")
      warnings.push_back({{"name", run.name},
                          {"status", run.summary.value("status", "")},
                          {"message", run.summary.value("message", "")}});
    if (const Json judged = run.summary.value("comfort", Json()); judged.is_object() && judged.contains("reason"))
      none.push_back({{"name", run.name}, {"reason", judged.value("reason", "")}});
    Json comfort = comfort_view(run);
    if (comfort.is_null()) continue;
    comfort["name"] = run.name;
    comforts.push_back(comfort);
  }
  view["names"] = comparison.title.empty() ? title : comparison.title, view["runs"] = names, view["warnings"] = warnings, view["missing"] = missing_view(comparison);
  view["figures"] = compared_figures(runs);
  view["sweep"] = sweep_view(runs, comparison.values, comparison.axis);
  view["several"] = runs.size() > 1;
  put_list(view, "settings", settings_rows(runs));
  put_list(view, "locations", compared_locations(runs));
  put_list(view, "fit", compared_fit(runs));
  put_list(view, "wishes", compared_wishes(runs));
  view["comforts"] = comforts, view["no_scores"] = none, view["has_comfort"] = !comforts.empty() || !none.empty();
  put_list(view, "maps", maps_view(runs));
  return view;
}

std::map<std::string, std::string_view> comparison_parts() {
  return {{"comparison", comparison_sections()}, {"map_svg", map_template()}, {"lines_svg", lines_template()}};
}

}  // namespace

std::string comparison_page(const std::vector<fs::path>& outs) {
  Comparison comparison;
  for (const fs::path& out : outs) comparison.runs.push_back({out, {}});
  return comparison_page(comparison);
}

std::string comparison_page(const Comparison& comparison) try {
  return fill(comparison_template(), view_of(read_runs(comparison), comparison), comparison_parts());
} catch (const Json::exception& error) {
  throw not_as_written(comparison.runs.front().out, error);
}

std::string comparison_table(const Comparison& comparison, CsvStyle style) try {
  const Runs runs = read_runs(comparison);
  const std::vector<std::string> locations = compared_location_names(runs);
  const bool values = !comparison.values.empty();
  std::ostringstream text;
  CsvWriter csv(text, style);
  csv.text(values ? comparison.axis : "run").columns("status,mean_contact_pressure_Pa,max_contact_pressure_Pa,comfort");
  for (const std::string& name : locations) csv.text(name + " [Pa]");
  csv.end_row();
  const auto cell = [&](double value) { std::isfinite(value) ? csv.number(value) : csv.empty(); };
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Json numbers = runs[r].summary.value("numbers", Json::object()), comfort = runs[r].summary.value("comfort", Json());
    values ? csv.number(comparison.values[r], 9) : csv.text(runs[r].name);
    csv.text(runs[r].summary.value("status", ""));
    cell(value_at(numbers, "mean_contact_pressure_Pa")), cell(value_at(numbers, "max_contact_pressure_Pa"));
    cell(comfort.is_object() ? value_at(comfort, "score") : std::nan(""));
    for (const std::string& name : locations) cell(location_pressure(runs[r], name));
    csv.end_row();
  }
  return text.str();
} catch (const Json::exception& error) {
  throw not_as_written(comparison.runs.front().out, error);
}

std::string project_page(const ProjectView& project) {
  Runs runs;
  std::vector<std::string> unreadable;
  for (const ProjectVariant& variant : project.variants) {
    if (variant.results.empty()) continue;
    try {
      runs.push_back(read_shown(variant.results));
      runs.back().name = variant.name;
    } catch (const input::InputError&) {
      unreadable.push_back(variant.name);
    }
  }
  Json view = Json::object();
  try {
    if (!runs.empty()) view = view_of(runs, {});
  } catch (const Json::exception& error) {
    throw not_as_written(project.variants.front().results, error);
  }
  view["has_runs"] = !runs.empty(), view["style"] = style();
  view["project"] = project.name, view["variants_text"] = fmt::format("{} runs", project.variants.size());
  Json specification = Json::array(), headings = Json::array(), variants = Json::array();
  for (const ProjectItem& item : project.specification) specification.push_back({{"name", item.name}, {"value", item.value}, {"source", item.source}});
  for (std::size_t c = 0; c < project.headings.size(); ++c) headings.push_back({{"name", project.headings[c].name}, {"text", project.headings[c].is_text}});
  for (const ProjectVariant& variant : project.variants) {
    Json cells = Json::array();
    for (std::size_t c = 0; c < variant.cells.size(); ++c) cells.push_back({{"value", variant.cells[c]}, {"text", project.headings.at(c).is_text}});
    variants.push_back({{"cells", cells}, {"chosen", variant.chosen}});
    if (variant.chosen) view["decision"] = variant.name;
  }
  view["specification"] = specification, view["has_specification"] = !specification.empty();
  view["headings"] = headings, view["variants"] = variants;
  view["decided"] = view.contains("decision"), view["why"] = project.why, view["decided_by"] = project.decided_by;
  std::string left_out = project.left_out;
  for (const std::string& name : unreadable) left_out += (left_out.empty() ? "" : " ") + name + " cannot be read.";
  view["left_out"] = left_out;
  return fill(project_template(), view, comparison_parts());
}

}  // namespace snug::postproc::report
