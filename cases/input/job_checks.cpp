#include "cases/input/job_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "cases/input/suggestion.hpp"

namespace snug::input {

namespace {

std::vector<std::string> location_names(const Case& c) {
  std::vector<std::string> names;
  if (c.body)
    for (const LocationSpec& location : c.body->locations) names.push_back(location.name);
  return names;
}

const LocationSpec* find_location(const Case& c, const std::string& name) {
  if (!c.body) return nullptr;
  const auto found = std::find_if(c.body->locations.begin(), c.body->locations.end(), [&](const LocationSpec& one) { return one.name == name; });
  return found == c.body->locations.end() ? nullptr : &*found;
}

void check_location(const Case& c, const std::string& name, const Location& where, Diagnostics& diagnostics) {
  if (find_location(c, name)) return;
  const std::vector<std::string> names = location_names(c);
  diagnostics.error(where, fmt::format("\"{}\" is no location of the case", name),
                    names.empty() ? "add [[body.locations]] with that name" : did_you_mean(name, names));
}

void check_garment_of(const Case& c, const std::string& key, const Table& root, Diagnostics& diagnostics) {
  if (c.garments.empty()) diagnostics.error(root.where_is(key), fmt::format("there is a [{}] but no [garment] that presses", key), "add [garment], or leave it out");
}

void check_target(const Jobs& jobs, const Case& c, const Table& root, Diagnostics& diagnostics) {
  if (!jobs.target) return;
  check_garment_of(c, "target", root, diagnostics);
  if (jobs.target->pressures.empty())
    diagnostics.error(jobs.target->where, "[target] wants no pressure", "write pressures = [{ location = \"Ankle\", pressure = \"20 mmHg\" }]");
  for (const WantedPressure& wanted : jobs.target->pressures) {
    if (wanted.height.has_value() == !wanted.location.empty())
      diagnostics.error(wanted.where, wanted.height ? "a pressure is wanted at a location and at a height" : "a pressure is wanted nowhere",
                        "write location = \"Ankle\", or height = \"50 mm\"");
    else if (!wanted.location.empty())
      check_location(c, wanted.location, wanted.where, diagnostics);
  }
}

/// A sensor can lie in the middle of a patch, and of a sector that does not go more than half way round.
bool has_side(const LocationSpec& location) { return !location.is_sector() || middle_angle(location); }

void check_sensors(const Jobs& jobs, const Case& c, const Table& root, Diagnostics& diagnostics) {
  if (jobs.sensors.empty()) return;
  check_garment_of(c, "sensor", root, diagnostics);
  std::set<std::string> names;
  for (const SensorSpec& sensor : jobs.sensors) {
    if (!names.insert(sensor.name).second) diagnostics.error(sensor.where, fmt::format("two sensors are called \"{}\"", sensor.name), "give each its own name");
    if (sensor.bulge && sensor.thickness == 0.0)
      diagnostics.error(sensor.where, fmt::format("the sensor \"{}\" is to bulge and has no thickness", sensor.name), "add thickness = \"3 mm\", or leave bulge out");
    const LocationSpec* location = find_location(c, sensor.location);
    if (!sensor.location.empty() && !location) check_location(c, sensor.location, sensor.where, diagnostics);
    const bool height = sensor.height || location, angle = sensor.angle || (location && has_side(*location));
    if (sensor.location.empty() || location)
      if (!height || !angle)
        diagnostics.error(sensor.where, fmt::format("where the sensor \"{}\" lies is not said", sensor.name),
                          !height ? "add location = \"Ankle\", or height and angle" : "add angle = \"90 deg\" (0 deg = side, 90 deg = front)");
  }
}

void check_variants(const Jobs& jobs, const Case& c, Diagnostics& diagnostics) {
  std::set<std::string> names;
  for (const StudyVariant& variant : jobs.variants) {
    if (variant.name.empty()) diagnostics.error({(c.directory / "case.toml").string(), 0, 0}, "a [[variant]] has an empty name", "give it one: name = \"size S\"");
    if (!names.insert(variant.name).second)
      diagnostics.error({(c.directory / "case.toml").string(), 0, 0}, fmt::format("two variants are called \"{}\"", variant.name), "give each its own name");
  }
}

}  // namespace

std::optional<double> middle_angle(const LocationSpec& sector) {
  constexpr double turn = 2.0 * std::numbers::pi;
  const double width = sector.to_angle - sector.from_angle, once = width - turn * std::floor(width / turn);
  if (!(once > 0.0) || once > 1.001 * std::numbers::pi) return std::nullopt;
  return sector.from_angle + 0.5 * once;
}

void check_jobs(const Jobs& jobs, const Case& c, const Table& root, Diagnostics& diagnostics) {
  check_target(jobs, c, root, diagnostics);
  check_sensors(jobs, c, root, diagnostics);
  check_variants(jobs, c, diagnostics);
  if (c.comfort && c.comfort->curves.name == "none" && c.comfort->thresholds.empty())
    diagnostics.error(root.where_is("comfort"), "[comfort] names neither curves nor thresholds",
                      "add curves = \"wear trial 2002\", or thresholds = [\"RAL-GZ 387\"] alone (snug list curves), or leave [comfort] out");
}

}  // namespace snug::input
