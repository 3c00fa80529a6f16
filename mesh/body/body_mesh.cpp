#include "mesh/body/body_mesh.hpp"

#include <array>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "mesh/body/core.hpp"
#include "mesh/body/lattice.hpp"
#include "mesh/body/layering.hpp"
#include "mesh/body/location_shares.hpp"
#include "mesh/body/locations.hpp"

namespace snug::mesh {

namespace {

constexpr double full_turn = 2.0 * std::numbers::pi;

struct Grid {
  int around, along, through;  // cells
  int bone;                    // of them through an elastic bone, outside its core
};

Grid checked_grid(const input::BodySpec& spec, const Layering& layering) {
  if (spec.cells_around < 4 || spec.cells_along < 1)
    throw input::InputError(spec.where,
                            fmt::format("{} cells around and {} along", spec.cells_around, spec.cells_along),
                            "write at least 4 cells around and 1 along");
  if (layering.bone() && spec.cells_around % 4 != 0)
    throw input::InputError(spec.where, fmt::format("{} cells around an elastic bone", spec.cells_around),
                            "write a multiple of 4: the bone is meshed round a square");
  if (layering.bone() && spec.elements == input::Elements::P2P1)
    throw input::InputError(spec.where, "elements = \"P2/P1\" with an elastic bone",
                            "use Q2/P1 or Q1/P0, or make the bone rigid");
  Grid grid{spec.cells_around, spec.cells_along, 0, layering.bone() ? layering.bone()->cells : 0};
  for (const auto& layer : layering.lattice_layers()) grid.through += layer.cells;
  return grid;
}

/// Where the lattice stands: the rings of an elastic bone between its core and its outline, the layers outside it.
std::vector<Eigen::Vector3d> positions(const Lattice& lattice, const Layering& layering, const Grid& grid,
                                       const Limb& limb) {
  std::vector<Eigen::Vector3d> nodes;
  std::map<int, CoreBorder> border;  // by lattice height
  for (const LatticeKey& key : lattice.nodes) {
    const double turn = 0.5 * key.i / grid.around;
    const double z = limb.lower + (limb.upper - limb.lower) * (0.5 * key.j / grid.along);
    if (key.k >= 2 * grid.bone) {
      nodes.push_back(layering.point(limb, turn, z, key.k - 2 * grid.bone));
      continue;
    }
    const CoreBorder& core = border.try_emplace(key.j, *limb.bone, z).first->second;
    const double s = 0.5 * key.k / grid.bone;
    nodes.push_back((1.0 - s) * core.at(turn) + s * limb.bone->at(turn, z));
  }
  return nodes;
}

/// Names the surfaces by the lattice: their nodes, and the faces of cells that lie on them.
void collect_surfaces(const Lattice& lattice, const Grid& grid, BodyMesh& mesh) {
  const auto add = [&](const std::string& name, auto holds) {
    Surface& surface = mesh.surfaces.emplace_back();
    surface.name = name;
    std::vector<char> keep(mesh.nodes.size(), 0);
    for (std::size_t n = 0; n < lattice.nodes.size(); ++n)
      if (holds(lattice.nodes[n])) keep[n] = 1, surface.nodes.push_back(static_cast<int>(n));
    surface.facets = boundary_facets(mesh, keep);
  };
  add("bone", [&](const LatticeKey& key) { return key.k == 2 * grid.bone; });
  add("lower", [](const LatticeKey& key) { return key.j == 0; });
  add("upper", [&](const LatticeKey& key) { return key.j == 2 * grid.along; });
  add("skin", [&](const LatticeKey& key) { return key.k == 2 * grid.through; });
  if (grid.bone == 0) mesh.bone_nodes = mesh.surface("bone")->nodes;
  mesh.skin_facets = mesh.surface("skin")->facets;
}

bool in_sector(double angle, const input::LocationSpec& location) {
  if (!location.is_sector()) return false;
  constexpr double tolerance = 1e-9;  // nodes on a border must not fall to either side by round-off
  const auto wrap = [](double a) { return a - full_turn * std::floor(a / full_turn); };
  const double width = location.to_angle - location.from_angle;
  if (std::abs(width) < tolerance || width > full_turn - tolerance) return true;  // all round
  return wrap(angle - location.from_angle + tolerance) < wrap(width);
}

bool in_range(double z, const input::LocationSpec& location) {
  return (!location.from_height || z >= *location.from_height) && (!location.to_height || z <= *location.to_height);
}

/// Middles of a limb's sections at the heights of its nodes, straight lines between them.
class NodeCentres {
 public:
  NodeCentres(const Limb& limb, const BodyMesh& mesh) {
    for (const FacetNodeNumbers& facet : mesh.skin_facets)
      for (const int n : facet)
        if (n >= 0 && !centre_.contains(mesh.nodes[n].z())) centre_[mesh.nodes[n].z()] = section_centre(*limb.skin, mesh.nodes[n].z());
  }
  Eigen::Vector2d at(double z) const {
    const auto above = centre_.lower_bound(z);
    if (above == centre_.end()) return std::prev(above)->second;
    if (above == centre_.begin() || above->first == z) return above->second;
    const auto below = std::prev(above);
    return below->second + (z - below->first) / (above->first - below->first) * (above->second - below->second);
  }

 private:
  std::map<double, Eigen::Vector2d> centre_;
};

/// Points of the skin go to the first location whose sector and range of heights hold them.
void assign_sectors(const std::vector<input::LocationSpec>& locations, const Limb& limb, BodyMesh& mesh) {
  for (const auto& location : locations) mesh.locations.push_back(location.name);
  mesh.node_location.assign(mesh.nodes.size(), -1);
  if (locations.empty()) return;
  const NodeCentres centres(limb, mesh);
  const auto at = [&](const Eigen::Vector3d& x) {
    const Eigen::Vector2d arm = x.head<2>() - centres.at(x.z());
    return location_of(locations, std::atan2(arm.y(), arm.x()), x.z());
  };
  for (const FacetNodeNumbers& facet : mesh.skin_facets)
    for (const int n : facet)
      if (n >= 0) mesh.node_location[n] = at(mesh.nodes[n]);
  mesh.location_shares = location_shares(mesh, locations.size(), [&](const Eigen::Vector3d& x, const std::array<int, 3>&) { return at(x); });
}

void assign(const input::BodySpec& spec, const Limb& limb, BodyMesh& mesh) {
  const auto round_the_limb = [](const input::LocationSpec& location) { return location.is_sector() && !location.limb; };
  if (std::all_of(spec.locations.begin(), spec.locations.end(), round_the_limb)) assign_sectors(spec.locations, limb, mesh);
  else assign_locations(spec.locations, mesh);
}

void check_cells(const BodyMesh& mesh, const Limb& limb, const input::Location& where) {
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellPositions x = cell_positions(mesh.kind, mesh.cells[c], mesh.nodes);
    for (const SamplePoint& sample : check_points(mesh.kind)) {
      if (jacobian(x, sample).determinant() > 0.0) continue;
      const Eigen::Vector3d middle = x.rowwise().mean();
      const Eigen::Vector2d from = middle.head<2>() - section_centre(*limb.skin, middle.z());
      throw input::InputError(
          where,
          fmt::format("a cell of layer \"{}\" would turn inside out at angle {:.0f} deg, height {:.1f} mm",
                      mesh.layers[mesh.cell_layer[c]].name, std::atan2(from.y(), from.x()) * 360.0 / full_turn,
                      1e3 * middle.z()),
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

CellKind kind_of(input::Elements elements) {
  return elements == input::Elements::Q1P0 ? CellKind::hex8 : elements == input::Elements::P2P1 ? CellKind::tet10 : CellKind::hex27;
}

}  // namespace

int location_of(const std::vector<input::LocationSpec>& locations, double angle, double height) {
  for (std::size_t l = 0; l < locations.size(); ++l)
    if (in_sector(angle, locations[l]) && in_range(height, locations[l])) return static_cast<int>(l);
  return -1;
}

BodyMesh make_body_mesh(const input::BodySpec& spec, const Limb& limb) {
  const Layering layering(spec);
  const Grid grid = checked_grid(spec, layering);
  Lattice lattice = make_lattice(grid.around, grid.along, layering.lattice_layers());

  BodyMesh mesh;
  mesh.nodes = positions(lattice, layering, grid, limb);
  if (layering.bone()) fill_core(grid.around, grid.along, lattice, mesh.nodes);
  mesh.cells = lattice.cells;
  mesh.cell_layer = lattice.cell_layer;
  if (const auto* bone = layering.bone()) mesh.layers.push_back({bone->name, bone->material});
  for (const auto& layer : layering.solids()) mesh.layers.push_back({layer.name, layer.material});
  for (const auto& layer : layering.membranes())
    mesh.membranes.push_back({layer.name, layer.material, *layer.thickness});
  if (spec.facets == input::Facets::flat) straighten(mesh);
  check_cells(mesh, limb, spec.where);
  collect_surfaces(lattice, grid, mesh);
  mesh.mean_skin_cell = mean_edge(mesh, mesh.skin_facets);
  const CellKind kind = kind_of(spec.elements);
  if (kind == CellKind::hex27) {
    assign(spec, limb, mesh);
    return mesh;
  }
  BodyMesh converted = convert(mesh, kind);
  check_cells(converted, limb, spec.where);
  assign(spec, limb, converted);
  return converted;
}

namespace {

/// Of the flat triangle of the corners: twice its area over the longest two edges' product, 1 for an equilateral one.
std::vector<QualityRow> shell_quality(const BodyMesh& mesh) {
  std::vector<QualityRow> rows;
  for (const Layer& layer : mesh.layers) rows.push_back({.layer = layer.name, .min_scaled_jacobian = 1.0});
  for (const ShellTriangle& triangle : mesh.shell) {
    QualityRow& row = rows[triangle.layer];
    const auto edge = [&](int a, int b) -> Eigen::Vector3d { return mesh.nodes[triangle.nodes[b]] - mesh.nodes[triangle.nodes[a]]; };
    const double area = 0.5 * edge(0, 1).cross(edge(0, 2)).norm();
    std::array<double, 3> length = {edge(0, 1).norm(), edge(1, 2).norm(), edge(2, 0).norm()};
    std::sort(length.begin(), length.end());
    const double scaled = 4.0 / std::sqrt(3.0) * area / (length[1] * length[2]);
    ++row.cells;
    row.min_scaled_jacobian = std::min(row.min_scaled_jacobian, scaled);
    row.mean_scaled_jacobian += scaled;
    row.max_aspect = std::max(row.max_aspect, length[2] / length[0]);
    row.volume += area * triangle.thickness;
  }
  for (QualityRow& row : rows) row.mean_scaled_jacobian /= std::max(row.cells, 1);
  return rows;
}

}  // namespace

std::vector<QualityRow> quality(const BodyMesh& mesh) {
  if (!mesh.shell.empty()) return shell_quality(mesh);
  std::vector<QualityRow> rows;
  for (const Layer& layer : mesh.layers) rows.push_back({.layer = layer.name, .min_scaled_jacobian = 1.0});
  // A regular tetrahedron's edge tangents span a parallelepiped of 1/sqrt(2): scaled to 1.
  const double ideal = mesh.kind == CellKind::tet10 ? std::sqrt(2.0) : 1.0;
  const double samples = static_cast<double>(check_points(mesh.kind).size());
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    QualityRow& row = rows[mesh.cell_layer[c]];
    const CellPositions x = cell_positions(mesh.kind, mesh.cells[c], mesh.nodes);
    ++row.cells;
    for (const SamplePoint& sample : check_points(mesh.kind)) {
      const Eigen::Matrix3d J = jacobian(x, sample);
      const Eigen::Vector3d edges = J.colwise().norm();
      const double scaled = ideal * J.determinant() / edges.prod();
      row.min_scaled_jacobian = std::min(row.min_scaled_jacobian, scaled);
      row.mean_scaled_jacobian += scaled / samples;  // divided by the cells below
      row.max_aspect = std::max(row.max_aspect, edges.maxCoeff() / edges.minCoeff());
      row.volume += sample.weight * J.determinant();
    }
  }
  for (QualityRow& row : rows) row.mean_scaled_jacobian /= std::max(row.cells, 1);
  return rows;
}

}  // namespace snug::mesh
