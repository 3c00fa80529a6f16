#include "solver/scene/garment_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/body/limb.hpp"
#include "solver/scene/laplace.hpp"

namespace snug::solver {

namespace {

// Distance of neighbouring vertices of the garment over that of neighbouring nodes of the skin, where these are soft.
constexpr double closer = 0.85;
// Of a skin whose cells are longer than this the short side counts: the garment bends round the limb by it.
constexpr double needle = 3.0;

std::vector<mesh::FacetNodeNumbers> covered_facets(const mesh::BodyMesh& body, const std::vector<char>& covered) {
  std::vector<mesh::FacetNodeNumbers> facets;
  const auto touches = [&](int node) { return node >= 0 && covered[node]; };
  for (const auto& facet : body.skin_facets)
    if (std::any_of(facet.begin(), facet.end(), touches)) facets.push_back(facet);
  return facets;
}

}  // namespace

double worn_cell_size(const Model& model, int g, const mesh::GarmentFit& fit, const mesh::Limb& limb, const mesh::BodyMesh& body) {
  const double usual = 0.6 * std::min(body.mean_skin_cell, needle * mesh::shortest_edge(body, body.skin_facets));
  if (!model.deformable() || !model.contact_of(g)) return usual;
  const LaplacePressure expected = laplace_pressure(fit, model.garments[g], limb, body);
  const double largest = *std::max_element(expected.pressure.begin(), expected.pressure.end());
  if (largest < softest_shear_modulus(model)) return usual;
  return std::min(usual, 0.5 * closer * mesh::shortest_edge(body, covered_facets(body, expected.covered)));
}

}  // namespace snug::solver
