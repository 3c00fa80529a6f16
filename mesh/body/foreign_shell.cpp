#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "mesh/body/foreign_forces.hpp"
#include "mesh/body/foreign_material.hpp"
#include "mesh/body/foreign_nodes.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

class ShellConversion {
 public:
  ShellConversion(const Model& model, const input::BodySpec& spec)
      : model_(model), spec_(spec), file_(spec.mesh.string()), nodes_(model, spec, mesh_) {}

  BodyMesh operator()() {
    mesh_.kind = CellKind::tet10;  // its facets are the shell's triangles
    mesh_.layers = foreign_layers(model_, spec_);
    std::set<int> used;
    for (const ModelElement& element : model_.elements) used.insert(element.nodes.begin(), element.nodes.end());
    used.erase(0);
    for (const int number : used) nodes_.node_of(number);
    for (const ModelElement& element : model_.elements) add(element);
    check_areas();
    turn_alike();
    nodes_.number_the_rest();
    add_surfaces();
    nodes_.add_supports();
    nodes_.add_forces();
    spread_forces(model_, nodes_, mesh_);
    add_pressures();
    mesh_.remarks = model_.remarks;
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    mesh_.node_location.assign(mesh_.nodes.size(), -1);
    return std::move(mesh_);
  }

 private:
  void add(const ModelElement& e) {
    const int corners = corner_count(e.kind);
    std::vector<int> corner;
    for (int c = 0; c < corners; ++c) corner.push_back(nodes_.at(e.nodes[c]));
    const std::set<int> apart(corner.begin(), corner.end());
    if (static_cast<int>(apart.size()) < corners)
      throw InputError({file_, model_.line_of(e.number), 1}, fmt::format("element {} has a corner twice", e.number), "give it corners apart");
    if (node_count(e.kind) > corners)
      for (int m = 0; m < corners; ++m)
        if (e.nodes[corners + m] != 0) nodes_.set_middle(corner[m], corner[(m + 1) % corners], e.nodes[corners + m]);
    if (corners == 3) return add_triangle(e, {corner[0], corner[1], corner[2]});
    // The middle of the cut lies where the quadrilateral has it (serendipity or bilinear), on the shorter diagonal.
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (int c = 0; c < 4; ++c) {
      const int middle = nodes_.middle(corner[c], corner[(c + 1) % 4]);  // before the nodes are looked at: it may add one
      centre += 0.5 * mesh_.nodes[middle] - 0.25 * mesh_.nodes[corner[c]];
    }
    const auto distance = [&](int a, int b) { return (mesh_.nodes[corner[a]] - mesh_.nodes[corner[b]]).norm(); };
    const int first = distance(0, 2) <= distance(1, 3) * (1.0 + 1e-9) ? 0 : 1;
    const auto at = [&](int c) { return corner[(first + c) % 4]; };
    nodes_.between({at(0), at(2)}, centre, corner);
    add_triangle(e, {at(0), at(1), at(2)});
    add_triangle(e, {at(0), at(2), at(3)});
  }

  void add_triangle(const ModelElement& e, const std::array<int, 3>& corner) {
    ShellTriangle triangle;
    triangle.nodes.fill(-1);
    for (int c = 0; c < 3; ++c) triangle.nodes[c] = corner[c], triangle.nodes[3 + c] = nodes_.middle(corner[c], corner[(c + 1) % 3]);
    triangle.layer = e.material;
    triangle.thickness = spec_.unit * model_.sections[e.section].thickness;
    triangle.foundation = spec_.force_unit / std::pow(spec_.unit, 3) * model_.sections[e.section].foundation;
    mesh_.shell.push_back(triangle);
    element_.push_back(e.number);
  }

  void check_areas() const {
    for (std::size_t t = 0; t < mesh_.shell.size(); ++t) {
      const auto& n = mesh_.shell[t].nodes;
      const Eigen::Vector3d a = mesh_.nodes[n[1]] - mesh_.nodes[n[0]], b = mesh_.nodes[n[2]] - mesh_.nodes[n[0]];
      if (!(a.cross(b).norm() > 1e-8 * (a.squaredNorm() + b.squaredNorm())))
        throw InputError({file_, model_.line_of(element_[t]), 1}, fmt::format("element {} has no area", element_[t]),
                         "move its nodes apart or leave it out");
    }
  }

  /// Neighbours run along their edge against each other; from the first triangle of each piece on, others are turned round.
  void turn_alike() {
    std::map<std::pair<int, int>, std::vector<int>> at_edge;
    for (std::size_t t = 0; t < mesh_.shell.size(); ++t)
      for (int e = 0; e < 3; ++e) at_edge[ends(static_cast<int>(t), e)].push_back(static_cast<int>(t));
    for (const auto& [edge, around] : at_edge)
      if (around.size() > 2)
        throw InputError({file_, model_.line_of(element_[around[2]]), 1},
                         fmt::format("elements {}, {} and {} share an edge", element_[around[0]], element_[around[1]], element_[around[2]]),
                         "a shell is one surface: take the branch away");
    turned_.assign(mesh_.shell.size(), 0);
    std::vector<char> seen(mesh_.shell.size(), 0);
    for (std::size_t start = 0; start < seen.size(); ++start) {
      if (seen[start]) continue;
      std::vector<int> open = {static_cast<int>(start)};
      seen[start] = 1;
      while (!open.empty()) {
        const int t = open.back();
        open.pop_back();
        for (int e = 0; e < 3; ++e)
          for (const int other : at_edge.at(ends(t, e))) {
            if (other == t) continue;
            const bool against = runs_along(t, ends(t, e)) == runs_along(other, ends(t, e));
            if (seen[other] && against)
              throw InputError({file_, model_.line_of(element_[other]), 1}, fmt::format("the surface has one side only near element {}", element_[other]),
                               "a shell has a top and a bottom: cut the surface");
            if (seen[other]) continue;
            if (against) turn(other);
            seen[other] = 1;
            open.push_back(other);
          }
      }
    }
  }
  std::pair<int, int> ends(int t, int e) const {
    const auto& n = mesh_.shell[t].nodes;
    return std::minmax(n[e], n[(e + 1) % 3]);
  }
  bool runs_along(int t, const std::pair<int, int>& edge) const {
    const auto& n = mesh_.shell[t].nodes;
    for (int e = 0; e < 3; ++e)
      if (n[e] == edge.first && n[(e + 1) % 3] == edge.second) return true;
    return false;
  }
  void turn(int t) {
    auto& n = mesh_.shell[t].nodes;
    std::swap(n[1], n[2]), std::swap(n[3], n[5]);
    turned_[t] = 1;
  }

  void add_surfaces() {
    Surface skin{"skin", {}, {}};
    for (const ShellTriangle& triangle : mesh_.shell) skin.facets.push_back(triangle.nodes);
    for (std::size_t n = 0; n < mesh_.nodes.size(); ++n) skin.nodes.push_back(static_cast<int>(n));
    mesh_.skin_facets = skin.facets;
    for (const auto& [name, numbers] : model_.node_sets) {
      const std::vector<char> mark = nodes_.marked(numbers);
      Surface surface{name, {}, {}};
      for (std::size_t n = 0; n < mark.size(); ++n)
        if (mark[n]) surface.nodes.push_back(static_cast<int>(n));
      for (const ShellTriangle& triangle : mesh_.shell)
        if (std::all_of(triangle.nodes.begin(), triangle.nodes.begin() + 6, [&](int node) { return mark[node] != 0; }))
          surface.facets.push_back(triangle.nodes);
      if (!surface.nodes.empty() && name != "skin") mesh_.surfaces.push_back(std::move(surface));
    }
    mesh_.surfaces.push_back(std::move(skin));
  }

  /// The file's pressures act along the normal of the element as it stood there.
  void add_pressures() {
    std::map<int, double> value;
    for (const ModelPressure& pressure : model_.pressures) value[pressure.element] += pressure.value;
    std::map<double, FacetPressure> by_value;
    for (std::size_t t = 0; t < mesh_.shell.size(); ++t)
      if (const auto it = value.find(element_[t]); it != value.end())
        by_value[turned_[t] ? it->second : -it->second].facets.push_back(mesh_.shell[t].nodes);
    for (auto& [pressure, facets] : by_value) {
      facets.value = pressure * spec_.force_unit / (spec_.unit * spec_.unit);
      mesh_.pressures.push_back(std::move(facets));
    }
  }

  const Model& model_;
  const input::BodySpec& spec_;
  std::string file_;
  BodyMesh mesh_;
  ForeignNodes nodes_;
  std::vector<int> element_;  ///< number of each triangle's element
  std::vector<char> turned_;
};

}  // namespace

BodyMesh shell_body_of(const Model& model, const input::BodySpec& spec) { return ShellConversion(model, spec)(); }

}  // namespace snug::mesh
