#include "solver/scene/garment_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/fabric/fabric.hpp"
#include "materials/laws/solid_law.hpp"
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

double softest_shear_modulus(const mesh::BodyMesh& body) {
  double softest = std::numeric_limits<double>::infinity();
  for (const auto& layer : body.layers)
    softest = std::min(softest, materials::initial_shear_modulus(materials::find_tissue(layer.material).law));
  return softest;
}

double worn_cell_size(const input::Case& description, const mesh::Limb& limb, const mesh::BodyMesh& body) {
  const double usual = 0.6 * std::min(body.mean_skin_cell, needle * mesh::shortest_edge(body, body.skin_facets));
  if (description.solver.tier != "L4" || !description.contact) return usual;
  const auto fabric = materials::find_fabric(description.garment->fabric);
  const LaplacePressure expected = laplace_pressure(*description.garment, fabric, limb, body);
  const double largest = *std::max_element(expected.pressure.begin(), expected.pressure.end());
  if (largest < softest_shear_modulus(body)) return usual;
  return std::min(usual, 0.5 * closer * mesh::shortest_edge(body, covered_facets(body, expected.covered)));
}

}  // namespace snug::solver
