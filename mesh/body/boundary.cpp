// Surfaces of a body mesh, and the same body in cells of another kind.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numeric>

#include "mesh/body/body_mesh.hpp"

namespace snug::mesh {

namespace {

/// The numbers of a face's nodes, -1 beyond.
FacetNodeNumbers face_nodes(const CellNodes& cell, const std::vector<int>& face) {
  FacetNodeNumbers facet;
  facet.fill(-1);
  for (std::size_t n = 0; n < face.size(); ++n) facet[n] = cell[face[n]];
  return facet;
}

/// Independent of where a facet begins and which way it turns.
FacetNodeNumbers sorted(FacetNodeNumbers facet) {
  std::sort(facet.begin(), facet.end());
  return facet;
}

std::array<int, 4> corners(FacetKind kind) {
  if (kind == FacetKind::quad9) return {0, 2, 8, 6};
  return kind == FacetKind::quad4 ? std::array{0, 1, 3, 2} : std::array{0, 1, 2, 2};
}

/// The six tetrahedra of Kuhn's subdivision: paths from corner (0, 0, 0) to (1, 1, 1) along the axes, one a permutation;
/// odd permutations swap two corners to keep a positive volume.
std::vector<std::array<std::array<int, 3>, 4>> kuhn_tetrahedra() {
  std::vector<std::array<std::array<int, 3>, 4>> list;
  std::array<int, 3> axes = {0, 1, 2};
  do {
    std::array<std::array<int, 3>, 4> path{};
    for (int step = 0; step < 3; ++step) {
      path[step + 1] = path[step];
      path[step + 1][axes[step]] = 2;
    }
    const bool even = (axes[1] == (axes[0] + 1) % 3);
    if (!even) std::swap(path[1], path[2]);
    list.push_back(path);
  } while (std::next_permutation(axes.begin(), axes.end()));
  return list;
}

int tensor(const std::array<int, 3>& at) { return 9 * at[2] + 3 * at[1] + at[0]; }

/// Local nodes of the six tetrahedra in a hexahedron of 27.
const std::vector<std::array<int, 10>>& tetrahedra_in_hexahedron() {
  static const std::vector<std::array<int, 10>> list = [] {
    std::vector<std::array<int, 10>> made;
    for (const auto& corner : kuhn_tetrahedra()) {
      auto& nodes = made.emplace_back();
      for (int a = 0; a < 10; ++a) {
        const Eigen::Vector3d r = reference_nodes(CellKind::tet10)[a];
        const Eigen::Vector4d L(1.0 - r.sum(), r[0], r[1], r[2]);
        std::array<int, 3> at{};
        for (int axis = 0; axis < 3; ++axis)
          for (int v = 0; v < 4; ++v) at[axis] += static_cast<int>(std::lround(L[v] * corner[v][axis]));
        nodes[a] = tensor(at);
      }
    }
    return made;
  }();
  return list;
}

void split_cells(const BodyMesh& from, BodyMesh& to) {
  for (std::size_t c = 0; c < from.cells.size(); ++c) {
    CellNodes cell;
    cell.fill(-1);
    if (to.kind == CellKind::hex8) {
      for (int a = 0; a < 8; ++a) cell[a] = from.cells[c][tensor({2 * (a % 2), 2 * (a / 2 % 2), 2 * (a / 4)})];
      to.cells.push_back(cell), to.cell_layer.push_back(from.cell_layer[c]);
      continue;
    }
    for (const auto& nodes : tetrahedra_in_hexahedron()) {
      for (int a = 0; a < 10; ++a) cell[a] = from.cells[c][nodes[a]];
      to.cells.push_back(cell), to.cell_layer.push_back(from.cell_layer[c]);
    }
  }
}

/// Leaves out the nodes that no cell uses.
std::vector<int> renumber(const BodyMesh& from, BodyMesh& to) {
  std::vector<int> number(from.nodes.size(), -1);
  for (const CellNodes& cell : to.cells)
    for (int a = 0; a < node_count(to.kind); ++a) number[cell[a]] = 0;
  for (std::size_t n = 0; n < number.size(); ++n)
    if (number[n] == 0) {
      number[n] = static_cast<int>(to.nodes.size());
      to.nodes.push_back(from.nodes[n]);
    }
  for (CellNodes& cell : to.cells)
    for (int a = 0; a < node_count(to.kind); ++a) cell[a] = number[cell[a]];
  return number;
}

std::vector<int> renumbered(const std::vector<int>& nodes, const std::vector<int>& number) {
  std::vector<int> list;
  for (const int node : nodes)
    if (number[node] >= 0) list.push_back(number[node]);
  return list;
}

}  // namespace

const Surface* BodyMesh::surface(const std::string& name) const {
  for (const Surface& surface : surfaces)
    if (surface.name == name) return &surface;
  const auto plain = [](std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
  };
  std::vector<const Surface*> alike;
  for (const Surface& surface : surfaces)
    if (plain(surface.name) == plain(name)) alike.push_back(&surface);
  return alike.size() == 1 ? alike[0] : nullptr;
}

namespace {

std::vector<double> edge_lengths(const BodyMesh& mesh, const std::vector<FacetNodeNumbers>& facets) {
  const FacetKind kind = facet_kind(mesh.kind);
  const auto corner = corners(kind);
  const int edges = kind == FacetKind::tri6 ? 3 : 4;
  std::vector<double> lengths;
  for (const auto& facet : facets)
    for (int e = 0; e < edges; ++e)
      lengths.push_back((mesh.nodes[facet[corner[e]]] - mesh.nodes[facet[corner[(e + 1) % edges]]]).norm());
  return lengths;
}

}  // namespace

double mean_edge(const BodyMesh& mesh, const std::vector<FacetNodeNumbers>& facets) {
  const std::vector<double> lengths = edge_lengths(mesh, facets);
  return lengths.empty() ? 0.0 : std::accumulate(lengths.begin(), lengths.end(), 0.0) / static_cast<double>(lengths.size());
}

double shortest_edge(const BodyMesh& mesh, const std::vector<FacetNodeNumbers>& facets) {
  const std::vector<double> lengths = edge_lengths(mesh, facets);
  return lengths.empty() ? 0.0 : *std::min_element(lengths.begin(), lengths.end());
}

std::vector<FacetNodeNumbers> boundary_facets(const BodyMesh& mesh, const std::vector<char>& keep) {
  std::map<FacetNodeNumbers, int> cells_at;
  std::vector<FacetNodeNumbers> facets;
  for (const CellNodes& cell : mesh.cells)
    for (const auto& face : faces(mesh.kind)) {
      if (!std::all_of(face.begin(), face.end(), [&](int a) { return keep[cell[a]]; })) continue;
      facets.push_back(face_nodes(cell, face));
      ++cells_at[sorted(facets.back())];
    }
  std::erase_if(facets, [&](const auto& facet) { return cells_at[sorted(facet)] > 1; });
  return facets;
}

BodyMesh convert(const BodyMesh& mesh, CellKind kind) {
  BodyMesh to;
  to.kind = kind;
  to.layers = mesh.layers, to.membranes = mesh.membranes;
  split_cells(mesh, to);
  const std::vector<int> number = renumber(mesh, to);
  to.bone_nodes = renumbered(mesh.bone_nodes, number);
  for (const Surface& surface : mesh.surfaces) {
    Surface& same = to.surfaces.emplace_back(Surface{surface.name, {}, renumbered(surface.nodes, number)});
    std::vector<char> keep(to.nodes.size(), 0);
    for (const int node : same.nodes) keep[node] = 1;
    same.facets = boundary_facets(to, keep);
  }
  if (const Surface* skin = to.surface("skin")) to.skin_facets = skin->facets;
  to.mean_skin_cell = mean_edge(to, to.skin_facets);
  return to;
}

}  // namespace snug::mesh
