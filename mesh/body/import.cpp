#include "mesh/body/import.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <unordered_map>

#include "mesh/body/import_shell.hpp"
#include "mesh/formats/gmsh_session.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

// gmsh's numbers of element types (its reference manual, "MSH file format").
enum GmshType { tet4 = 4, hex8 = 5, tet10 = 11, hex27 = 12, hex20 = 17 };

struct Group {
  std::string name;
  int dimension, tag;
};

std::vector<Group> physical_groups() {
  gmsh::vectorpair pairs;
  gmsh::model::getPhysicalGroups(pairs);
  std::vector<Group> groups;
  for (const auto& [dimension, tag] : pairs) {
    Group group{"", dimension, tag};
    gmsh::model::getPhysicalName(dimension, tag, group.name);
    groups.push_back(std::move(group));
  }
  return groups;
}

std::vector<int> entities(const Group& group) {
  std::vector<int> tags;
  gmsh::model::getEntitiesForPhysicalGroup(group.dimension, group.tag, tags);
  return tags;
}

/// A file without cells is a geometry.
void mesh_geometry(const input::BodySpec& spec) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  if (!types.empty()) return;
  try {
    gmsh::model::mesh::generate(3);
  } catch (const std::runtime_error& error) {
    throw InputError(spec.where, fmt::format("gmsh cannot mesh {}: {}", spec.mesh.string(), error.what()),
                     "mesh it in gmsh's window, where the place is shown");
  }
}

/// What the file holds decides the kind, together with body.elements; raises straight cells to second order.
CellKind prepare_kind(const input::BodySpec& spec) {
  const std::string file = spec.mesh.string();
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, 3);
  if (types.empty())
    throw InputError(spec.where, file + " has no cells",
                     "save the volumes too: gmsh -3, with physical volumes; or give a geometry (.geo) that has volumes");
  const std::set<int> present(types.begin(), types.end());
  const auto only = [&](std::set<int> allowed) {
    return std::includes(allowed.begin(), allowed.end(), present.begin(), present.end());
  };
  if (present.count(hex20))
    throw InputError(spec.where, file + " has hexahedra of 20 nodes",
                     "save complete ones: Mesh.SecondOrderIncomplete = 0 in gmsh");
  if (present.size() > 1 || !(only({tet4, tet10}) || only({hex8, hex27}))) {
    std::vector<std::string> names;
    for (const int type : present) {
      std::string name;
      int dimension, order, nodes, primary;
      std::vector<double> local;
      gmsh::model::mesh::getElementProperties(type, name, dimension, order, nodes, local, primary);
      names.push_back(name);
    }
    throw InputError(spec.where, fmt::format("{} has cells of the kinds {}", file, fmt::join(names, ", ")),
                     "mesh the body with hexahedra only or with tetrahedra only");
  }
  const int type = *present.begin();
  const bool tetrahedra = type == tet4 || type == tet10;
  if (tetrahedra && spec.elements == "Q1/P0")
    throw InputError(spec.where, file + " has tetrahedra, which cannot be Q1/P0", "leave elements out, or write \"P2/P1\"");
  if (!tetrahedra && spec.elements == "P2/P1")
    throw InputError(spec.where, file + " has hexahedra, which cannot be P2/P1", "leave elements out, or write \"Q1/P0\"");
  if (spec.elements == "Q1/P0") {
    if (type == hex27) gmsh::model::mesh::setOrder(1);
    return CellKind::hex8;
  }
  if (type == tet4 || type == hex8) gmsh::model::mesh::setOrder(2);
  return tetrahedra ? CellKind::tet10 : CellKind::hex27;
}

int gmsh_type(CellKind kind) { return kind == CellKind::hex27 ? hex27 : kind == CellKind::hex8 ? hex8 : tet10; }

/// Where node a of ours stands among gmsh's, by the coordinates on the reference cell.
std::vector<int> gmsh_order(CellKind kind) {
  std::string name;
  int dimension, order, nodes, primary;
  std::vector<double> local;
  gmsh::model::mesh::getElementProperties(gmsh_type(kind), name, dimension, order, nodes, local, primary);
  std::vector<int> place;
  for (Eigen::Vector3d r : reference_nodes(kind)) {
    if (kind != CellKind::tet10) r = 2.0 * r - Eigen::Vector3d::Ones();  // gmsh's cube is [-1, 1]^3
    int n = 0;
    while ((Eigen::Vector3d(local[3 * n], local[3 * n + 1], local[3 * n + 2]) - r).norm() > 1e-6) ++n;
    place.push_back(n);
  }
  return place;
}

/// The mesh while it is read: gmsh's node and cell tags beside ours.
class Import {
 public:
  explicit Import(const input::BodySpec& spec) : spec_(spec), groups_(physical_groups()) {
    mesh_.kind = prepare_kind(spec);
    read_coordinates();
    for (const input::LayerSpec& layer : spec.layers) read_layer(layer);
    check_volumes();
    check_cells();
    for (const Group& group : groups_)
      if (group.dimension < 3) read_surface(group);
    hold_bone();
    if (const Surface* skin = mesh_.surface("skin")) mesh_.skin_facets = skin->facets;
    mesh_.mean_skin_cell = mean_edge(mesh_, mesh_.skin_facets);
    assign_locations();
  }
  BodyMesh take() { return std::move(mesh_); }

 private:
  void read_coordinates() {
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters);
    for (std::size_t n = 0; n < tags.size(); ++n)
      position_[tags[n]] = spec_.unit * Eigen::Vector3d(x[3 * n], x[3 * n + 1], x[3 * n + 2]);
  }

  const Group* volume(const std::string& name) const {
    for (const Group& group : groups_)
      if (group.dimension == 3 && group.name == name) return &group;
    return nullptr;
  }

  void read_layer(const input::LayerSpec& layer) {
    if (layer.form == "membrane") {
      mesh_.membranes.push_back({layer.name, layer.material, *layer.thickness});
      return;
    }
    const Group* group = volume(layer.name);
    if (layer.form == "rigid") {
      rigid_ = layer.name, rigid_where_ = layer.where;
      if (group) rigid_tags_ = nodes_of(*group);
      return;
    }
    if (!group) {
      std::vector<std::string> names;
      for (const Group& g : groups_)
        if (g.dimension == 3) names.push_back(g.name);
      throw InputError(layer.where, fmt::format("{} has no physical volume \"{}\"", spec_.mesh.string(), layer.name),
                       fmt::format("its physical volumes are: {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    }
    const std::vector<int> order = gmsh_order(mesh_.kind);
    for (const int entity : entities(*group)) {
      std::vector<std::size_t> elements, nodes;
      gmsh::model::mesh::getElementsByType(gmsh_type(mesh_.kind), elements, nodes, entity);
      for (std::size_t e = 0; e < elements.size(); ++e) {
        CellNodes cell;
        cell.fill(-1);
        for (std::size_t a = 0; a < order.size(); ++a) cell[a] = number(nodes[e * order.size() + order[a]]);
        mesh_.cells.push_back(cell);
        mesh_.cell_layer.push_back(static_cast<int>(mesh_.layers.size()));
        cell_tag_.push_back(elements[e]);
      }
    }
    mesh_.layers.push_back({layer.name, layer.material});
  }

  int number(std::size_t tag) {
    const auto [it, fresh] = number_.emplace(tag, static_cast<int>(mesh_.nodes.size()));
    if (fresh) mesh_.nodes.push_back(position_.at(tag));
    return it->second;
  }

  std::vector<std::size_t> nodes_of(const Group& group) const {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates;
    gmsh::model::mesh::getNodesForPhysicalGroup(group.dimension, group.tag, tags, coordinates);
    return tags;
  }

  void check_volumes() const {
    for (const Group& group : groups_) {
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
        if (jacobian(mesh_.kind, x, sample.reference).determinant() > 0.0) continue;
        const Eigen::Vector3d at = 1e3 * x.rowwise().mean();
        throw InputError(spec_.where,
                         fmt::format("cell {} of layer \"{}\" near ({:.2f}, {:.2f}, {:.2f}) mm is inverted or flat",
                                     cell_tag_[c], mesh_.layers[mesh_.cell_layer[c]].name, at.x(), at.y(), at.z()),
                         "optimise the mesh in gmsh (Mesh.Optimize = 1, Mesh.HighOrderOptimize = 2) or refine it there");
      }
    }
  }

  void read_surface(const Group& group) {
    Surface surface{group.name, {}, {}};
    std::vector<char> keep(mesh_.nodes.size(), 0);
    for (const std::size_t tag : nodes_of(group))
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
    for (const std::size_t tag : rigid_tags_)
      if (const auto it = number_.find(tag); it != number_.end()) mesh_.bone_nodes.push_back(it->second);
    if (const Surface* bone = mesh_.surface(rigid_); bone && rigid_tags_.empty()) mesh_.bone_nodes = bone->nodes;
    if (mesh_.bone_nodes.empty())
      throw InputError(rigid_where_, fmt::format("{} has no physical volume or surface \"{}\" that touches a layer",
                                                 spec_.mesh.string(), rigid_),
                       "name the bone's volume or its surface in gmsh like the rigid layer");
  }

  /// Sectors count round the z axis through the mean of the skin's nodes.
  void assign_locations() {
    mesh_.node_location.assign(mesh_.nodes.size(), -1);
    for (const auto& location : spec_.locations) mesh_.locations.push_back(location.name);
    const Surface* skin = mesh_.surface("skin");
    if (!skin || spec_.locations.empty()) return;
    Eigen::Vector2d centre = Eigen::Vector2d::Zero();
    for (const int node : skin->nodes) centre += mesh_.nodes[node].head<2>() / static_cast<double>(skin->nodes.size());
    for (const int node : skin->nodes) {
      const Eigen::Vector3d& x = mesh_.nodes[node];
      mesh_.node_location[node] = location_of(spec_.locations, std::atan2(x.y() - centre.y(), x.x() - centre.x()), x.z());
    }
  }

  const input::BodySpec& spec_;
  std::vector<Group> groups_;
  std::unordered_map<std::size_t, Eigen::Vector3d> position_;
  std::unordered_map<std::size_t, int> number_;
  std::vector<std::size_t> cell_tag_, rigid_tags_;
  std::string rigid_;
  input::Location rigid_where_;
  BodyMesh mesh_;
};

}  // namespace

BodyMesh import_body_mesh(const input::BodySpec& spec) {
  const GmshSession session;
  try {
    gmsh::open(spec.mesh.string());
  } catch (const std::runtime_error& error) {
    throw InputError(spec.where, fmt::format("gmsh cannot read {}: {}", spec.mesh.string(), error.what()),
                     "save it from gmsh as a .msh file of version 4");
  }
  mesh_geometry(spec);
  const auto shell = [](const input::LayerSpec& layer) { return layer.form == "shell"; };
  if (std::any_of(spec.layers.begin(), spec.layers.end(), shell)) return import_shell(spec);
  if (spec.layers.empty())
    throw InputError(spec.where, "the body has no layers", "name the physical volumes of " + spec.mesh.string() + " in body.layers");
  return Import(spec).take();
}

}  // namespace snug::mesh
