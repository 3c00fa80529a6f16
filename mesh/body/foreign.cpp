#include "mesh/body/foreign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <unordered_map>

#include "mesh/body/foreign_material.hpp"
#include "mesh/body/foreign_nodes.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

/// Where the corners, edges and faces of a hexahedron stand in tensor order (9 k + 3 j + i).
constexpr std::array<int, 8> corner_place = {0, 2, 8, 6, 18, 20, 26, 24};
struct Between {
  int place;
  std::vector<int> corners;
};
const std::vector<Between>& hexahedron_edges() {
  static const std::vector<Between> edges = {{1, {0, 1}},  {5, {1, 2}},  {7, {2, 3}},  {3, {3, 0}},
                                             {19, {4, 5}}, {23, {5, 6}}, {25, {6, 7}}, {21, {7, 4}},
                                             {9, {0, 4}},  {11, {1, 5}}, {17, {2, 6}}, {15, {3, 7}}};
  return edges;
}
const std::vector<Between>& hexahedron_faces() {
  static const std::vector<Between> faces = {{4, {0, 1, 2, 3}},  {22, {4, 5, 6, 7}}, {10, {0, 1, 5, 4}},
                                             {16, {3, 2, 6, 7}}, {12, {0, 3, 7, 4}}, {14, {1, 2, 6, 5}}};
  return faces;
}
constexpr std::array<std::array<int, 2>, 6> tetrahedron_edges = {{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};

class Conversion {
 public:
  Conversion(const Model& model, const input::BodySpec& spec) : model_(model), spec_(spec), file_(spec.mesh.string()), nodes_(model, spec, mesh_) {}

  BodyMesh operator()() {
    choose_kind();
    mesh_.layers = foreign_layers(model_, spec_);
    number_nodes();
    for (const ModelElement& element : model_.elements) reserve_edges(element);
    for (const ModelElement& element : model_.elements) add_cell(element);
    check_cells();
    add_surfaces();
    nodes_.add_supports();
    nodes_.add_forces();
    add_pressures();
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    mesh_.node_location.assign(mesh_.nodes.size(), -1);
    return std::move(mesh_);
  }

 private:
  void choose_kind() {
    const ModelElement& first = model_.elements.front();
    for (const ModelElement& element : model_.elements) {
      const bool same = is_shell(element.kind) == is_shell(first.kind) && is_tetrahedron(element.kind) == is_tetrahedron(first.kind);
      if (!same)
        throw InputError({file_, model_.line_of(element.number), 1},
                         fmt::format("element {} is a {} where element {} is a {}", element.number, to_string(element.kind),
                                     first.number, to_string(first.kind)),
                         "give a body of hexahedra, of tetrahedra or of shells only");
    }
    if (is_tetrahedron(first.kind) && spec_.elements == input::Elements::Q1P0)
      throw InputError(spec_.where, file_ + " has tetrahedra, which cannot be Q1/P0", "leave elements out");
    if (!is_tetrahedron(first.kind) && spec_.elements == input::Elements::P2P1)
      throw InputError(spec_.where, file_ + " has hexahedra, which cannot be P2/P1", "leave elements out");
    mesh_.kind = is_tetrahedron(first.kind) ? CellKind::tet10 : spec_.elements == input::Elements::Q1P0 ? CellKind::hex8 : CellKind::hex27;
  }

  /// Nodes in the order of their numbers; those of no element are left out.
  void number_nodes() {
    std::set<int> used;
    for (const ModelElement& e : model_.elements)
      used.insert(e.nodes.begin(), mesh_.kind == CellKind::hex8 ? e.nodes.begin() + 8 : e.nodes.end());
    for (const int number : used) nodes_.node_of(number);
  }

  /// Mid-edge nodes of the file first, so that straight neighbours find them.
  void reserve_edges(const ModelElement& e) {
    const auto keep = [&](int a, int b, int mid) {
      nodes_.set_middle(nodes_.at(e.nodes[a]), nodes_.at(e.nodes[b]), e.nodes[mid]);
    };
    if (e.kind == ElementKind::hex20 && mesh_.kind == CellKind::hex27)
      for (int m = 0; m < 12; ++m) keep(hexahedron_edges()[m].corners[0], hexahedron_edges()[m].corners[1], 8 + m);
    if (e.kind == ElementKind::tet10)
      for (int m = 0; m < 6; ++m) keep(tetrahedron_edges[m][0], tetrahedron_edges[m][1], 4 + m);
  }

  void add_cell(const ModelElement& e) {
    CellNodes cell;
    cell.fill(-1);
    std::vector<int> corner;
    for (int c = 0; c < corner_count(e.kind); ++c) corner.push_back(nodes_.at(e.nodes[c]));
    if (mesh_.kind == CellKind::tet10) {
      std::copy(corner.begin(), corner.end(), cell.begin());
      for (int m = 0; m < 6; ++m) cell[4 + m] = nodes_.middle(corner[tetrahedron_edges[m][0]], corner[tetrahedron_edges[m][1]]);
    } else if (mesh_.kind == CellKind::hex8) {
      for (int c = 0; c < 8; ++c) cell[corner_place[c] % 3 / 2 + corner_place[c] / 3 % 3 / 2 * 2 + corner_place[c] / 18 * 4] = corner[c];
    } else {
      fill_quadratic(corner, cell);
    }
    mesh_.cells.push_back(cell);
    mesh_.cell_layer.push_back(e.material);
    cell_number_.push_back(e.number);
  }

  /// Face and centre nodes where the 20-node cell has them: minus a quarter of the corners and half (a quarter) of the
  /// mid-edge nodes (serendipity shape functions, Zienkiewicz & Taylor, The Finite Element Method, vol. 1, sec. 8.6).
  void fill_quadratic(const std::vector<int>& corner, CellNodes& cell) {
    for (int c = 0; c < 8; ++c) cell[corner_place[c]] = corner[c];
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    std::vector<int> all = corner;
    for (const Between& edge : hexahedron_edges()) {
      cell[edge.place] = nodes_.middle(corner[edge.corners[0]], corner[edge.corners[1]]);
      centre += 0.25 * mesh_.nodes[cell[edge.place]];
      all.push_back(cell[edge.place]);
    }
    for (const int c : corner) centre -= 0.25 * mesh_.nodes[c];
    for (const Between& face : hexahedron_faces()) {
      Eigen::Vector3d at = Eigen::Vector3d::Zero();
      std::vector<int> around, parents;
      for (int n = 0; n < 4; ++n) {
        const int a = corner[face.corners[n]], b = corner[face.corners[(n + 1) % 4]], mid = nodes_.middle(a, b);
        at += 0.5 * mesh_.nodes[mid] - 0.25 * mesh_.nodes[a];
        around.push_back(a), parents.insert(parents.end(), {a, mid});
      }
      cell[face.place] = nodes_.between(around, at, parents);
    }
    cell[13] = nodes_.between(corner, centre, all);
  }

  void check_cells() {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const CellPositions x = cell_positions(mesh_.kind, mesh_.cells[c], mesh_.nodes);
      for (const SamplePoint& sample : check_points(mesh_.kind))
        if (!(jacobian(x, sample).determinant() > 0.0))
          throw InputError({file_, model_.line_of(cell_number_[c]), 1}, fmt::format("element {} is inverted or flat", cell_number_[c]),
                           "correct the order of its nodes or move them");
    }
    nodes_.number_the_rest();
  }

  void add_surfaces() {
    for (const auto& [name, numbers] : model_.node_sets) {
      const std::vector<char> mark = nodes_.marked(numbers);
      Surface surface{name, boundary_facets(mesh_, mark), {}};
      for (std::size_t n = 0; n < mark.size(); ++n)
        if (mark[n]) surface.nodes.push_back(static_cast<int>(n));
      if (!surface.nodes.empty()) mesh_.surfaces.push_back(std::move(surface));
    }
    if (!mesh_.surface("skin")) {
      Surface skin{"skin", boundary_facets(mesh_, std::vector<char>(mesh_.nodes.size(), 1)), {}};
      std::set<int> nodes;
      for (const auto& facet : skin.facets)
        for (const int node : facet)
          if (node >= 0) nodes.insert(node);
      skin.nodes.assign(nodes.begin(), nodes.end());
      mesh_.surfaces.push_back(std::move(skin));
    }
    mesh_.skin_facets = mesh_.surface("skin")->facets;
  }

  void add_pressures() {
    std::unordered_map<int, std::size_t> cell_of;
    for (std::size_t c = 0; c < cell_number_.size(); ++c) cell_of[cell_number_[c]] = c;
    std::map<double, FacetPressure> by_value;
    for (const ModelPressure& pressure : model_.pressures) {
      const std::size_t c = cell_of.at(pressure.element);
      const ModelElement& element = model_.elements[c];
      std::set<int> corners;
      const auto& faces_of = model_faces(element.kind);
      if (pressure.face < 0 || pressure.face >= static_cast<int>(faces_of.size()))
        throw InputError({file_, 0, 0}, fmt::format("a pressure acts on face {} of element {}, which has {}", pressure.face + 1,
                                                    element.number, faces_of.size()), "correct the number of the face");
      for (const int a : faces_of[pressure.face]) corners.insert(nodes_.at(element.nodes[a]));
      by_value[pressure.value].facets.push_back(facet_with(mesh_.cells[c], corners));
    }
    for (auto& [value, pressure] : by_value) {
      pressure.value = value * spec_.force_unit / (spec_.unit * spec_.unit);
      mesh_.pressures.push_back(std::move(pressure));
    }
  }

  FacetNodeNumbers facet_with(const CellNodes& cell, const std::set<int>& corners) const {
    for (const auto& face : faces(mesh_.kind)) {
      FacetNodeNumbers facet;
      facet.fill(-1);
      std::size_t found = 0;
      for (std::size_t a = 0; a < face.size(); ++a) facet[a] = cell[face[a]], found += corners.contains(facet[a]);
      if (found == corners.size()) return facet;
    }
    throw std::logic_error("a face of an element is none of its cell");
  }

  const Model& model_;
  const input::BodySpec& spec_;
  std::string file_;
  BodyMesh mesh_;
  ForeignNodes nodes_;
  std::vector<int> cell_number_;
};

}  // namespace

BodyMesh body_of(const Model& model, const input::BodySpec& spec) {
  if (!spec.locations.empty())
    throw InputError(spec.locations.front().where, "locations on the body of another program are not available yet",
                     "leave [[body.locations]] out: skin.csv has the pressure at every node");
  const bool shell = is_shell(model.elements.at(0).kind);
  for (const ModelElement& element : model.elements)
    if (is_shell(element.kind) != shell)
      throw InputError({spec.mesh.string(), 0, 0}, fmt::format("element {} is a {} where element {} is a {}", element.number, to_string(element.kind),
                                                               model.elements[0].number, to_string(model.elements[0].kind)),
                       "give a body of solids or a shell");
  return shell ? shell_body_of(model, spec) : Conversion(model, spec)();
}

BodyMesh import_model(const input::BodySpec& spec) { return body_of(read_model(spec.mesh), spec); }

}  // namespace snug::mesh
