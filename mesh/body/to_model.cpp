#include "mesh/body/to_model.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <stdexcept>

namespace snug::mesh {

namespace {

/// Place in tensor order (9 k + 3 j + i) of the twenty nodes: corners below (k = 0) and above, then the middles of the
/// edges below, above and upright. The same for the corners of an 8-node cell (4 k + 2 j + i).
constexpr std::array<int, 20> twenty = {0, 2, 8, 6, 18, 20, 26, 24, 1, 5, 7, 3, 19, 23, 25, 21, 9, 11, 17, 15};
constexpr std::array<int, 8> eight = {0, 1, 3, 2, 4, 5, 7, 6};
/// Faces of the 27-node cell: the node amid them, their corners and their mid-edge nodes.
struct Face {
  int middle;
  std::array<int, 4> corners, edges;
};
constexpr std::array<Face, 6> face_nodes = {{{4, {0, 2, 8, 6}, {1, 5, 7, 3}},
                                             {22, {18, 20, 26, 24}, {19, 23, 25, 21}},
                                             {10, {0, 2, 20, 18}, {1, 11, 19, 9}},
                                             {16, {6, 8, 26, 24}, {7, 17, 25, 15}},
                                             {12, {0, 6, 24, 18}, {3, 15, 21, 9}},
                                             {14, {2, 8, 26, 20}, {5, 17, 23, 11}}}};

ElementKind element_kind(const BodyMesh& body) {
  if (!body.shell.empty()) return ElementKind::tri6;
  return body.kind == CellKind::hex27 ? ElementKind::hex20 : body.kind == CellKind::hex8 ? ElementKind::hex8 : ElementKind::tet10;
}

class Export {
 public:
  Export(const BodyMesh& body, const std::vector<ModelMaterial>& materials) : body_(body), kind_(element_kind(body)) {
    if (materials.size() != body.layers.size()) throw std::invalid_argument("one material a layer is needed");
    model_.materials = materials;
    if (body.shell.empty())
      for (std::size_t c = 0; c < body.cells.size(); ++c) add_cell(static_cast<int>(c));
    else
      for (const ShellTriangle& triangle : body.shell) add_triangle(triangle);
    std::set<int> used;
    for (const ModelElement& element : model_.elements) used.insert(element.nodes.begin(), element.nodes.end());
    for (std::size_t n = 0; n < body.nodes.size(); ++n)
      if (used.contains(number(static_cast<int>(n)))) model_.nodes.push_back({number(static_cast<int>(n)), body.nodes[n]});
    std::sort(model_.nodes.begin(), model_.nodes.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
    used_ = std::move(used);
    for (const Surface& surface : body.surfaces)
      for (const int node : surface.nodes)
        if (used_.contains(number(node))) model_.node_sets[surface.name].push_back(number(node));
    for (auto& [name, nodes] : model_.node_sets) std::sort(nodes.begin(), nodes.end());
  }

  void hold(const std::vector<HeldComponent>& held) {
    std::set<std::pair<int, int>> seen;
    for (const HeldComponent& one : held)
      if (used_.contains(number(one.node)) && seen.insert({one.node, one.component}).second)
        model_.supports.push_back({number(one.node), one.component, one.displacement});
    for (const HeldRotation& one : body_.held_rotations)
      model_.supports.push_back({number(one.node), 3 + one.component, 0.0});
  }

  void push(std::vector<Eigen::Vector3d> forces) {
    if (forces.empty()) return;
    if (kind_ == ElementKind::hex20) spread(forces);
    for (std::size_t n = 0; n < forces.size(); ++n)
      for (int c = 0; c < 3; ++c)
        if (forces[n][c] != 0.0) model_.forces.push_back({number(static_cast<int>(n)), c, forces[n][c]});
  }

  void press(const FacetPressure& pressure) {
    if (places_.empty()) find_faces();
    for (const FacetNodeNumbers& facet : pressure.facets) {
      std::set<int> corners;
      const int count = body_.kind == CellKind::hex27 ? 9 : node_count(facet_kind(body_.kind));
      if (body_.kind == CellKind::hex27) corners = {facet[0], facet[2], facet[6], facet[8]};
      else for (int a = 0; a < (count == 4 ? 4 : 3); ++a) corners.insert(facet[a]);
      const auto [element, face, sign] = places_.at(corners);
      model_.pressures.push_back({element, face, sign * pressure.value});
    }
  }

  Model take() { return std::move(model_); }

 private:
  struct Place {
    int element, face;
    double sign;  ///< of shells -1: a pressure acts against the normal, the model's along it
  };

  int number(int node) const { return body_.node_numbers.empty() ? node + 1 : body_.node_numbers[node]; }

  void add_cell(int c) {
    ModelElement element{c + 1, kind_, {}, body_.cell_layer[c], -1};
    const auto add = [&](int a) { element.nodes.push_back(number(body_.cells[c][a])); };
    if (kind_ == ElementKind::hex20) std::for_each(twenty.begin(), twenty.end(), add);
    if (kind_ == ElementKind::hex8) std::for_each(eight.begin(), eight.end(), add);
    if (kind_ == ElementKind::tet10)
      for (int a = 0; a < 10; ++a) add(a);
    model_.elements.push_back(std::move(element));
  }

  void add_triangle(const ShellTriangle& triangle) {
    const ModelSection section{triangle.thickness, triangle.foundation};
    auto found = std::find(model_.sections.begin(), model_.sections.end(), section);
    if (found == model_.sections.end()) found = model_.sections.insert(found, section);
    ModelElement element{static_cast<int>(model_.elements.size()) + 1, kind_, {}, triangle.layer,
                         static_cast<int>(found - model_.sections.begin())};
    for (int a = 0; a < 6; ++a) element.nodes.push_back(number(triangle.nodes[a]));
    model_.elements.push_back(std::move(element));
  }

  /// Serendipity shape functions at the middle of a face: -1/4 at corners, 1/2 at mid-edge nodes; of the cell: -1/4 and
  /// 1/4 (Zienkiewicz & Taylor, vol. 1, sec. 8.6).
  void spread(std::vector<Eigen::Vector3d>& forces) const {
    for (const CellNodes& cell : body_.cells) {
      const auto give = [&](int from, auto weight) {
        Eigen::Vector3d& force = forces[cell[from]];
        if (force.isZero(0.0)) return;
        weight(force);
        force.setZero();
      };
      give(13, [&](const Eigen::Vector3d& force) {
        for (std::size_t n = 0; n < 20; ++n) forces[cell[twenty[n]]] += (n < 8 ? -0.25 : 0.25) * force;
      });
      for (const Face& face : face_nodes)
        give(face.middle, [&](const Eigen::Vector3d& force) {
          for (const int a : face.corners) forces[cell[a]] -= 0.25 * force;
          for (const int a : face.edges) forces[cell[a]] += 0.5 * force;
        });
    }
  }

  /// Elements and faces by the corners of the face.
  void find_faces() {
    std::map<int, int> index;
    for (std::size_t n = 0; n < body_.nodes.size(); ++n) index[number(static_cast<int>(n))] = static_cast<int>(n);
    for (const ModelElement& element : model_.elements) {
      const auto& faces = model_faces(kind_);
      for (std::size_t f = 0; f < faces.size(); ++f) {
        std::set<int> corners;
        for (const int a : faces[f]) corners.insert(index.at(element.nodes[a]));
        places_[corners] = {element.number, static_cast<int>(f), is_shell(kind_) ? -1.0 : 1.0};
      }
    }
  }

  const BodyMesh& body_;
  ElementKind kind_;
  Model model_;
  std::set<int> used_;
  std::map<std::set<int>, Place> places_;
};

}  // namespace

Model model_of(const BodyMesh& body, const std::vector<ModelMaterial>& materials, const BodyLoads& loads) {
  Export to(body, materials);
  to.hold(loads.held);
  to.push(loads.forces);
  for (const FacetPressure& pressure : loads.pressures) to.press(pressure);
  return to.take();
}

}  // namespace snug::mesh
