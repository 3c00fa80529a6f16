#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

namespace {

enum class Shape { none, hexahedron, tetrahedron, shell, surface };

Shape shape_of(int ename) {
  switch (ename) {
    case 45: case 95: case 185: case 186: return Shape::hexahedron;
    case 92: case 187: case 285: return Shape::tetrahedron;
    case 63: case 93: case 181: case 281: return Shape::shell;
    case 154: return Shape::surface;
    default: return Shape::none;
  }
}

constexpr const char* supported =
    "snug reads solids SOLID185 186 45 95 (also as wedges, pyramids and tetrahedra), tetrahedra SOLID187 92 285, shells SHELL63 181 281 93, and "
    "pressures on SURF154";

/// The nodes that stand at these places.
std::vector<int> picked(const std::vector<int>& from, std::initializer_list<int> places) {
  std::vector<int> nodes;
  for (const int place : places) nodes.push_back(from[place]);
  return nodes;
}

/// An element without one of its middles is as good as one with corners only.
void leave_missing_middles_out(ModelElement& element) {
  const auto corners = element.nodes.begin() + corner_count(element.kind);
  if (corners == element.nodes.end() || std::any_of(corners, element.nodes.end(), [](int node) { return node != 0; })) return;
  element.nodes.erase(corners, element.nodes.end());
  static const std::map<ElementKind, ElementKind> straight = {
      {ElementKind::tet10, ElementKind::tet4}, {ElementKind::hex20, ElementKind::hex8},   {ElementKind::wedge15, ElementKind::wedge6},
      {ElementKind::pyramid13, ElementKind::pyramid5}, {ElementKind::tri6, ElementKind::tri3}, {ElementKind::quad8, ElementKind::quad4}};
  element.kind = straight.at(element.kind);
}

/// Kind and nodes of an element whose node list may repeat corners, as Ansys writes triangles (KK), tetrahedra (IJKK MMMM), wedges
/// (IJKK MNOO) and pyramids (IJKL MMMM); middles follow in the order of the hexahedron's edges. Middles left out at the end are 0.
bool set_nodes(ModelElement& to, Shape shape, std::vector<int> n) {
  std::size_t count = n.size();
  const auto as = [&](ElementKind kind, std::vector<int> nodes) {
    to.kind = kind, to.nodes = std::move(nodes);
    const bool whole = std::all_of(to.nodes.begin(), to.nodes.begin() + corner_count(kind), [](int node) { return node > 0; });
    const std::set<int> apart(to.nodes.begin(), to.nodes.begin() + corner_count(kind));
    leave_missing_middles_out(to);
    return whole && static_cast<int>(apart.size()) == corner_count(kind);
  };
  const auto filled = [&](std::size_t full) { n.resize(full, 0), count = full; };
  if (shape == Shape::shell || shape == Shape::surface) {
    if (count == 3) return as(ElementKind::tri3, n);
    if (count == 4) return n[2] == n[3] ? as(ElementKind::tri3, {n[0], n[1], n[2]}) : as(ElementKind::quad4, n);
    if (count == 6) return as(ElementKind::tri6, n);
    if (count < 5 || count > 8) return false;
    filled(8);
    return n[2] == n[3] ? as(ElementKind::tri6, {n[0], n[1], n[2], n[4], n[5], n[7]}) : as(ElementKind::quad8, n);
  }
  if (shape == Shape::tetrahedron) {
    if (count == 4) return as(ElementKind::tet4, n);
    if (count < 4 || count > 10) return false;
    return filled(10), as(ElementKind::tet10, n);
  }
  if (count == 4) return as(ElementKind::tet4, n);
  if (count == 10) return as(ElementKind::tet10, n);
  if (count < 8 || count > 20) return false;
  const bool tip = n[4] == n[5] && n[5] == n[6] && n[6] == n[7], edge = n[2] == n[3], upper_edge = n[6] == n[7];
  if (count == 8) {
    if (edge && tip) return as(ElementKind::tet4, picked(n, {0, 1, 2, 4}));
    if (edge && upper_edge) return as(ElementKind::wedge6, picked(n, {0, 1, 2, 4, 5, 6}));
    return tip ? as(ElementKind::pyramid5, picked(n, {0, 1, 2, 3, 4})) : as(ElementKind::hex8, n);
  }
  filled(20);
  if (edge && tip) return as(ElementKind::tet10, picked(n, {0, 1, 2, 4, 8, 9, 11, 16, 17, 18}));
  if (edge && upper_edge) return as(ElementKind::wedge15, picked(n, {0, 1, 2, 4, 5, 6, 8, 9, 11, 12, 13, 15, 16, 17, 18}));
  return tip ? as(ElementKind::pyramid13, picked(n, {0, 1, 2, 3, 4, 8, 9, 10, 11, 16, 17, 18, 19})) : as(ElementKind::hex20, n);
}

std::vector<double> hyperelastic_constants(const ApdlMaterial& material) {
  const auto at = [&](std::size_t i) { return i < material.table.size() ? material.table[i] : 0.0; };
  const auto bulk = [](double d) { return 2.0 / d; };
  if (material.hyperelastic == ModelLaw::neo_hooke) return {at(0), bulk(at(1))};
  if (material.hyperelastic == ModelLaw::mooney_rivlin) return {at(0), at(1), bulk(at(2))};
  if (material.hyperelastic == ModelLaw::yeoh) return {at(0), material.terms > 1 ? at(1) : 0.0, material.terms > 2 ? at(2) : 0.0, bulk(at(material.terms))};
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
      if (diagnostics_.errors().size() < most_model_errors) add(element);
    model_.supports = deck_.supports, model_.forces = last_values(deck_.forces);
    model_.node_sets = deck_.node_sets;
    turn_into_global(model_, deck_.frames, file_, diagnostics_);
    finish(model_, file_, diagnostics_);
    if (!diagnostics_.any()) add_pressures();
    name_materials();
    if (!deck_.large_displacements && (!model_.forces.empty() || !model_.pressures.empty() || !model_.supports.empty()))
      model_.remarks.push_back(linear_step_remark(file_, "NLGEOM,ON"));
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
      return error(element.line, fmt::format("element {} of type {} has {} nodes, some of them the same or 0, as no solid or shell has them",
                                             element.number, type->second, element.nodes.size()), supported);
    if (shape == Shape::tetrahedron) own_tetrahedra_.insert(to.number);
    if (shape == Shape::surface) {
      surfaces_.push_back(std::move(to));
      return;
    }
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
      if (from->second.elastic && from->second.table.size() > 1 && to.law == ModelLaw::none) to.law = ModelLaw::elastic, to.constants = {from->second.table[0], from->second.table[1]};
      else if (to.law == ModelLaw::elastic) to.constants = {value("EX", 0.0), value("PRXY", value("NUXY", 0.3))};
      else if (to.law != ModelLaw::none) to.constants = hyperelastic_constants(from->second);
      if (to.law == ModelLaw::elastic) check_shear(element.material, from->second, to.constants);
      const std::size_t first_volume = to.law == ModelLaw::yeoh ? from->second.terms : to.law == ModelLaw::ogden ? 2 * from->second.terms : 60;
      for (std::size_t d = first_volume + 1; d < from->second.table.size(); ++d)
        if (from->second.table[d] != 0.0) error(from->second.line, fmt::format("the volume of material {} has a law of higher order", element.material), "give d1 only");
      if (to.law != ModelLaw::none && to.law != ModelLaw::elastic && !std::isfinite(to.constants.back()))
        error(from->second.line, fmt::format("material {} is perfectly incompressible (d = 0)", element.material), "give d = 2/kappa with a bulk modulus");
    }
    model_.materials.push_back(std::move(to));
    return it->second;
  }

  /// GXY of an isotropic material is E/(2 (1 + nu)); another one makes it orthotropic.
  void check_shear(int number, const ApdlMaterial& material, const std::vector<double>& constants) {
    const auto given = material.properties.find("GXY");
    const double due = constants[0] / (2.0 * (1.0 + constants[1]));
    if (given != material.properties.end() && std::abs(given->second - due) > 1e-3 * std::abs(due))
      error(material.line, fmt::format("GXY of material {} is {:g}, and E/(2 (1 + nu)) is {:g}: it is not isotropic", number, given->second, due), "leave GXY out, or correct EX and PRXY");
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

  /// A force set again takes the place of the first.
  static std::vector<ModelForce> last_values(const std::vector<ModelForce>& forces) {
    std::map<std::pair<int, int>, std::size_t> place;
    std::vector<ModelForce> last;
    for (const ModelForce& force : forces) {
      const auto [it, fresh] = place.emplace(std::pair(force.node, force.component), last.size());
      if (fresh) last.push_back(force);
      else last[it->second].value = force.value;
    }
    return last;
  }

  /// SURF154 lies on a face of a solid; its pressure acts against its normal (Ansys element reference, SURF154, face 1).
  bool add_surface_pressure(const ModelPressure& pressure) {
    const auto surface = std::find_if(surfaces_.begin(), surfaces_.end(), [&](const ModelElement& s) { return s.number == pressure.element; });
    if (surface == surfaces_.end()) return false;
    const int corners = corner_count(surface->kind), line = model_.line_of(pressure.element);
    const std::vector<int> own(surface->nodes.begin(), surface->nodes.begin() + corners);
    if (faces_.empty()) find_faces();
    const auto face = faces_.find(std::set<int>(own.begin(), own.end()));
    if (pressure.face != 1)
      error(line, fmt::format("a pressure acts along face {} of the surface element {}", pressure.face, pressure.element), "pressures on SURF154 act on face 1, along its normal");
    else if (face == faces_.end())
      error(line, fmt::format("the surface element {} lies on no face of a solid", pressure.element), "put it on the face of a solid");
    else
      model_.pressures.push_back({face->second.element, face->second.face, runs_like(own, face->second.corners) ? -pressure.value : pressure.value});
    return true;
  }
  struct SolidFace {
    int element, face;
    std::vector<int> corners;  ///< their normal points into the solid
  };
  void find_faces() {
    for (const ModelElement& element : model_.elements) {
      if (is_shell(element.kind)) continue;
      const auto& faces = model_faces(element.kind);
      for (std::size_t f = 0; f < faces.size(); ++f) {
        SolidFace face{element.number, static_cast<int>(f), {}};
        for (const int corner : faces[f]) face.corners.push_back(element.nodes[corner]);
        faces_[std::set<int>(face.corners.begin(), face.corners.end())] = face;
      }
    }
  }
  /// Both go round the same way.
  static bool runs_like(const std::vector<int>& a, const std::vector<int>& b) {
    const auto first = std::find(b.begin(), b.end(), a[0]) - b.begin();
    return b[(first + 1) % b.size()] == a[1];
  }

  /// Faces of Ansys in ours: of hexahedra 1 below, 2 to 5 around, 6 above; wedges, pyramids and tetrahedra with the nodes of a hexahedron
  /// count the faces of the hexahedron, of which those that have collapsed are none (-1). Tetrahedra of their own count as here
  /// (element reference, SOLID185 to SOLID187).
  static int face_of_ansys(ElementKind kind, bool as_hexahedron, int face) {
    static const std::map<int, std::array<int, 6>> by_corners = {
        {8, {0, 2, 3, 4, 5, 1}}, {6, {0, 2, 3, -1, 4, 1}}, {5, {0, 1, 2, 3, 4, -1}}, {4, {0, 1, 2, -1, 3, -1}}};
    if (face < 1 || face > 6) return -1;
    return as_hexahedron ? by_corners.at(corner_count(kind))[face - 1] : face <= 4 ? face - 1 : -1;
  }
  /// Of shells 1 below (along the normal), 2 above.
  void add_pressures() {
    std::map<int, const ModelElement*> by_number;
    for (const ModelElement& element : model_.elements) by_number[element.number] = &element;
    std::map<std::pair<int, int>, ModelPressure> last;  // set again, a pressure takes the place of the first
    for (const ModelPressure& pressure : deck_.pressures) last[{pressure.element, pressure.face}] = pressure;
    for (auto& [key, pressure] : last) {
      if (add_surface_pressure(pressure)) continue;
      const auto element = by_number.find(pressure.element);
      const ElementKind kind = element == by_number.end() ? ElementKind::hex8 : element->second->kind;
      const int face = is_shell(kind) ? (pressure.face == 1 || pressure.face == 2 ? 0 : -1)
                                      : face_of_ansys(kind, !own_tetrahedra_.contains(pressure.element), pressure.face);
      if (face < 0 || element == by_number.end()) {
        error(0, fmt::format("a pressure acts on face {} of element {}, which is not there", pressure.face, pressure.element), "correct the SFE command");
        continue;
      }
      if (is_shell(kind) && pressure.face == 2) pressure.value = -pressure.value;
      pressure.face = face;
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
  std::vector<ModelElement> surfaces_;  ///< SURF154
  std::set<int> own_tetrahedra_;        ///< elements that are no collapsed hexahedra
  std::map<std::set<int>, SolidFace> faces_;
};

}  // namespace

Model model_of(const ApdlDeck& deck, const std::string& file, input::Diagnostics& diagnostics) {
  return Assembly(deck, file, diagnostics)();
}

}  // namespace snug::mesh
