#include "mesh/body/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <unordered_map>

#include "mesh/body/import_shell.hpp"
#include "mesh/formats/gmsh_file.hpp"
#include "mesh/body/locations.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

// gmsh's numbers of element types (its reference manual, "MSH file format").
enum GmshCell { tet4 = 4, hex8 = 5, tet10 = 11, hex27 = 12, hex20 = 17 };

/// What the file holds decides the kind, together with body.elements; straight cells have been raised to second order.
CellKind kind_of(const input::BodySpec& spec, const GmshMesh& mesh) {
  const std::string file = spec.mesh.string();
  const std::vector<int> types = mesh.types_of(3);
  if (types.empty())
    throw InputError(spec.where, file + " has no cells",
                     "save the volumes too: gmsh -3, with physical volumes; or give a geometry (.geo) that has volumes");
  const std::set<int> present(types.begin(), types.end());
  const auto only = [&](std::set<int> allowed) {
    return std::includes(allowed.begin(), allowed.end(), present.begin(), present.end());
  };
  const auto high = std::find_if(types.begin(), types.end(), [&](int type) {
    const std::string& name = mesh.type(type).name;  // "Tetrahedron 20"
    return (name.starts_with("Tetrahedron") && mesh.type(type).nodes > 10) || (name.starts_with("Hexahedron") && mesh.type(type).nodes > 27);
  });
  if (high != types.end())
    throw InputError(spec.where, fmt::format("{} has cells of third order or higher ({})", file, mesh.type(*high).name),
                     "save it with order 1 or 2: Mesh.ElementOrder = 2, or gmsh -order 2");
  if (present.count(hex20))
    throw InputError(spec.where, file + " has hexahedra of 20 nodes",
                     "save complete ones: Mesh.SecondOrderIncomplete = 0 in gmsh");
  if (present.size() > 1 || !(only({tet4, tet10}) || only({hex8, hex27}))) {
    std::vector<std::string> names;
    for (const int type : present) names.push_back(mesh.type(type).name);
    throw InputError(spec.where, fmt::format("{} has cells of the kinds {}", file, fmt::join(names, ", ")),
                     "mesh the body with hexahedra only or with tetrahedra only");
  }
  const int type = *present.begin();
  const bool tetrahedra = type == tet4 || type == tet10;
  if (tetrahedra && spec.elements == input::Elements::Q1P0)
    throw InputError(spec.where, file + " has tetrahedra, which cannot be Q1/P0", "leave elements out, or write \"P2/P1\"");
  if (!tetrahedra && spec.elements == input::Elements::P2P1)
    throw InputError(spec.where, file + " has hexahedra, which cannot be P2/P1", "leave elements out, or write \"Q1/P0\"");
  if (spec.elements == input::Elements::Q1P0) return CellKind::hex8;
  return tetrahedra ? CellKind::tet10 : CellKind::hex27;
}

int gmsh_type(CellKind kind) { return kind == CellKind::hex27 ? hex27 : kind == CellKind::hex8 ? hex8 : tet10; }

/// Where node a of ours stands among gmsh's, by the coordinates on the reference cell.
std::vector<int> gmsh_order(CellKind kind, const GmshMesh& mesh) {
  const GmshType& type = mesh.type(gmsh_type(kind));
  const std::vector<double>& local = type.local;
  std::vector<int> place;
  for (Eigen::Vector3d r : reference_nodes(kind)) {
    if (kind != CellKind::tet10) r = 2.0 * r - Eigen::Vector3d::Ones();  // gmsh's cube is [-1, 1]^3
    int n = 0;
    while (n + 1 < type.nodes && (Eigen::Vector3d(local[3 * n], local[3 * n + 1], local[3 * n + 2]) - r).norm() > 1e-6) ++n;
    place.push_back(n);
  }
  return place;
}

/// The mesh while it is taken over: gmsh's node and cell tags beside ours.
class Import {
 public:
  Import(const input::BodySpec& spec, const GmshMesh& file) : spec_(spec), file_(file) {
    mesh_.kind = kind_of(spec, file);
    read_coordinates();
    for (const input::LayerSpec& layer : spec.layers) read_layer(layer);
    check_volumes();
    check_cells();
    for (const GmshGroup& group : file_.groups)
      if (group.dimension < 3) read_surface(group);
    hold_bone();
    if (const Surface* skin = mesh_.surface("skin")) mesh_.skin_facets = skin->facets;
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    assign_locations(spec.locations, mesh_);
  }
  BodyMesh take() { return std::move(mesh_); }

 private:
  void read_coordinates() {
    for (std::size_t n = 0; n < file_.node_tags.size(); ++n)
      position_[file_.node_tags[n]] = spec_.unit * Eigen::Vector3d(file_.x[3 * n], file_.x[3 * n + 1], file_.x[3 * n + 2]);
  }

  const GmshGroup* volume(const std::string& name) const {
    for (const GmshGroup& group : file_.groups)
      if (group.dimension == 3 && group.name == name) return &group;
    return nullptr;
  }

  void read_layer(const input::LayerSpec& layer) {
    if (layer.form == input::LayerForm::membrane) {
      mesh_.membranes.push_back({layer.name, layer.material, *layer.thickness});
      return;
    }
    const GmshGroup* group = volume(layer.name);
    if (layer.form == input::LayerForm::rigid) {
      rigid_ = layer.name, rigid_where_ = layer.where;
      if (group) rigid_tags_ = group->nodes;
      return;
    }
    if (!group) {
      std::vector<std::string> names;
      for (const GmshGroup& g : file_.groups)
        if (g.dimension == 3) names.push_back(g.name);
      throw InputError(layer.where, fmt::format("{} has no physical volume \"{}\"", spec_.mesh.string(), layer.name),
                       names.empty() ? fmt::format("it has no physical volumes: write Physical Volume(\"{}\") = {{1}}; in gmsh (Physical Surface(\"skin\") for its surface) and save again", layer.name)
                                     : fmt::format("its physical volumes are: {}; groups without a name go by their number", fmt::join(names, ", ")));
    }
    const std::vector<int> order = gmsh_order(mesh_.kind, file_);
    for (const GmshElements& elements : file_.elements)
      if (elements.dimension == 3 && std::count(group->entities.begin(), group->entities.end(), elements.entity) > 0) add_cells(elements, order);
    mesh_.layers.push_back({layer.name, layer.material});
  }

  void add_cells(const GmshElements& elements, const std::vector<int>& order) {
    const auto nodes = static_cast<std::size_t>(file_.type(elements.type).nodes);
    for (std::size_t e = 0; e < elements.tags.size(); ++e) {
      CellNodes cell;
      cell.fill(-1);
      for (std::size_t a = 0; a < order.size(); ++a) cell[a] = number(elements.nodes[e * nodes + order[a]]);
      mesh_.cells.push_back(cell);
      mesh_.cell_layer.push_back(static_cast<int>(mesh_.layers.size()));
      cell_tag_.push_back(elements.tags[e]);
    }
  }

  int number(std::uint64_t tag) {
    const auto [it, fresh] = number_.emplace(tag, static_cast<int>(mesh_.nodes.size()));
    if (!fresh) return it->second;
    const auto position = position_.find(tag);
    if (position == position_.end())
      throw InputError({spec_.mesh.string(), 0, 0}, fmt::format("a cell names node {}, which the file does not have", tag), "save the mesh again from gmsh");
    mesh_.nodes.push_back(position->second);
    return it->second;
  }

  void check_volumes() const {
    for (const GmshGroup& group : file_.groups) {
      const auto named = [&](const input::LayerSpec& layer) { return layer.name == group.name; };
      if (group.dimension == 3 && std::none_of(spec_.layers.begin(), spec_.layers.end(), named))
        throw InputError(spec_.where,
                         fmt::format("the physical volume \"{}\" of {} is no layer of the case", group.name, spec_.mesh.string()),
                         fmt::format("add {{ name = \"{}\", material = ... }} to body.layers", group.name));
    }
  }

  void check_cells() const {
    for (std::size_t c = 0; c < mesh_.cells.size(); ++c) {
      const CellPositions x = cell_positions(mesh_.kind, mesh_.cells[c], mesh_.nodes);
      for (const SamplePoint& sample : check_points(mesh_.kind)) {
        if (jacobian(x, sample).determinant() > 0.0) continue;
        const Eigen::Vector3d at = 1e3 * x.rowwise().mean();
        throw InputError(spec_.where,
                         fmt::format("cell {} of layer \"{}\" near ({:.2f}, {:.2f}, {:.2f}) mm is inverted or flat",
                                     cell_tag_[c], mesh_.layers[mesh_.cell_layer[c]].name, at.x(), at.y(), at.z()),
                         "optimise the mesh in gmsh (Mesh.Optimize = 1, Mesh.HighOrderOptimize = 2) or refine it there");
      }
    }
  }

  void read_surface(const GmshGroup& group) {
    Surface surface{group.name, {}, {}};
    std::vector<char> keep(mesh_.nodes.size(), 0);
    for (const std::uint64_t tag : group.nodes)
      if (const auto it = number_.find(tag); it != number_.end()) {
        surface.nodes.push_back(it->second);
        keep[it->second] = 1;
      }
    std::sort(surface.nodes.begin(), surface.nodes.end());
    if (group.dimension == 2) surface.facets = boundary_facets(mesh_, keep);
    mesh_.surfaces.push_back(std::move(surface));
  }

  void hold_bone() {
    if (rigid_.empty()) return;
    for (const std::uint64_t tag : rigid_tags_)
      if (const auto it = number_.find(tag); it != number_.end()) mesh_.bone_nodes.push_back(it->second);
    if (const Surface* bone = mesh_.surface(rigid_); bone && rigid_tags_.empty()) mesh_.bone_nodes = bone->nodes;
    if (mesh_.bone_nodes.empty())
      throw InputError(rigid_where_, fmt::format("{} has no physical volume or surface \"{}\" that touches a layer",
                                                 spec_.mesh.string(), rigid_),
                       "name the bone's volume or its surface in gmsh like the rigid layer");
  }

  const input::BodySpec& spec_;
  const GmshMesh& file_;
  std::unordered_map<std::uint64_t, Eigen::Vector3d> position_;
  std::unordered_map<std::uint64_t, int> number_;
  std::vector<std::uint64_t> cell_tag_, rigid_tags_;
  std::string rigid_;
  input::Location rigid_where_;
  BodyMesh mesh_;
};

}  // namespace

BodyMesh import_body_mesh(const input::BodySpec& spec, GmshOptions options) {
  const auto is_shell = [](const input::LayerSpec& layer) { return layer.form == input::LayerForm::shell; };
  const bool shell = std::any_of(spec.layers.begin(), spec.layers.end(), is_shell);
  if (!shell) options.order = spec.elements == input::Elements::Q1P0 ? GmshOrder::linear : GmshOrder::quadratic;
  const GmshMesh file = read_gmsh_file(spec.mesh, options);
  if (shell) return import_shell(spec, file);
  if (spec.layers.empty())
    throw InputError(spec.where, "the body has no layers", "name the physical volumes of " + spec.mesh.string() + " in body.layers");
  return Import(spec, file).take();
}

}  // namespace snug::mesh
