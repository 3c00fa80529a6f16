// Several runs side by side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "postproc/report/assets.hpp"
#include "postproc/report/page.hpp"
#include "postproc/report/template.hpp"
#include "postproc/report/view.hpp"

namespace snug::postproc::report {

namespace {

namespace fs = std::filesystem;

constexpr double map_width = 520.0;  // px

using Runs = std::vector<ShownRun>;

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

Json figures_view(const Runs& runs) {
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

const Json* location_row(const ShownRun& run, const std::string& name) {
  const auto it = run.summary.find("locations");
  if (it == run.summary.end()) return nullptr;
  for (const Json& row : *it)
    if (row.value("location", "") == name) return &row;
  return nullptr;
}

Json locations_rows(const Runs& runs) {
  std::vector<std::string> names;
  for (const ShownRun& run : runs)
    for (const Json& row : run.summary.value("locations", Json::array()))
      if (const std::string name = row.value("location", "");
          std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
  Json rows = Json::array();
  for (const std::string& name : names) {
    Json row = row_of(name, "", runs, 1.0, [&](const ShownRun& run) {
      const Json* found = location_row(run, name);
      return found ? value_at(*found, "mean_pressure_Pa") : std::nan("");
    });
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const Json* found = location_row(runs[r], name);
      const double rating = found ? value_at(*found, "rating") : std::nan("");
      row["cells"][r]["rating"] =
          std::isfinite(rating) ? fmt::format("{:.2f} {}", rating, found->value("term", "")) : std::string();
    }
    rows.push_back(row);
  }
  return rows;
}

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

/// What the sections of a comparison show.
Json view_of(const Runs& runs) {
  Json view = {{"count", std::to_string(runs.size())}, {"first", runs.front().name}, {"style", style()}};
  Json names = Json::array(), comforts = Json::array(), warnings = Json::array();
  std::string title;
  for (const ShownRun& run : runs) {
    title += (title.empty() ? "" : " · ") + run.name;
    names.push_back({{"name", run.name}});
    if (run.summary.value("status", "") != "converged")
      warnings.push_back({{"name", run.name},
                          {"status", run.summary.value("status", "")},
                          {"message", run.summary.value("message", "")}});
    Json comfort = comfort_view(run);
    if (comfort.is_null()) continue;
    comfort["name"] = run.name;
    comforts.push_back(comfort);
  }
  view["names"] = title, view["runs"] = names, view["warnings"] = warnings;
  view["figures"] = figures_view(runs);
  view["settings"] = settings_rows(runs), view["has_settings"] = !view["settings"].empty();
  view["locations"] = locations_rows(runs), view["has_locations"] = !view["locations"].empty();
  view["comforts"] = comforts, view["has_comfort"] = !comforts.empty();
  view["maps"] = maps_view(runs), view["has_maps"] = !view["maps"].empty();
  return view;
}

std::map<std::string, std::string_view> comparison_parts() {
  return {{"comparison", comparison_sections()}, {"map_svg", map_template()}};
}

}  // namespace

std::string comparison_page(const std::vector<fs::path>& outs) try {
  Runs runs;
  for (const fs::path& out : outs) runs.push_back(read_shown(out));
  make_names_distinct(runs);
  return fill(comparison_template(), view_of(runs), comparison_parts());
} catch (const Json::exception& error) {
  throw not_as_written(outs.front(), error);
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
    if (!runs.empty()) view = view_of(runs);
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
