#include "mesh/body/body_mesh.hpp"

#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesh/body/hex27.hpp"
#include "mesh/body/lattice.hpp"
#include "mesh/body/layering.hpp"

namespace snug::mesh {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

struct Grid {
  int around, along, through;  // cells
};

Grid checked_grid(const input::BodySpec& spec, const Layering& layering) {
  if (spec.cells_around < 4 || spec.cells_along < 1)
    throw input::InputError(spec.where,
                            fmt::format("{} cells around and {} along", spec.cells_around, spec.cells_along),
                            "write at least 4 cells around and 1 along");
  Grid grid{spec.cells_around, spec.cells_along, 0};
  for (const auto& layer : layering.solids()) grid.through += layer.cells;
  return grid;
}

/// Facet k = 2 of a cell.
std::array<int, 9> outer_facet(const std::array<int, 27>& cell) {
  std::array<int, 9> facet;
  std::copy_n(cell.begin() + 18, 9, facet.begin());
  return facet;
}

void collect_surfaces(const Lattice& lattice, const Grid& grid, BodyMesh& mesh) {
  for (std::size_t n = 0; n < lattice.nodes.size(); ++n) {
    const LatticeKey& key = lattice.nodes[n];
    const int node = static_cast<int>(n);
    if (key.k == 0) mesh.bone_nodes.push_back(node);
    if (key.j == 0) mesh.lower_nodes.push_back(node);
    if (key.j == 2 * grid.along) mesh.upper_nodes.push_back(node);
  }
  for (const auto& cell : lattice.cells)
    if (lattice.nodes[cell[18]].k == 2 * grid.through) mesh.skin_facets.push_back(outer_facet(cell));
}

double mean_facet_edge(const BodyMesh& mesh) {
  static constexpr std::array<std::array<int, 2>, 4> edges = {{{0, 2}, {6, 8}, {0, 6}, {2, 8}}};
  double sum = 0.0;
  for (const auto& facet : mesh.skin_facets)
    for (const auto& [a, b] : edges) sum += (mesh.nodes[facet[a]] - mesh.nodes[facet[b]]).norm();
  return sum / (4.0 * static_cast<double>(mesh.skin_facets.size()));
}

bool in_sector(double angle, const input::LocationSpec& location) {
  constexpr double tolerance = 1e-9;  // nodes on a border must not fall to either side by round-off
  const auto wrap = [](double a) { return a - full_turn * std::floor(a / full_turn); };
  const double width = location.to_angle - location.from_angle;
  if (std::abs(width) < tolerance || width > full_turn - tolerance) return true;  // all round
  return wrap(angle - location.from_angle + tolerance) < wrap(width);
}

bool in_range(double z, const input::LocationSpec& location) {
  return (!location.from_height || z >= *location.from_height) && (!location.to_height || z <= *location.to_height);
}

/// Skin nodes go to the first location whose sector and range of heights hold them.
void assign_locations(const std::vector<input::LocationSpec>& locations, const Lattice& lattice, const Limb& limb,
                      int skin_k, BodyMesh& mesh) {
  for (const auto& location : locations) mesh.locations.push_back(location.name);
  mesh.node_location.assign(mesh.nodes.size(), -1);
  std::vector<Eigen::Vector2d> centre;  // by lattice height j
  for (std::size_t n = 0; n < lattice.nodes.size() && !locations.empty(); ++n) {
    const LatticeKey& key = lattice.nodes[n];
    if (key.k != skin_k) continue;
    const Eigen::Vector3d& x = mesh.nodes[n];
    while (static_cast<int>(centre.size()) <= key.j) centre.push_back(Eigen::Vector2d::Constant(NAN));
    if (std::isnan(centre[key.j].x())) centre[key.j] = section_centre(*limb.skin, x.z());
    const double angle = std::atan2(x.y() - centre[key.j].y(), x.x() - centre[key.j].x());
    const auto holds = [&](const auto& location) { return in_sector(angle, location) && in_range(x.z(), location); };
    const auto found = std::find_if(locations.begin(), locations.end(), holds);
    if (found != locations.end()) mesh.node_location[n] = static_cast<int>(found - locations.begin());
  }
}

void check_cells(const BodyMesh& mesh, const Limb& limb, const input::Location& where) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    std::array<Eigen::Vector3d, 27> x;
    std::transform(mesh.cells[c].begin(), mesh.cells[c].end(), x.begin(), [&](int node) { return mesh.nodes[node]; });
    for (const SamplePoint& sample : hex27_samples()) {
      if (hex27_jacobian(x, sample.reference).determinant() > 0.0) continue;
      const Eigen::Vector2d from = x[13].head<2>() - section_centre(*limb.skin, x[13].z());
      throw input::InputError(
          where,
          fmt::format("a cell of layer \"{}\" would turn inside out at angle {:.0f} deg, height {:.1f} mm",
                      mesh.layers[mesh.cell_layer[c]].name, std::atan2(from.y(), from.x()) * 360.0 / full_turn,
                      1e3 * x[13].z()),
          "take more cells around, a thinner layer, or a bone nearer to the middle of the section");
    }
  }
}

/// Every cell becomes the trilinear image of its corners: node (i, j, k) is the mean of the corners on its edge or face.
void straighten(BodyMesh& mesh) {
  const std::vector<Eigen::Vector3d> curved = mesh.nodes;
  for (const auto& cell : mesh.cells)
    for (int n = 0; n < 27; ++n) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (int corner = 0; corner < 8; ++corner) {
        int from = 0;  // a coordinate in the middle takes either end, one at an end stays
        for (int axis = 0, stride = 1, rest = n; axis < 3; ++axis, stride *= 3, rest /= 3)
          from += stride * (rest % 3 == 1 ? 2 * ((corner >> axis) & 1) : rest % 3);
        sum += curved[cell[from]];
      }
      mesh.nodes[cell[n]] = sum / 8.0;
    }
}

}  // namespace

BodyMesh make_body_mesh(const input::BodySpec& spec, const Limb& limb) {
  const Layering layering(spec);
  const Grid grid = checked_grid(spec, layering);
  const Lattice lattice = make_lattice(grid.around, grid.along, layering.lattice_layers());

  BodyMesh mesh;
  mesh.cells = lattice.cells;
  mesh.cell_layer = lattice.cell_layer;
  for (const auto& layer : layering.solids()) mesh.layers.push_back({layer.name, layer.material});
  for (const auto& layer : layering.membranes())
    mesh.membranes.push_back({layer.name, layer.material, *layer.thickness});
  for (const LatticeKey& key : lattice.nodes) {
    const double turn = 0.5 * key.i / grid.around;
    const double z = limb.lower + (limb.upper - limb.lower) * (0.5 * key.j / grid.along);
    mesh.nodes.push_back(layering.point(limb, turn, z, key.k));
  }
  if (spec.facets == "flat") straighten(mesh);
  check_cells(mesh, limb, spec.where);
  collect_surfaces(lattice, grid, mesh);
  mesh.mean_skin_cell = mean_facet_edge(mesh);
  assign_locations(spec.locations, lattice, limb, 2 * grid.through, mesh);
  return mesh;
}

std::vector<QualityRow> quality(const BodyMesh& mesh) {
  std::vector<QualityRow> rows;
  for (const Layer& layer : mesh.layers) rows.push_back({.layer = layer.name, .min_scaled_jacobian = 1.0});
  const double samples = static_cast<double>(hex27_samples().size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    QualityRow& row = rows[mesh.cell_layer[c]];
    std::array<Eigen::Vector3d, 27> x;
    std::transform(mesh.cells[c].begin(), mesh.cells[c].end(), x.begin(), [&](int node) { return mesh.nodes[node]; });
    ++row.cells;
    for (const SamplePoint& sample : hex27_samples()) {
      const Eigen::Matrix3d jacobian = hex27_jacobian(x, sample.reference);
      const Eigen::Vector3d edges = jacobian.colwise().norm();
      const double scaled = jacobian.determinant() / edges.prod();
      row.min_scaled_jacobian = std::min(row.min_scaled_jacobian, scaled);
      row.mean_scaled_jacobian += scaled / samples;  // divided by the cells below
      row.max_aspect = std::max(row.max_aspect, edges.maxCoeff() / edges.minCoeff());
      row.volume += sample.weight * jacobian.determinant();
    }
  }
  for (QualityRow& row : rows) row.mean_scaled_jacobian /= std::max(row.cells, 1);
  return rows;
}

}  // namespace snug::mesh
