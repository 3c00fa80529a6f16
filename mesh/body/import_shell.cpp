#include <fmt/format.h>
#include <fmt/ranges.h>

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
  ShellImport(const input::BodySpec& spec, const GmshMesh& file) : spec_(spec), file_(file) {
    read_nodes();
    for (const input::LayerSpec& layer : spec.layers) read_layer(layer);
    read_sets();
  }
  Model take() { return std::move(model_); }

 private:
  void read_nodes() {
    for (std::size_t n = 0; n < file_.node_tags.size(); ++n)
      model_.nodes.push_back({static_cast<int>(file_.node_tags[n]), {file_.x[3 * n], file_.x[3 * n + 1], file_.x[3 * n + 2]}});
    std::sort(model_.nodes.begin(), model_.nodes.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  }

  void read_layer(const input::LayerSpec& layer) {
    if (layer.form != input::LayerForm::shell)
      throw InputError(layer.where, fmt::format("layer \"{}\" is {} beside a shell", layer.name, text_of(layer.form)),
                       "make every layer of the file a shell, form = \"shell\", or none");
    if (!layer.thickness)
      throw InputError(layer.where, fmt::format("the shell \"{}\" has no thickness", layer.name), "give it, e.g. thickness = \"2 mm\"");
    model_.materials.push_back({layer.name, ModelLaw::none, {}, 0.0});
    model_.sections.push_back({*layer.thickness / spec_.unit, layer.foundation * std::pow(spec_.unit, 3) / spec_.force_unit});
    std::vector<std::string> names;
    bool found = false;
    for (const GmshGroup& group : file_.groups) {
      if (group.dimension != 2) continue;
      names.push_back(group.name);
      if (group.name == layer.name) found = true, read_elements(group, layer);
    }
    if (!found)
      throw InputError(layer.where, fmt::format("{} has no physical surface \"{}\"", spec_.mesh.string(), layer.name),
                       fmt::format("its physical surfaces are: {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
  }

  void read_elements(const GmshGroup& group, const input::LayerSpec& layer) {
    for (const GmshElements& elements : file_.elements) {
      if (elements.dimension != 2 || std::count(group.entities.begin(), group.entities.end(), elements.entity) == 0) continue;
      const auto kind = surface_types().find(elements.type);
      if (kind == surface_types().end())
        throw InputError(layer.where, fmt::format("the surface \"{}\" has elements of gmsh's type {}", layer.name, elements.type),
                         "mesh it with triangles or quadrilaterals of first or (incomplete) second order");
      const int count = node_count(kind->second);
      for (std::size_t e = 0; e < elements.tags.size(); ++e) {
        ModelElement element{static_cast<int>(elements.tags[e]), kind->second, {}, static_cast<int>(model_.materials.size()) - 1,
                             static_cast<int>(model_.sections.size()) - 1};
        for (int n = 0; n < count; ++n) element.nodes.push_back(static_cast<int>(elements.nodes[count * e + n]));
        model_.elements.push_back(std::move(element));
      }
    }
  }

  void read_sets() {
    for (const GmshGroup& group : file_.groups) {
      if (group.dimension > 2) continue;
      auto& set = model_.node_sets[group.name];
      for (const std::uint64_t node : group.nodes) set.push_back(static_cast<int>(node));
      std::sort(set.begin(), set.end());
    }
  }

  const input::BodySpec& spec_;
  const GmshMesh& file_;
  Model model_;
};

}  // namespace

BodyMesh import_shell(const input::BodySpec& spec, const GmshMesh& file) { return shell_body_of(ShellImport(spec, file).take(), spec); }

}  // namespace snug::mesh
