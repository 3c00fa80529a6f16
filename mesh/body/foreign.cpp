#include "mesh/body/foreign.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "mesh/body/foreign_forces.hpp"
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

/// A quadrilateral that meets triangles of a neighbour would leave a gap between them.
void check_joints(const Model& model, const std::string& file) {
  std::map<std::vector<int>, std::pair<const ModelElement*, int>> faces;  // by sorted corners: an element there, and how many
  for (const ModelElement& element : model.elements)
    for (const auto& places : model_faces(element.kind)) {
      std::vector<int> corners;
      for (const int a : places) corners.push_back(element.nodes[a]);
      std::sort(corners.begin(), corners.end());
      ++faces.try_emplace(std::move(corners), &element, 0).first->second.second;
    }
  for (const auto& [corners, at] : faces) {
    if (corners.size() != 4 || at.second != 1) continue;
    for (int left_out = 0; left_out < 4; ++left_out) {
      std::vector<int> triangle = corners;
      triangle.erase(triangle.begin() + left_out);
      const auto other = faces.find(triangle);
      if (other == faces.end() || other->second.second != 1) continue;
      const auto [one, two] = std::minmax(at.first, other->second.first, [](const auto* a, const auto* b) { return a->number < b->number; });
      throw InputError({file, model.line_of(two->number), 1},
                       fmt::format("element {} is a {} where element {} is a {}: a quadrilateral of one lies on a triangle of the other", two->number,
                                   to_string(two->kind), one->number, to_string(one->kind)),
                       "join hexahedra to tetrahedra by pyramids, or give a body of one kind");
    }
  }
}

class Conversion {
 public:
  Conversion(const Model& model, const input::BodySpec& spec) : model_(model), spec_(spec), file_(spec.mesh.string()), nodes_(model, spec, mesh_) {}

  BodyMesh operator()() {
    choose_kind();
    if (split_) check_joints(model_, file_);
    mesh_.layers = foreign_layers(model_, spec_);
    number_nodes();
    for (const ModelElement& element : model_.elements) reserve_edges(element);
    for (const ModelElement& element : model_.elements) {
      first_cell_.push_back(mesh_.cells.size());
      split_ ? add_tetrahedra(element) : add_cell(element);
    }
    first_cell_.push_back(mesh_.cells.size());
    check_cells();
    add_surfaces();
    nodes_.add_supports();
    nodes_.add_forces();
    spread_forces(model_, nodes_, mesh_);
    add_weights();
    add_pressures();
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    mesh_.node_location.assign(mesh_.nodes.size(), -1);
    mesh_.remarks = model_.remarks;
    return std::move(mesh_);
  }

 private:
  /// Hexahedra alone stay what they are, tetrahedra too; with wedges, pyramids or both kinds in the file all become tetrahedra.
  void choose_kind() {
    const auto all = [&](int corners) {
      return std::all_of(model_.elements.begin(), model_.elements.end(), [&](const ModelElement& e) { return corner_count(e.kind) == corners; });
    };
    const bool tetrahedra = all(4), hexahedra = all(8);
    split_ = !tetrahedra && !hexahedra;
    if (!hexahedra && spec_.elements == input::Elements::Q1P0)
      throw InputError(spec_.where, file_ + (split_ ? " has wedges, pyramids or cells of several kinds" : " has tetrahedra") + ", which cannot be Q1/P0", "leave elements out");
    if (hexahedra && spec_.elements == input::Elements::P2P1)
      throw InputError(spec_.where, file_ + " has hexahedra, which cannot be P2/P1", "leave elements out");
    mesh_.kind = !hexahedra ? CellKind::tet10 : spec_.elements == input::Elements::Q1P0 ? CellKind::hex8 : CellKind::hex27;
  }

  /// Nodes in the order of their numbers; those of no element are left out, and so are middles without a number.
  void number_nodes() {
    std::set<int> used;
    for (const ModelElement& e : model_.elements)
      used.insert(e.nodes.begin(), mesh_.kind == CellKind::hex8 ? e.nodes.begin() + 8 : e.nodes.end());
    used.erase(0);
    for (const int number : used) nodes_.node_of(number);
  }

  /// Mid-edge nodes of the file first, so that straight neighbours find them.
  void reserve_edges(const ModelElement& e) {
    if (mesh_.kind == CellKind::hex8) return;
    const auto& edges = model_edges(e.kind);
    for (std::size_t m = 0; m < edges.size(); ++m)
      if (const int middle = e.nodes[corner_count(e.kind) + m]; middle != 0)
        nodes_.set_middle(nodes_.at(e.nodes[edges[m][0]]), nodes_.at(e.nodes[edges[m][1]]), middle);
  }

  std::vector<int> corners_of(const ModelElement& e) const {
    std::vector<int> corner;
    for (int c = 0; c < corner_count(e.kind); ++c) corner.push_back(nodes_.at(e.nodes[c]));
    return corner;
  }

  void add_tetrahedron(const ModelElement& e, const std::array<int, 4>& corner) {
    CellNodes cell;
    cell.fill(-1);
    std::copy(corner.begin(), corner.end(), cell.begin());
    for (int m = 0; m < 6; ++m) {
      const auto [a, b] = model_edges(ElementKind::tet10)[m];
      cell[4 + m] = nodes_.middle(corner[a], corner[b]);
    }
    append(e, cell);
  }
  void append(const ModelElement& e, const CellNodes& cell) {
    mesh_.cells.push_back(cell);
    mesh_.cell_layer.push_back(e.material);
    cell_number_.push_back(e.number);
  }

  /// Tetrahedra from the corner of the lowest number to the faces without it, of which quadrilaterals are cut from theirs: neighbours
  /// cut a common face alike. Source: Dompierre et al., How to subdivide pyramids, prisms and hexahedra into tetrahedra, 8th
  /// International Meshing Roundtable (1999) 195-204.
  void add_tetrahedra(const ModelElement& e) {
    const std::vector<int> corner = corners_of(e);
    const int tip = static_cast<int>(std::min_element(corner.begin(), corner.end()) - corner.begin());
    add_diagonals(e, corner);
    for (const std::vector<int>& face : model_faces(e.kind)) {  // their normals point inwards
      if (std::count(face.begin(), face.end(), tip) > 0) continue;
      const auto low = std::min_element(face.begin(), face.end(), [&](int a, int b) { return corner[a] < corner[b]; }) - face.begin();
      const auto at = [&](std::size_t n) { return corner[face[(low + n) % face.size()]]; };
      for (std::size_t n = 1; n + 1 < face.size(); ++n) add_tetrahedron(e, {at(0), at(n), at(n + 1), corner[tip]});
    }
  }
  /// The middles of the cuts where the element has them.
  void add_diagonals(const ModelElement& e, const std::vector<int>& corner) {
    for (const std::vector<int>& face : model_faces(e.kind)) {
      if (face.size() != 4) continue;
      const auto low = std::min_element(face.begin(), face.end(), [&](int a, int b) { return corner[a] < corner[b]; }) - face.begin();
      Eigen::Vector3d at;
      std::vector<int> parents;
      face_middle(corner, face, at, parents);
      nodes_.between({corner[face[low]], corner[face[(low + 2) % 4]]}, at, parents);
    }
    if (corner.size() < 8) return;
    const int tip = static_cast<int>(std::min_element(corner.begin(), corner.end()) - corner.begin());
    std::vector<int> parents;
    const Eigen::Vector3d centre = middle_of_hexahedron(corner, parents);
    nodes_.between({corner[tip], corner[tip < 4 ? (tip + 2) % 4 + 4 : (tip - 2) % 4]}, centre, parents);
  }

  void add_cell(const ModelElement& e) {
    const std::vector<int> corner = corners_of(e);
    if (mesh_.kind == CellKind::tet10) return add_tetrahedron(e, {corner[0], corner[1], corner[2], corner[3]});
    CellNodes cell;
    cell.fill(-1);
    if (mesh_.kind == CellKind::hex8) {
      for (int c = 0; c < 8; ++c) cell[corner_place[c] % 3 / 2 + corner_place[c] / 3 % 3 / 2 * 2 + corner_place[c] / 18 * 4] = corner[c];
    } else {
      fill_quadratic(corner, cell);
    }
    append(e, cell);
  }

  /// Face and centre nodes where the 20-node cell has them: minus a quarter of the corners and half (a quarter) of the
  /// mid-edge nodes (serendipity shape functions, Zienkiewicz & Taylor, The Finite Element Method, vol. 1, sec. 8.6).
  void fill_quadratic(const std::vector<int>& corner, CellNodes& cell) {
    for (int c = 0; c < 8; ++c) cell[corner_place[c]] = corner[c];
    std::vector<int> all;
    const Eigen::Vector3d centre = middle_of_hexahedron(corner, all);
    for (const Between& edge : hexahedron_edges()) cell[edge.place] = nodes_.middle(corner[edge.corners[0]], corner[edge.corners[1]]);
    for (const Between& face : hexahedron_faces()) {
      Eigen::Vector3d at;
      std::vector<int> parents, around;
      face_middle(corner, face.corners, at, parents);
      for (const int c : face.corners) around.push_back(corner[c]);
      cell[face.place] = nodes_.between(around, at, parents);
    }
    cell[13] = nodes_.between(corner, centre, all);
  }
  void face_middle(const std::vector<int>& corner, const std::vector<int>& face, Eigen::Vector3d& at, std::vector<int>& parents) {
    at.setZero();
    for (int n = 0; n < 4; ++n) {
      const int a = corner[face[n]], b = corner[face[(n + 1) % 4]], mid = nodes_.middle(a, b);
      at += 0.5 * mesh_.nodes[mid] - 0.25 * mesh_.nodes[a];
      parents.insert(parents.end(), {a, mid});
    }
  }
  Eigen::Vector3d middle_of_hexahedron(const std::vector<int>& corner, std::vector<int>& parents) {
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    parents = corner;
    for (const Between& edge : hexahedron_edges()) {
      const int middle = nodes_.middle(corner[edge.corners[0]], corner[edge.corners[1]]);
      centre += 0.25 * mesh_.nodes[middle];
      parents.push_back(middle);
    }
    for (const int c : corner) centre -= 0.25 * mesh_.nodes[c];
    return centre;
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

  /// Consistent nodal forces  int N_a rho g dV  of the elements on which an acceleration acts.
  void add_weights() {
    std::map<int, Eigen::Vector3d> acceleration, forces;
    for (const ModelWeight& weight : model_.weights) acceleration.try_emplace(weight.element, Eigen::Vector3d::Zero()).first->second += weight.acceleration;
    const double to_si = spec_.force_unit / std::pow(spec_.unit, 3);  // of a force per volume
    for (std::size_t e = 0; e < model_.elements.size(); ++e)
      if (const auto at = acceleration.find(model_.elements[e].number); at != acceleration.end())
        for (std::size_t c = first_cell_[e]; c < first_cell_[e + 1]; ++c) add_weight(mesh_.cells[c], to_si * model_.materials[model_.elements[e].material].density * at->second, forces);
    for (const auto& [node, force] : forces) mesh_.forces.push_back({node, force});
  }
  void add_weight(const CellNodes& cell, const Eigen::Vector3d& per_volume, std::map<int, Eigen::Vector3d>& forces) const {
    const CellPositions x = cell_positions(mesh_.kind, cell, mesh_.nodes);
    for (const SamplePoint& point : gauss_points(mesh_.kind)) {
      const double volume = point.weight * jacobian(x, point).determinant();
      for (int a = 0; a < node_count(mesh_.kind); ++a) forces.try_emplace(cell[a], Eigen::Vector3d::Zero()).first->second += point.values[a] * volume * per_volume;
    }
  }

  void add_pressures() {
    std::unordered_map<int, std::size_t> place;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) place[model_.elements[e].number] = e;
    std::map<double, FacetPressure> by_value;
    for (const ModelPressure& pressure : model_.pressures) {
      const std::size_t e = place.at(pressure.element);
      const ModelElement& element = model_.elements[e];
      std::set<int> corners;
      const auto& faces_of = model_faces(element.kind);
      if (pressure.face < 0 || pressure.face >= static_cast<int>(faces_of.size()))
        throw InputError({file_, 0, 0}, fmt::format("a pressure acts on face {} of element {}, which has {}", pressure.face + 1,
                                                    element.number, faces_of.size()), "correct the number of the face");
      for (const int a : faces_of[pressure.face]) corners.insert(nodes_.at(element.nodes[a]));
      add_facets(e, corners, by_value[pressure.value].facets);
    }
    for (auto& [value, pressure] : by_value) {
      pressure.value = value * spec_.force_unit / (spec_.unit * spec_.unit);
      mesh_.pressures.push_back(std::move(pressure));
    }
  }

  /// The facets of an element's cells whose corners are among these: one, or two of a quadrilateral that has been cut.
  void add_facets(std::size_t element, const std::set<int>& corners, std::vector<FacetNodeNumbers>& facets) const {
    const std::size_t due = mesh_.kind == CellKind::tet10 ? 3 : 4;
    for (std::size_t c = first_cell_[element]; c < first_cell_[element + 1]; ++c)
      for (const auto& face : faces(mesh_.kind)) {
        FacetNodeNumbers facet;
        facet.fill(-1);
        std::size_t found = 0;
        for (std::size_t a = 0; a < face.size(); ++a) facet[a] = mesh_.cells[c][face[a]], found += corners.contains(facet[a]);
        if (found == due) facets.push_back(facet);
      }
  }

  const Model& model_;
  const input::BodySpec& spec_;
  std::string file_;
  BodyMesh mesh_;
  ForeignNodes nodes_;
  std::vector<int> cell_number_;
  std::vector<std::size_t> first_cell_;  ///< of each element, and one more
  bool split_ = false;
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

BodyMesh import_model(const input::BodySpec& spec, const std::filesystem::path& root) { return body_of(read_model(spec.mesh, root, spec.load_step.value_or(0)), spec); }

}  // namespace snug::mesh
