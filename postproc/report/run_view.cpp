#include <fmt/format.h>
#include <Eigen/Core>

#include <algorithm>
#include <cmath>

#include "postproc/report/view.hpp"
#include "postproc/units.hpp"

namespace snug::postproc::report {

namespace {

std::string seconds_text(double seconds) {
  if (seconds < 0.05) return "< 0.1 s";
  if (seconds < 100.0) return fmt::format("{:.1f} s", seconds);
  return seconds < 5400.0 ? fmt::format("{:.1f} min", seconds / 60.0) : fmt::format("{:.1f} h", seconds / 3600.0);
}

std::string bytes_text(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.2f} GB", bytes / 1e9);
}

std::string pressure_text(double pascal) {
  return fmt::format("{} gf/cm² · {} mmHg", number(to_gf_cm2(pascal)), number(to_mmHg(pascal)));
}

/// What particles tell of cloth that hangs.
void add_hanging(const Json& numbers, double contact, auto add) {
  if (!numbers.contains("hem_folds")) return;
  add("Folds of the hem", value_at(numbers, "hem_folds"), 1.0, "",
      fmt::format("distances from its middle {} to {} mm, seen from above", number(1e3 * value_at(numbers, "hem_least_radius_m")), number(1e3 * value_at(numbers, "hem_largest_radius_m"))));
  add("Height of the hem", value_at(numbers, "hem_height_m"), 1e3, "mm", "in the mean");
  add("Weight of the cloth", value_at(numbers, "cloth_weight_N"), 1.0, "N", "");
  if (contact > 0.0)
    add("Force on the skin", contact, 1.0, "N", fmt::format("an estimate, no pressure; {} % of the cloth touches", number(100.0 * value_at(numbers, "touching_share_of_cloth"))));
}

/// Named values and how they are shown.
/// What it takes to move tools.
template <class Add>
void add_tools(const Json& summary, const Add& add) {
  const Json tools = summary.value("tools", Json::array());
  for (const Json& tool : tools) {
    const std::string of = tools.size() > 1 ? " (" + tool.value("name", "") + ")" : "";
    add(("Force on the tool" + of).c_str(), value_at(tool, "force_N"), 1.0, "N", fmt::format("{} mm deep, {}", number(1e3 * value_at(tool, "depth_m")), tool.value("shape", "")));
    add(("Stiffness" + of).c_str(), value_at(tool, "stiffness_N_per_m"), 1e-3, "N/mm", fmt::format("force over depth; {} N/mm at the end", number(1e-3 * value_at(tool, "slope_N_per_m"))));
    add(("Contact area of the tool" + of).c_str(), value_at(tool, "contact_area_m2"), 1e4, "cm²", fmt::format("{} Pa in the mean", number(value_at(tool, "mean_pressure_Pa"))));
    add(("Largest pressure under the tool" + of).c_str(), value_at(tool, "largest_pressure_Pa"), 1.0, "Pa", pressure_text(value_at(tool, "largest_pressure_Pa")));
  }
}

Json figures_view(const Json& summary) {
  const Json numbers = summary.value("numbers", Json::object()), balance = summary.value("balance", Json::object());
  Json figures = Json::array();
  const auto add = [&](const char* name, double value, double factor, const char* unit, const std::string& note) {
    if (std::isfinite(value))
      figures.push_back({{"name", name}, {"value", number(value * factor)}, {"unit", unit}, {"note", note}});
  };
  const double mean = value_at(numbers, "mean_contact_pressure_Pa"), top = value_at(numbers, "max_contact_pressure_Pa"),
               laplace = value_at(summary, "mean_laplace_pressure_Pa"), contact = value_at(balance, "contact_force_N");
  add("Mean contact pressure", mean, 1.0, "Pa", pressure_text(mean));
  add("Largest contact pressure", top, 1.0, "Pa", pressure_text(top) + (summary.contains("hems") ? ", beside the hems" : ""));
  add("Largest displacement of the skin", value_at(numbers, "max_skin_displacement_m"), 1e3, "mm", "");
  add_hanging(numbers, contact, add);
  if (contact > 0.0 && !numbers.contains("hem_folds")) {
    if (!summary.contains("tools")) add("Contact force", contact, 1.0, "N", summary.contains("surface_contacts") ? "sum of the amounts over all contacts" : "sum of the amounts over the skin");
    add("Contact area", value_at(numbers, "contact_area_m2"), 1e4, "cm²", "");
  }
  add_tools(summary, add);
  const double friction = value_at(balance, "friction_force_N");
  if (friction > 0.0) {
    add("Friction force", friction, 1.0, "N", summary.contains("surface_contacts") ? "sum of the amounts over all contacts" : "sum of the amounts over the skin");
    add("Largest shear traction", value_at(numbers, "max_shear_traction_Pa"), 1.0, "Pa", "friction of the garment on the skin");
    add("Slipping share of the contact", value_at(numbers, "slipping_share_of_contact"), 100.0, "%", "the rest sticks");
  }
  add("Gathered cloth", value_at(numbers, "gathered_share"), 100.0, "%", "share of the cloth that lies in folds");
  add("Slack cloth", value_at(numbers, "slack_share"), 100.0, "%", "share of the cloth without any tension");
  add("Cloth beyond its data", value_at(numbers, "fabric_beyond_data_share"), 100.0, "%",
      fmt::format("measured to {} %, stretched by up to {} %", number(100.0 * value_at(numbers, "fabric_data_end")),
                  number(100.0 * value_at(numbers, "fabric_largest_strain"))));
  if (laplace > 0.0) add("Law of Laplace", laplace, 1.0, "Pa", "sanity value: tension × curvature, skin undeformed");
  return figures;
}

/// Components of a force; those that are round-off of `scale` are zero.
std::string joined(const Json& vector, double scale) {
  std::string text;
  for (const Json& component : vector) {
    if (!text.empty()) text += ", ";
    const double value = component.is_number() ? component.get<double>() : std::nan("");
    text += number(std::abs(value) < 1e-12 * scale ? 0.0 : value);
  }
  return text;
}

double length(const Json& vector) {
  double sum = 0.0;
  for (const Json& component : vector)
    if (component.is_number()) sum += component.get<double>() * component.get<double>();
  return std::sqrt(sum);
}

Json balance_view(const Json& summary) {
  const Json balance = summary.value("balance", Json::object());
  Json rows = Json::array();
  const auto add = [&](const std::string& name, const std::string& value, const std::string& note) {
    rows.push_back({{"name", name}, {"value", value}, {"note", note}});
  };
  const double contact = value_at(balance, "contact_force_N");
  const double force = length(balance.value("force_error_N", Json::array()));
  add("Sum of all forces", number(force) + " N",
      contact > 0.0 ? number(force / contact) + " of the contact force" : "");
  add("Sum of all moments", number(length(balance.value("moment_error_Nm", Json::array()))) + " N m",
      "about the origin");
  if (contact > 0.0) {
    if (!summary.contains("tools")) add("Garment on skin", joined(balance.value("skin_force_N", Json::array()), contact) + " N", "x, y, z");
    add("Penetration", number(1e3 * value_at(summary, "max_penetration_m")) + " mm", "at most");
  }
  for (const Json& row : summary.value("bands", Json::array()))
    add("Band, " + row.value("name", ""), number(value_at(row, "tension_N")) + " N",
        fmt::format("presses with {} N/m along {} mm", number(value_at(row, "line_load_N_per_m")), number(1e3 * value_at(row, "length_m"))));
  for (const Json& row : summary.value("surface_contacts", Json::array()))
    add("Contact, " + row.value("name", ""), number(value_at(row, "force_N")) + " N",
        fmt::format("{} Pa in the mean over {} cm²", number(value_at(row, "mean_pressure_Pa")), number(1e4 * value_at(row, "area_m2"))));
  if (const double weight = length(balance.value("garment_weight_N", Json::array())); weight > 0.0)
    add("Weight of the garment", number(weight) + " N", "");
  const Json reactions = balance.value("reactions_N", Json::object());
  for (const auto& [name, force_vector] : reactions.items())
    add("Reaction, " + name, joined(force_vector, contact) + " N", "x, y, z");
  return rows;
}

Json hems_view(const Json& summary) {
  Json rows = Json::array();
  for (const Json& hem : summary.value("hems", Json::array()))
    rows.push_back({{"edge", hem.value("edge", "")},
                    {"line_load", number(value_at(hem, "line_load_N_per_m"))},
                    {"length", number(1e3 * value_at(hem, "length_m"))},
                    {"strip", number(1e3 * value_at(hem, "strip_m"))}});
  return rows;
}

/// Rows from above, as the garment hangs; several garments one after the other.
Json fit_view(const Json& summary) {
  const Json fit = summary.value("fit", Json::array());
  const bool alone = std::all_of(fit.begin(), fit.end(), [&](const Json& row) { return row.value("garment", "") == fit.front().value("garment", ""); });
  Json rows = Json::array();
  for (auto it = fit.rbegin(); it != fit.rend(); ++it)
    rows.push_back({{"garment", (alone ? "" : it->value("garment", "") + " ") + it->value("limb", "")},
                    {"height", number(1e3 * value_at(*it, "height_m"))},
                    {"body", number(1e3 * value_at(*it, "body_girth_m"))},
                    {"girth", number(1e3 * value_at(*it, "garment_girth_m"))},
                    {"ease", fmt::format("{:+.1f}", 100.0 * value_at(*it, "ease"))},
                    {"cover", fmt::format("{:.0f}", 100.0 * value_at(*it, "cover"))}});
  return rows;
}

Json piece_rows_view(const Json& summary) {
  Json rows = Json::array();
  for (const Json& piece : summary.value("pieces", Json::array()))
    rows.push_back({{"name", piece.value("name", "")},
                    {"fabric", piece.value("fabric", "")},
                    {"area", number(1e4 * value_at(piece, "area_m2"))},
                    {"weight", number(1e3 * value_at(piece, "weight_kg"))},
                    {"warp", number(value_at(piece, "tension_warp_N_per_m"))},
                    {"weft", number(value_at(piece, "tension_weft_N_per_m"))},
                    {"largest", number(value_at(piece, "largest_tension_N_per_m"))},
                    {"stretch_warp", fmt::format("{:.3f}", value_at(piece, "stretch_warp"))},
                    {"stretch_weft", fmt::format("{:.3f}", value_at(piece, "stretch_weft"))}});
  return rows;
}

Json seam_rows_view(const Json& summary) {
  Json rows = Json::array();
  for (const Json& seam : summary.value("seams", Json::array()))
    rows.push_back({{"name", seam.value("name", "")},
                    {"length", number(1e3 * value_at(seam, "length_m"))},
                    {"line_load", number(value_at(seam, "line_load_N_per_m"))},
                    {"largest", number(value_at(seam, "largest_line_load_N_per_m"))},
                    {"shear", number(value_at(seam, "shear_N_per_m"))}});
  return rows;
}

Json texts_view(const Json& texts) {
  Json rows = Json::array();
  for (const Json& text : texts) rows.push_back({{"text", text.get<std::string>()}});
  return rows;
}

Json warnings_view(const Json& summary) {
  Json rows = Json::array();
  for (const Json& w : summary.value("warnings", Json::array()))
    rows.push_back({{"name", w.value("name", "")}, {"text", w.value("text", "")}, {"place", w.value("place", "")}, {"remedy", w.value("remedy", "")}});
  return rows;
}

Json donning_view(const Json& summary) {
  Json rows = Json::array();
  for (const Json& row : summary.value("spread_over_donning_paths", Json::array()))
    rows.push_back({{"name", row.value("assumption", "")},
                    {"mean", number(value_at(row, "mean_contact_pressure_Pa"))},
                    {"largest", number(value_at(row, "max_contact_pressure_Pa"))},
                    {"open", !row.value("converged", true)}});
  return rows;
}

/// Largest amount of a field's entries that are numbers.
double largest_of(const NamedField& field) {
  double largest = 0.0;
  for (std::size_t n = 0; n < field.size(); ++n) {
    double squared = 0.0;
    for (std::size_t c = 0; c < std::max<std::size_t>(1, field.components.size()); ++c) squared += field.at(n, c) * field.at(n, c);
    if (std::isfinite(squared)) largest = std::max(largest, std::sqrt(squared));
  }
  return largest;
}

/// Fields that terms have published and the page does not know otherwise.
Json fields_view(const ShownRun& run) {
  Json rows = Json::array();
  for (const Json& entry : run.summary.value("fields", Json::array())) {
    const std::string name = entry.value("name", ""), part = entry.value("part", "");
    const std::optional<Grid>& grid = part == "body" ? run.body_grid : run.garment_grid;
    const NamedField* field = grid ? grid->fields.find(std::string_view(name)) : nullptr;
    rows.push_back({{"name", name}, {"part", part}, {"unit", entry.value("unit", "")}, {"description", entry.value("description", "")},
                    {"largest", field ? number(largest_of(*field)) : "–"}});
  }
  return rows;
}

/// A list and whether there is anything in it.
void put_list(Json& view, const std::string& name, const Json& rows) {
  view[name] = rows;
  view["has_" + name] = !rows.empty();
}

Json phases_view(const Json& summary) {
  double longest = 1e-12;
  for (const Json& phase : summary.value("phases", Json::array()))
    longest = std::max(longest, value_at(phase, "seconds"));
  Json rows = Json::array();
  const auto add = [&](const Json& phase, bool part) {
    const double seconds = value_at(phase, "seconds");
    rows.push_back({{"name", phase.value("name", "")},
                    {"time", seconds_text(seconds)},
                    {"percent", fmt::format("{:.1f}", 100.0 * std::min(1.0, seconds / longest))},
                    {"part", part}});
  };
  for (const Json& phase : summary.value("phases", Json::array())) {
    add(phase, false);
    for (const Json& part : phase.value("parts", Json::array())) add(part, true);
  }
  return rows;
}

Json pairs_view(const Json& object) {
  Json rows = Json::array();
  for (const auto& [name, value] : object.items())
    rows.push_back({{"name", name}, {"value", value.is_string() ? value.get<std::string>() : value.dump()}});
  return rows;
}

/// "tissue: relaxed thigh" as name and text.
Json parts_view(const Json& texts) {
  Json rows = Json::array();
  for (const Json& entry : texts) {
    const std::string text = entry.get<std::string>();
    const std::size_t colon = text.find(": ");
    rows.push_back(colon == std::string::npos
                       ? Json{{"name", text}, {"text", ""}}
                       : Json{{"name", text.substr(0, colon)}, {"text", text.substr(colon + 2)}});
  }
  return rows;
}

Json quality_view(const Json& summary) {
  Json rows = Json::array();
  const Json quality = summary.value("mesh_quality", Json::object());
  for (const auto& [layer, measures] : quality.items())
    rows.push_back({{"layer", layer},
                    {"cells", plain(value_at(measures, "cells"))},
                    {"min_jacobian", number(value_at(measures, "min_scaled_jacobian"))},
                    {"mean_jacobian", number(value_at(measures, "mean_scaled_jacobian"))},
                    {"aspect", number(value_at(measures, "max_aspect"))},
                    {"volume", number(1e6 * value_at(measures, "volume_m3"))}});
  return rows;
}

Json unknowns_view(const Json& summary) {
  Json rows = Json::array();
  const Json unknowns = summary.value("unknowns", Json::object());
  for (const auto& [part, count] : unknowns.items())
    if (count.is_number()) rows.push_back({{"name", part}, {"value", plain(count.get<double>())}});
  return rows;
}

}  // namespace

double value_at(const Json& json, const char* key) {
  const auto it = json.find(key);
  return it != json.end() && it->is_number() ? it->get<double>() : std::nan("");
}

Json run_view(const ShownRun& run) {
  const Json& summary = run.summary;
  const Json plan = summary.value("plan", Json::object());
  Json view = {{"title", summary.value("title", run.name)},
               {"name", run.name},
               {"tier", summary.value("tier", "")},
               {"status", summary.value("status", "")},
               {"message", summary.value("message", "")},
               {"increments", plain(value_at(summary, "increments"))},
               {"iterations", plain(value_at(summary, "iterations"))},
               {"time", seconds_text(value_at(summary, "seconds"))},
               {"memory", bytes_text(value_at(summary, "peak_memory_bytes"))},
               {"comparison", run.comparison},
               {"echo", run.echo}};
  view["failed"] = view["status"] == "failed";
  view["partial"] = view["status"] == "partial";
  view["figures"] = figures_view(summary);
  view["balance"] = balance_view(summary);
  view["state"] = summary.value("state", Json::object()).value("text", "");
  put_list(view, "hems", hems_view(summary));
  put_list(view, "fit", fit_view(summary));
  put_list(view, "piece_rows", piece_rows_view(summary));
  put_list(view, "seam_rows", seam_rows_view(summary));
  put_list(view, "profile", profile_view(run));
  put_list(view, "sensors", sensors_view(run));
  put_list(view, "thresholds", thresholds_view(run));
  const Json judged = summary.value("comfort", Json());
  view["no_score"] = judged.is_object() ? judged.value("reason", "") : "";
  put_list(view, "donning", donning_view(summary));
  put_list(view, "warnings", warnings_view(summary));
  put_list(view, "remedies", texts_view(summary.value("what_to_try", Json::array())));
  put_list(view, "assumptions", texts_view(summary.value("assumptions", Json::array())));
  put_list(view, "fields", fields_view(run));
  view["phases"] = phases_view(summary);
  view["parts_in"] = parts_view(plan.value("in", Json::array()));
  view["parts_out"] = parts_view(plan.value("out", Json::array()));
  view["unknowns"] = unknowns_view(summary);
  view["quality"] = quality_view(summary);
  view["versions"] = pairs_view(summary.value("versions", Json::object()));
  view["hashes"] = pairs_view(summary.value("input_hashes", Json::object()));
  view["command"] = summary.value("command", "");
  return view;
}

}  // namespace snug::postproc::report
