#include "solver/app/study/ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace snug::app {

namespace {

int times(double factor, int cells, int least) {
  return std::max(least, static_cast<int>(std::lround(factor * cells)));
}

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

}  // namespace

input::StudyVariant scaled(const input::Case& description, double factor) {
  input::StudyVariant level{fmt::format("{:g}", factor), {}};
  if (const auto& body = description.body) {
    level.set.push_back(fmt::format("body.cells_around={}", times(factor, body->cells_around, 8)));
    level.set.push_back(fmt::format("body.cells_along={}", times(factor, body->cells_along, 1)));
    for (std::size_t n = 0; n < body->layers.size(); ++n)
      if (body->layers[n].form == input::LayerForm::solid)
        level.set.push_back(fmt::format("body.layers.{}.cells={}", n, times(factor, body->layers[n].cells, 1)));
  }
  for (const input::GarmentSpec& garment : description.garments)
    if (garment.cell_size > 0.0)
      level.set.push_back(fmt::format("garment.{}cell_size=\"{:g} m\"", description.garments.size() == 1 ? "" : garment.name + ".",
                                      garment.cell_size / factor));
  return level;
}

std::vector<input::StudyVariant> default_series(const input::Case& description) {
  std::vector<input::StudyVariant> series = {{"the case", {}}};
  if (description.contacts.empty()) return series;
  if (description.solver.tier == input::Tier::L4) series.push_back({"tier L1", {"solver.tier=L1"}});
  if (description.solver.tier != input::Tier::L0) series.push_back({"straight elements", {"body.facets=flat", "garment.order=1"}});
  return series;
}

std::vector<input::StudyVariant> varied(const std::vector<std::string>& vary) {
  std::vector<input::StudyVariant> series = {{"", {}}};
  for (const std::string& text : vary) {
    const auto equals = text.find('=');
    const std::vector<std::string> values = equals == std::string::npos ? split("") : split(text.substr(equals + 1));
    if (values.empty())
      throw input::InputError({"--vary " + text, 0, 0}, "there is no key=value",
                              "write for example --vary solver.tier=L1,L4");
    std::vector<input::StudyVariant> product;
    for (const input::StudyVariant& one : series)
      for (const std::string& value : values) {
        input::StudyVariant next = one;
        next.set.push_back(text.substr(0, equals + 1) + value);
        next.name += (one.name.empty() ? "" : ", ") + next.set.back();
        product.push_back(next);
      }
    series = product;
  }
  return series;
}

double expected_seconds(const std::vector<TimedRun>& earlier, long unknowns) {
  const TimedRun& last = earlier.back();
  double power = 1.5;
  if (earlier.size() > 1) {
    const TimedRun& before = earlier[earlier.size() - 2];
    const double growth = std::log(static_cast<double>(last.unknowns) / static_cast<double>(before.unknowns));
    if (growth > 0.1) power = std::clamp(std::log(last.seconds / before.seconds) / growth, 1.0, 2.0);
  }
  return last.seconds * std::pow(static_cast<double>(unknowns) / static_cast<double>(last.unknowns), power);
}

}  // namespace snug::app
