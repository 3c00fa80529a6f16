#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "mesh/body/foreign_nodes.hpp"
#include "mesh/body/import_shell.hpp"

namespace snug::mesh {

namespace {

using input::InputError;

/// gmsh's element types of surfaces in ours; their node order is the same.
const std::map<int, ElementKind>& surface_types() {
  static const std::map<int, ElementKind> types = {
      {2, ElementKind::tri3}, {3, ElementKind::quad4}, {9, ElementKind::tri6}, {16, ElementKind::quad8}};
  return types;
}

class ShellImport {
 public:
  explicit ShellImport(const input::BodySpec& spec) : spec_(spec) {
    read_nodes();
    for (const input::LayerSpec& layer : spec.layers) read_layer(layer);
    read_sets();
  }
  Model take() { return std::move(model_); }

 private:
  void read_nodes() {
    std::vector<std::size_t> tags;
    std::vector<double> x, parameters;
    gmsh::model::mesh::getNodes(tags, x, parameters);
    for (std::size_t n = 0; n < tags.size(); ++n)
      model_.nodes.push_back({static_cast<int>(tags[n]), {x[3 * n], x[3 * n + 1], x[3 * n + 2]}});
    std::sort(model_.nodes.begin(), model_.nodes.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  }

  void read_layer(const input::LayerSpec& layer) {
    if (layer.form != "shell")
      throw InputError(layer.where, fmt::format("layer \"{}\" is {} beside a shell", layer.name, layer.form),
                       "make every layer of the file a shell, form = \"shell\", or none");
    if (!layer.thickness)
      throw InputError(layer.where, fmt::format("the shell \"{}\" has no thickness", layer.name), "give it, e.g. thickness = \"2 mm\"");
    model_.materials.push_back({layer.name, ModelLaw::none, {}, 0.0});
    model_.sections.push_back({*layer.thickness / spec_.unit, layer.foundation * std::pow(spec_.unit, 3) / spec_.force_unit});
    std::vector<std::string> names;
    bool found = false;
    for (const auto& [dimension, tag] : groups(2)) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      names.push_back(name);
      if (name == layer.name) found = true, read_elements(tag, layer);
    }
    if (!found)
      throw InputError(layer.where, fmt::format("{} has no physical surface \"{}\"", spec_.mesh.string(), layer.name),
                       fmt::format("its physical surfaces are: {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }

  void read_elements(int group, const input::LayerSpec& layer) {
    std::vector<int> entities;
    gmsh::model::getEntitiesForPhysicalGroup(2, group, entities);
    for (const int entity : entities) {
      std::vector<int> types;
      gmsh::model::mesh::getElementTypes(types, 2, entity);
      for (const int type : types) {
        const auto kind = surface_types().find(type);
        if (kind == surface_types().end())
          throw InputError(layer.where, fmt::format("the surface \"{}\" has elements of gmsh's type {}", layer.name, type),
                           "mesh it with triangles or quadrilaterals of first or (incomplete) second order");
        std::vector<std::size_t> elements, nodes;
        gmsh::model::mesh::getElementsByType(type, elements, nodes, entity);
        const int count = node_count(kind->second);
        for (std::size_t e = 0; e < elements.size(); ++e) {
          ModelElement element{static_cast<int>(elements[e]), kind->second, {}, static_cast<int>(model_.materials.size()) - 1,
                               static_cast<int>(model_.sections.size()) - 1};
          for (int n = 0; n < count; ++n) element.nodes.push_back(static_cast<int>(nodes[count * e + n]));
          model_.elements.push_back(std::move(element));
        }
      }
    }
  }

  void read_sets() {
    for (const int dimension : {0, 1, 2})
      for (const auto& [d, tag] : groups(dimension)) {
        std::string name;
        gmsh::model::getPhysicalName(d, tag, name);
        std::vector<std::size_t> tags;
        std::vector<double> x;
        gmsh::model::mesh::getNodesForPhysicalGroup(d, tag, tags, x);
        auto& set = model_.node_sets[name];
        for (const std::size_t node : tags) set.push_back(static_cast<int>(node));
        std::sort(set.begin(), set.end());
      }
  }

  static gmsh::vectorpair groups(int dimension) {
    gmsh::vectorpair pairs;
    gmsh::model::getPhysicalGroups(pairs, dimension);
    return pairs;
  }

  const input::BodySpec& spec_;
  Model model_;
};

}  // namespace

BodyMesh import_shell(const input::BodySpec& spec) { return shell_body_of(ShellImport(spec).take(), spec); }

}  // namespace snug::mesh
