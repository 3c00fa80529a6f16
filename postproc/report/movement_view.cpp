// The movement through the postures of a case: a row a posture, pressures over the way.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "postproc/report/line_plot.hpp"
#include "postproc/report/view.hpp"
#include "postproc/units.hpp"

namespace snug::postproc::report {

namespace {

std::string bones_text(const Json& posture) {
  std::string text;
  for (const Json& bone : posture.value("bones", Json::array())) {
    text += fmt::format("{}{} {}°", text.empty() ? "" : ", ", bone.value("name", ""), number(value_at(bone, "turn_rad") * 180.0 / std::numbers::pi));
    if (bone.contains("shift_m")) text += " and shifted";
  }
  return text;
}

std::vector<double> column(const Json& values) {
  std::vector<double> list;
  for (const Json& value : values) list.push_back(value.is_number() ? value.get<double>() : std::nan(""));
  return list;
}

PlotLine line_of(const std::string& name, const Json& pressures) {
  PlotLine line{name, column(pressures)};
  for (double& value : line.mmHg) value = to_mmHg(value);
  return line;
}

Json rows_of(const Json& postures) {
  Json rows = Json::array();
  for (const Json& posture : postures) {
    Json cells = Json::array();
    for (const Json& location : posture.value("locations", Json::array())) cells.push_back({{"value", number(value_at(location, "mean_pressure_Pa"))}});
    const double share = value_at(posture, "share"), comfort = value_at(posture, "comfort"), force = value_at(posture, "force_error_N") / value_at(posture, "contact_force_N");
    rows.push_back({{"name", posture.value("name", "")},
                    {"part", share < 1.0 ? fmt::format("{:.0f} % of the way", 100.0 * share) : ""},
                    {"bones", bones_text(posture)},
                    {"mean", number(value_at(posture, "mean_contact_pressure_Pa"))},
                    {"largest", number(value_at(posture, "max_contact_pressure_Pa"))},
                    {"area", number(1e4 * value_at(posture, "contact_area_m2"))},
                    {"comfort", std::isfinite(comfort) ? number(comfort) : ""},
                    {"balance", std::isfinite(force) ? number(force, 2) : ""},
                    {"cells", cells}});
  }
  return rows;
}

}  // namespace

Json movement_view(const ShownRun& run) {
  const Json postures = run.summary.value("postures", Json::array()), movement = run.summary.value("movement", Json::object());
  if (postures.empty()) return nullptr;
  Json heads = Json::array();
  for (const Json& location : postures.front().value("locations", Json::array())) heads.push_back({{"name", location.value("location", "")}});
  std::vector<PlotLine> lines;
  for (const Json& location : movement.value("locations", Json::array())) lines.push_back(line_of(location.value("location", ""), location.value("mean_pressure_Pa", Json::array())));
  lines.push_back(line_of("all the touched skin", movement.value("mean_contact_pressure_Pa", Json::array())));
  std::vector<PlotMark> marks;
  for (std::size_t n = 0; n < postures.size(); ++n)
    if (value_at(postures[n], "share") == 1.0) marks.push_back({static_cast<double>(n), postures[n].value("name", "")});
  return {{"rows", rows_of(postures)}, {"heads", heads}, {"plot", line_plot(lines, column(movement.value("progress", Json::array())), "posture", marks)}};
}

}  // namespace snug::postproc::report
