#include "solver/scene/bands.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace snug::solver {

BandModel band_model(const input::BandSpec& spec, const mesh::GarmentMesh& garment) {
  if (!garment.edges.contains(spec.edge)) {
    std::vector<std::string> names;
    for (const auto& [name, nodes] : garment.edges) names.push_back("\"" + name + "\"");
    throw input::InputError(spec.where, fmt::format("{} has no edge \"{}\" for a band", garment.name, spec.edge),
                            fmt::format("its edges are: {}", fmt::join(names, ", ")));
  }
  const double cut = edge_length(garment, spec.edge);
  return {spec.stiffness * spec.width, cut, *input::rest_length(spec, cut)};
}

ContactSlave slave_with_bands(const Field& positions, const input::GarmentSpec& spec, const mesh::GarmentMesh& garment) {
  ContactSlave slave = garment_slave(positions, garment);
  for (const input::BandSpec& band : spec.band) bear_along(garment, band.edge, band.width, slave);
  return slave;
}

void add_bands(const input::GarmentSpec& spec, const mesh::GarmentMesh& garment, Scene& scene) {
  for (const input::BandSpec& band : spec.band) {
    const BandModel model = band_model(band, garment);
    scene.add(std::make_unique<Band>(garment, band.edge, scene.layout()[garment.name], model.stiffness, model.rest_length));
  }
}

std::vector<postproc::Band> band_rows(const Scene& scene, const State& state) {
  std::vector<postproc::Band> rows;
  for (const auto& term : scene.terms()) {
    const auto* band = dynamic_cast<const Band*>(term.get());
    if (!band) continue;
    const Band::Worn worn = band->worn(state);
    rows.push_back({.garment = band->garment(), .edge = band->edge(), .rest_length = band->rest_length(), .length = worn.length,
                    .tension = worn.tension, .least_tension = worn.least, .largest_tension = worn.largest, .line_load = worn.line_load()});
  }
  return rows;
}

}  // namespace snug::solver
