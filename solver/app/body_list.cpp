#include "solver/app/body_list.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "cases/input/standard_body.hpp"
#include "cases/input/suggestion.hpp"
#include "solver/app/data_directory.hpp"

namespace snug::app {

namespace {

using Json = nlohmann::ordered_json;

std::string millimetres(double length) { return fmt::format("{:.0f} mm", 1e3 * length); }

std::string text_of(const std::string& name, const input::StandardBody& body) {
  std::vector<std::string> girths, cuts, locations;
  for (const input::Landmark& one : body.landmarks)
    if (one.girth) girths.push_back(fmt::format("{} {} at {}", one.name, millimetres(*one.girth), millimetres(one.at[2])));
  for (const input::StandardCut& cut : body.cuts) cuts.push_back(fmt::format("{} ({} at {})", cut.name, millimetres(cut.girth), millimetres(cut.point[2])));
  for (const input::LocationSpec& location : body.locations) locations.push_back(location.name);
  return fmt::format("  {}: {}, stature {}; {}; {}\n    girths: {}\n    cuts (girth at height): {}\n    locations: {}\n", name, body.title, millimetres(body.stature), body.source,
                     body.licence, input::joined(girths), input::joined(cuts), input::joined(locations));
}

Json json_of(const std::string& name, const input::StandardBody& body) {
  Json json = {{"name", name}, {"title", body.title}, {"source", body.source}, {"licence", body.licence}, {"surface", body.surface.string()}, {"stature_m", body.stature}};
  for (const input::Landmark& one : body.landmarks) {
    json["landmarks"].push_back({{"name", one.name}, {"at_m", one.at}});
    if (one.girth) json["landmarks"].back()["girth_m"] = *one.girth;
  }
  for (const input::StandardCut& cut : body.cuts)
    json["cuts"].push_back({{"name", cut.name}, {"point_m", cut.point}, {"normal", cut.normal}, {"towards", cut.towards}, {"girth_m", cut.girth}});
  for (const input::LocationSpec& location : body.locations)
    json["locations"].push_back({{"name", location.name}, {"at_m", location.at.value_or(std::array<double, 3>{})}, {"radius_m", location.radius.value_or(0.0)}});
  return json;
}

}  // namespace

std::string bodies_text() {
  std::string text;
  for (const std::string& name : input::standard_bodies(bodies_folder())) text += text_of(name, input::read_standard_body(bodies_folder(), name));
  return text;
}

Json bodies_json() {
  Json json = Json::array();
  for (const std::string& name : input::standard_bodies(bodies_folder())) json.push_back(json_of(name, input::read_standard_body(bodies_folder(), name)));
  return json;
}

}  // namespace snug::app
