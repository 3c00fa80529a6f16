#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

namespace {

enum class Shape { none, hexahedron, tetrahedron, shell };

Shape shape_of(int ename) {
  switch (ename) {
    case 45: case 95: case 185: case 186: return Shape::hexahedron;
    case 92: case 187: case 285: return Shape::tetrahedron;
    case 63: case 93: case 181: case 281: return Shape::shell;
    default: return Shape::none;
  }
}

constexpr const char* supported =
    "snug reads hexahedra SOLID185 186 45 95, tetrahedra SOLID187 92 285 and shells SHELL63 181 281 93";

/// Kind and nodes of an element whose node list may repeat corners, as Ansys writes triangles and tetrahedra.
bool set_nodes(ModelElement& to, Shape shape, const std::vector<int>& n) {
  const std::size_t count = n.size();
  const auto as = [&](ElementKind kind, std::vector<int> nodes) {
    to.kind = kind, to.nodes = std::move(nodes);
    return std::all_of(to.nodes.begin(), to.nodes.end(), [](int node) { return node > 0; });
  };
  if (shape == Shape::shell) {
    if (count == 3) return as(ElementKind::tri3, n);
    if (count == 4) return n[2] == n[3] ? as(ElementKind::tri3, {n[0], n[1], n[2]}) : as(ElementKind::quad4, n);
    if (count == 6) return as(ElementKind::tri6, n);
    if (count == 8) return n[2] == n[3] ? as(ElementKind::tri6, {n[0], n[1], n[2], n[4], n[5], n[7]}) : as(ElementKind::quad8, n);
    return false;
  }
  if (shape == Shape::tetrahedron) {
    if (count == 4) return as(ElementKind::tet4, n);
    return count == 10 && as(ElementKind::tet10, n);
  }
  if (count == 4) return as(ElementKind::tet4, n);
  if (count == 8 && n[2] == n[3] && n[4] == n[5] && n[5] == n[6] && n[6] == n[7])
    return as(ElementKind::tet4, {n[0], n[1], n[2], n[4]});
  std::vector<int> corners(n.begin(), n.begin() + std::min<std::size_t>(count, 8));
  std::sort(corners.begin(), corners.end());
  if (std::adjacent_find(corners.begin(), corners.end()) != corners.end()) return false;  // wedge or pyramid
  if (count == 8) return as(ElementKind::hex8, n);
  return count == 20 && as(ElementKind::hex20, n);
}

std::vector<double> hyperelastic_constants(const ApdlMaterial& material) {
  const auto at = [&](std::size_t i) { return i < material.table.size() ? material.table[i] : 0.0; };
  const auto bulk = [](double d) { return 2.0 / d; };
  if (material.hyperelastic == ModelLaw::neo_hooke) return {at(0), bulk(at(1))};
  if (material.hyperelastic == ModelLaw::mooney_rivlin) return {at(0), at(1), bulk(at(2))};
  std::vector<double> constants;
  for (int t = 0; t < 2 * material.terms; ++t) constants.push_back(at(t));
  constants.push_back(bulk(at(2 * material.terms)));
  return constants;
}

class Assembly {
 public:
  Assembly(const ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics)
      : deck_(deck), file_(file), diagnostics_(diagnostics) {}

  Model operator()() {
    for (const auto& [number, at] : deck_.nodes) model_.nodes.push_back({number, at});
    for (const ApdlElement& element : deck_.elements)
      if (diagnostics_.errors().size() < 20) add(element);
    model_.supports = deck_.supports, model_.forces = deck_.forces;
    model_.node_sets = deck_.node_sets;
    finish(model_, file_, diagnostics_);
    add_pressures();
    name_materials();
    return std::move(model_);
  }

 private:
  void error(int line, std::string found, std::string remedy) {
    diagnostics_.error({file_, line, 1}, std::move(found), std::move(remedy));
  }

  void add(const ApdlElement& element) {
    const auto type = deck_.types.find(element.type);
    if (type == deck_.types.end())
      return error(element.line, fmt::format("element {} has type {}, which is not there", element.number, element.type), "give it: et,1,shell63");
    const Shape shape = shape_of(type->second);
    if (shape == Shape::none)
      return error(element.line, fmt::format("element {} is of type {}, which is not taken over", element.number, type->second), supported);
    ModelElement to{element.number, ElementKind::hex8, {}, material(element), -1};
    if (element.number < 1) return error(element.line, "an element has no number", "elements count from 1");
    if (!set_nodes(to, shape, element.nodes))
      return error(element.line, fmt::format("element {} of type {} has {} nodes, some of them the same: a wedge, a pyramid or none",
                                             element.number, type->second, element.nodes.size()), supported);
    if (shape == Shape::shell) to.section = section(element, type->second);
    model_.element_line[to.number] = element.line;
    model_.elements.push_back(std::move(to));
  }

  int material(const ApdlElement& element) {
    const auto [it, fresh] = material_.emplace(element.material, static_cast<int>(model_.materials.size()));
    if (!fresh) return it->second;
    ModelMaterial to{fmt::format("material {}", element.material), ModelLaw::none, {}, 0.0};
    const auto from = deck_.materials.find(element.material);
    if (from != deck_.materials.end()) {
      const auto& p = from->second.properties;
      const auto value = [&](const char* key, double otherwise) { return p.contains(key) ? p.at(key) : otherwise; };
      to.density = value("DENS", 0.0);
      to.law = from->second.hyperelastic != ModelLaw::none ? from->second.hyperelastic : p.contains("EX") ? ModelLaw::elastic : ModelLaw::none;
      // Ansys: PRXY is 0.3 where nothing is said; for an isotropic material NUXY is the same number.
      if (to.law == ModelLaw::elastic) to.constants = {value("EX", 0.0), value("PRXY", value("NUXY", 0.3))};
      else if (to.law != ModelLaw::none) to.constants = hyperelastic_constants(from->second);
      if (to.law != ModelLaw::none && to.law != ModelLaw::elastic && !std::isfinite(to.constants.back()))
        error(from->second.line, fmt::format("material {} is perfectly incompressible (d = 0)", element.material), "give d = 2/kappa with a bulk modulus");
    }
    model_.materials.push_back(std::move(to));
    return it->second;
  }

  int section(const ApdlElement& element, int ename) {
    ModelSection to;
    const auto real = deck_.reals.find(element.real);
    const auto shell = deck_.shell_sections.find(element.section);
    if (real != deck_.reals.end() && (ename == 63 || ename == 93 || shell == deck_.shell_sections.end())) {
      const std::vector<double>& r = real->second;
      to.thickness = r.empty() ? 0.0 : r[0];
      for (std::size_t i = 1; i < std::min<std::size_t>(r.size(), 4); ++i)
        if (r[i] != 0.0 && r[i] != r[0])
          error(element.line, fmt::format("the thickness of element {} varies", element.number), "give one thickness: the first four real constants the same");
      if (r.size() > 4 && ename == 63) to.foundation = r[4];
    } else if (shell != deck_.shell_sections.end()) {
      to.thickness = shell->second[0];
    }
    if (!(to.thickness > 0.0) || to.foundation < 0.0) {
      if (bad_sections_.insert({element.real, element.section}).second)
        error(element.line, fmt::format("the shell element {} has no thickness", element.number), "give it as a real constant, r,1,THICKNESS, or with sectype,1,shell and secdata");
      return -1;
    }
    const auto found = std::find(model_.sections.begin(), model_.sections.end(), to);
    if (found == model_.sections.end()) model_.sections.push_back(to);
    return static_cast<int>(std::find(model_.sections.begin(), model_.sections.end(), to) - model_.sections.begin());
  }

  /// Faces of Ansys: hexahedra 1 below, 2 to 5 around, 6 above; shells 1 below (along the normal), 2 above.
  void add_pressures() {
    std::map<int, const ModelElement*> by_number;
    for (const ModelElement& element : model_.elements) by_number[element.number] = &element;
    for (ModelPressure pressure : deck_.pressures) {
      const auto element = by_number.find(pressure.element);
      const ElementKind kind = element == by_number.end() ? ElementKind::hex8 : element->second->kind;
      const int faces = element == by_number.end() ? 6 : is_shell(kind) ? 2 : static_cast<int>(model_faces(kind).size());
      if (pressure.face < 1 || pressure.face > faces || element == by_number.end()) {
        error(0, fmt::format("a pressure acts on face {} of element {}, which is not there", pressure.face, pressure.element), "correct the SFE command");
        continue;
      }
      if (is_shell(kind)) {
        if (pressure.face == 2) pressure.value = -pressure.value;
        pressure.face = 0;
      } else if (is_tetrahedron(kind)) {
        pressure.face -= 1;
      } else {
        pressure.face = pressure.face == 1 ? 0 : pressure.face == 6 ? 1 : pressure.face;
      }
      model_.pressures.push_back(pressure);
    }
  }

  /// A component of exactly the elements of a material gives it its name.
  void name_materials() {
    std::map<std::vector<int>, std::string> names;
    for (const auto& [name, elements] : deck_.element_sets) names[elements] = name;
    if (names.empty()) return;
    for (std::size_t m = 0; m < model_.materials.size(); ++m) {
      std::vector<int> members;
      for (const ModelElement& element : model_.elements)
        if (element.material == static_cast<int>(m)) members.push_back(element.number);
      if (const auto it = names.find(members); it != names.end()) model_.materials[m].name = it->second;
    }
  }

  const ApdlDeck& deck_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  Model model_;
  std::map<int, int> material_;
  std::set<std::pair<int, int>> bad_sections_;
};

}  // namespace

Model model_of(const ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics) {
  return Assembly(deck, file, diagnostics)();
}

}  // namespace snug::mesh
