#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <map>
#include <ostream>
#include <tuple>

#include "mesh/formats/fields.hpp"
#include "mesh/formats/model.hpp"

namespace snug::mesh {

namespace {

/// A name that both programs take: capitals, digits and _, at most 32, a letter first.
std::string set_name(const std::string& name) {
  std::string plain = upper_case(name);
  std::replace_if(plain.begin(), plain.end(), [](unsigned char c) { return !std::isalnum(c) && c != '_'; }, '_');
  if (plain.empty() || !std::isalpha(static_cast<unsigned char>(plain[0]))) plain.insert(0, "S_");
  return plain.substr(0, 32);
}

/// Elements of one kind, material and section.
using Group = std::tuple<ElementKind, int, int>;
std::map<Group, std::vector<const ModelElement*>> groups_of(const Model& model) {
  std::map<Group, std::vector<const ModelElement*>> groups;
  for (const ModelElement& element : model.elements)
    groups[{element.kind, element.material, element.section}].push_back(&element);
  return groups;
}

const char* calculix_type(ElementKind kind) {
  switch (kind) {
    case ElementKind::tet4: return "C3D4";
    case ElementKind::tet10: return "C3D10";
    case ElementKind::hex8: return "C3D8";
    case ElementKind::hex20: return "C3D20R";
    case ElementKind::tri3: return "S3";
    case ElementKind::tri6: return "S6";
    case ElementKind::quad4: return "S4";
    case ElementKind::quad8: return "S8R";
    case ElementKind::wedge6: return "C3D6";
    case ElementKind::wedge15: return "C3D15";
    case ElementKind::pyramid5: return "C3D5";
    case ElementKind::pyramid13: return "C3D13";
  }
  return "";
}

/// The shortest digits that read back as the same value, fewer where they are more than the 20 characters that CalculiX
/// reads of a number (from then on 1e-14 of it may be lost).
std::string digits(double value) {
  std::string text = fmt::format("{}", value);
  for (int precision = 16; text.size() > 20; --precision) text = fmt::format("{:.{}g}", value, precision);
  return text;
}

/// As CalculiX wants them; kappa = 2/D1.
std::string calculix_law(const ModelMaterial& material) {
  const std::vector<double>& c = material.constants;
  const double D1 = 2.0 / c.back();
  switch (material.law) {
    case ModelLaw::compressible_neo_hooke:  // no body is written with it
    case ModelLaw::arruda_boyce:
    case ModelLaw::none: break;
    case ModelLaw::elastic: return fmt::format("*ELASTIC\n{}, {}\n", digits(c[0]), digits(c[1]));
    case ModelLaw::neo_hooke: return fmt::format("*HYPERELASTIC, NEO HOOKE\n{}, {}\n", digits(0.5 * c[0]), digits(D1));
    case ModelLaw::mooney_rivlin: return fmt::format("*HYPERELASTIC, MOONEY-RIVLIN\n{}, {}, {}\n", digits(c[0]), digits(c[1]), digits(D1));
    case ModelLaw::yeoh:
      return fmt::format("*HYPERELASTIC, YEOH\n{}, {}, {}, {}, 0, 0\n", digits(c[0]), digits(c[1]), digits(c[2]), digits(D1));
    case ModelLaw::ogden: {
      std::string line, zeros;
      for (std::size_t t = 0; t + 1 < c.size(); t += 2) line += fmt::format("{}, {}, ", digits(0.5 * c[t] * c[t + 1]), digits(c[t + 1]));
      for (std::size_t t = 2; t + 1 < c.size(); t += 2) zeros += ", 0";
      return fmt::format("*HYPERELASTIC, OGDEN, N={}\n{}{}{}\n", c.size() / 2, line, digits(D1), zeros);
    }
  }
  return "";
}

int ansys_type(ElementKind kind, bool foundation) {
  switch (kind) {
    case ElementKind::tet4: return 285;
    case ElementKind::tet10: return 187;
    case ElementKind::wedge6:
    case ElementKind::pyramid5:
    case ElementKind::hex8: return 185;
    case ElementKind::wedge15:
    case ElementKind::pyramid13:
    case ElementKind::hex20: return 186;
    case ElementKind::tri3:
    case ElementKind::quad4: return foundation ? 63 : 181;
    default: return 281;
  }
}

std::vector<int> ansys_nodes(const ModelElement& e) {
  const std::vector<int>& n = e.nodes;
  if (e.kind == ElementKind::tri3) return {n[0], n[1], n[2], n[2]};
  if (e.kind == ElementKind::wedge6) return {n[0], n[1], n[2], n[2], n[3], n[4], n[5], n[5]};
  if (e.kind == ElementKind::pyramid5) return {n[0], n[1], n[2], n[3], n[4], n[4], n[4], n[4]};
  if (e.kind == ElementKind::wedge15)
    return {n[0], n[1], n[2], n[2], n[3], n[4], n[5], n[5], n[6], n[7], n[2], n[8], n[9], n[10], n[5], n[11], n[12], n[13], n[14], n[14]};
  if (e.kind == ElementKind::pyramid13)
    return {n[0], n[1], n[2], n[3], n[4], n[4], n[4], n[4], n[5], n[6], n[7], n[8], n[4], n[4], n[4], n[4], n[9], n[10], n[11], n[12]};
  if (e.kind == ElementKind::tri6) return {n[0], n[1], n[2], n[2], n[3], n[4], n[2], n[5]};
  return n;
}

std::string ansys_law(const ModelMaterial& material, int number) {
  const std::vector<double>& c = material.constants;
  std::string text;
  if (material.density > 0.0) text += fmt::format("MP,DENS,{},{:.17g}\n", number, material.density);
  if (material.law == ModelLaw::none) return text;
  if (material.law == ModelLaw::elastic) return text + fmt::format("MP,EX,{0},{1:.17g}\nMP,PRXY,{0},{2:.17g}\n", number, c[0], c[1]);
  const int terms = material.law == ModelLaw::ogden ? static_cast<int>(c.size() / 2) : material.law == ModelLaw::mooney_rivlin ? 2
                    : material.law == ModelLaw::yeoh ? 3 : 1;
  const char* name = material.law == ModelLaw::ogden ? "OGDEN" : material.law == ModelLaw::neo_hooke ? "NEO" : material.law == ModelLaw::yeoh ? "YEOH" : "MOONEY";
  text += fmt::format("TB,HYPER,{},1,{},{}\n", number, terms, name);
  for (std::size_t i = 0; i < c.size(); ++i)
    text += fmt::format("TBDATA,{},{:.17g}\n", i + 1, i + 1 == c.size() ? 2.0 / c[i] : c[i]);
  return text;
}

void write_component(std::ostream& out, const std::string& name, const char* kind, const std::vector<int>& items) {
  fmt::print(out, "CMBLOCK,{},{},{:>8}\n(8i10)\n", set_name(name), kind, items.size());
  for (std::size_t i = 0; i < items.size(); ++i)
    fmt::print(out, "{:>10}{}", items[i], i % 8 == 7 || i + 1 == items.size() ? "\n" : "");
}

/// Middles that are left out (0) as nodes half way, held where both ends are: both programs do the same, but not every reader.
Model with_all_middles(Model model) {
  std::map<int, Eigen::Vector3d> places;
  for (const ModelNode& node : model.nodes) places[node.number] = node.at;
  std::map<std::pair<int, int>, int> made;
  for (ModelElement& element : model.elements)
    for (std::size_t m = 0; m < model_edges(element.kind).size(); ++m) {
      int& middle = element.nodes[corner_count(element.kind) + m];
      if (middle != 0) continue;
      const auto [a, b] = model_edges(element.kind)[m];
      const std::pair<int, int> ends = std::minmax(element.nodes[a], element.nodes[b]);
      const auto [it, fresh] = made.emplace(ends, model.nodes.back().number + 1);
      if (fresh) model.nodes.push_back({it->second, 0.5 * (places.at(ends.first) + places.at(ends.second))});
      middle = it->second;
    }
  std::map<std::pair<int, int>, double> held;
  for (const ModelSupport& support : model.supports) held[{support.node, support.component}] = support.value;
  for (const auto& [ends, node] : made)
    for (int c = 0; c < 6; ++c) {
      const auto first = held.find({ends.first, c}), second = held.find({ends.second, c});
      if (first != held.end() && second != held.end()) model.supports.push_back({node, c, 0.5 * (first->second + second->second)});
    }
  return model;
}

/// Faces of Ansys, which counts those of the hexahedron that the element has collapsed from.
int ansys_face(ElementKind kind, int face) {
  if (is_shell(kind) || is_tetrahedron(kind) || corner_count(kind) == 5) return face + 1;
  if (corner_count(kind) == 6 && face == 4) return 5;
  return face == 0 ? 1 : face == 1 ? 6 : face;
}

}  // namespace

void write_calculix(std::ostream& out, const Model& given) {
  const Model model = with_all_middles(given);
  out << "*HEADING\nwritten by snug\n*NODE, NSET=NALL\n";
  for (const ModelNode& node : model.nodes)
    fmt::print(out, "{}, {}, {}, {}\n", node.number, digits(node.at.x()), digits(node.at.y()), digits(node.at.z()));
  std::string sections;
  int group = 0;
  for (const auto& [key, elements] : groups_of(model)) {
    const auto& [kind, material, section] = key;
    fmt::print(out, "*ELEMENT, TYPE={}, ELSET=GROUP{}\n", calculix_type(kind), ++group);
    for (const ModelElement* element : elements) {
      fmt::print(out, "{}", element->number);
      for (std::size_t n = 0; n < element->nodes.size(); ++n) fmt::print(out, ",{}{}", n == 10 ? "\n" : " ", element->nodes[n]);
      out << '\n';
    }
    const std::string& name = model.materials[material].name;
    sections += section < 0 ? fmt::format("*SOLID SECTION, ELSET=GROUP{}, MATERIAL={}\n", group, set_name(name))
                            : fmt::format("*SHELL SECTION, ELSET=GROUP{}, MATERIAL={}\n{}\n", group, set_name(name), digits(model.sections[section].thickness));
  }
  for (const auto& [name, nodes] : model.node_sets) {
    if (set_name(name) == "NALL") continue;
    fmt::print(out, "*NSET, NSET={}\n", set_name(name));
    for (const int node : nodes) fmt::print(out, "{},\n", node);
  }
  for (const ModelMaterial& material : model.materials) {
    fmt::print(out, "*MATERIAL, NAME={}\n{}", set_name(material.name), calculix_law(material));
    if (material.density > 0.0) fmt::print(out, "*DENSITY\n{}\n", digits(material.density));
  }
  out << sections;
  const auto supports = [&](bool moved) {
    bool begun = false;
    for (const ModelSupport& s : model.supports) {
      if ((s.value != 0.0) != moved) continue;
      if (!begun) out << "*BOUNDARY\n", begun = true;
      fmt::print(out, "{0}, {1}, {1}{2}\n", s.node, s.component + 1, moved ? ", " + digits(s.value) : "");
    }
  };
  supports(false);
  out << "*STEP, NLGEOM, INC=100\n*STATIC\n1., 1.\n";
  supports(true);
  if (!model.forces.empty()) out << "*CLOAD\n";
  for (const ModelForce& f : model.forces) fmt::print(out, "{}, {}, {}\n", f.node, f.component + 1, digits(f.value));
  if (!model.pressures.empty()) out << "*DLOAD\n";
  std::map<int, ElementKind> kinds;
  for (const ModelElement& element : model.elements) kinds[element.number] = element.kind;
  for (const ModelPressure& p : model.pressures)
    fmt::print(out, "{}, P{}, {}\n", p.element, is_shell(kinds[p.element]) ? "" : std::to_string(p.face + 1), digits(p.value));
  out << "*NODE PRINT, NSET=NALL\nU\n*NODE FILE\nU\n*END STEP\n";
}

void write_cdb(std::ostream& out, const Model& given) {
  const Model model = with_all_middles(given);
  out << "/COM, written by snug\n/PREP7\n";
  std::map<int, int> types;
  const auto type_of = [&](const ModelElement& e) {
    return ansys_type(e.kind, e.section >= 0 && model.sections[e.section].foundation != 0.0);
  };
  for (const ModelElement& element : model.elements)
    if (types.emplace(type_of(element), static_cast<int>(types.size()) + 1).second)
      fmt::print(out, "ET,{:>9},{}\n", types.size(), type_of(element));
  for (std::size_t s = 0; s < model.sections.size(); ++s) {
    const auto& [thickness, foundation] = model.sections[s];
    fmt::print(out, "R,{0},{1:.17g},{1:.17g},{1:.17g},{1:.17g},{2:.17g}\nSECTYPE,{0},SHELL\nSECDATA,{1:.17g}\n", s + 1, thickness, foundation);
  }
  for (std::size_t m = 0; m < model.materials.size(); ++m) out << ansys_law(model.materials[m], static_cast<int>(m) + 1);
  const int last_node = model.nodes.empty() ? 0 : model.nodes.back().number;
  fmt::print(out, "NBLOCK,6,SOLID,{:>10},{:>10}\n(3i9,6e24.16e3)\n", last_node, model.nodes.size());
  const auto column = [](double value) {  // 24 characters with an exponent of three digits
    const std::string text = fmt::format("{:.16E}", value);
    const auto e = text.find('E');
    return fmt::format("{:>24}", fmt::format("{}E{:+04d}", text.substr(0, e), std::stoi(text.substr(e + 1))));
  };
  for (const ModelNode& node : model.nodes)
    fmt::print(out, "{:>9}{:>9}{:>9}{}{}{}\n", node.number, 0, 0, column(node.at.x()), column(node.at.y()), column(node.at.z()));
  const int last_element = model.elements.empty() ? 0 : model.elements.back().number;
  fmt::print(out, "N,R5.3,LOC,       -1,\nEBLOCK,19,SOLID,{:>10},{:>10}\n(19i10)\n", last_element, model.elements.size());
  for (const ModelElement& element : model.elements) {
    const std::vector<int> nodes = ansys_nodes(element);
    const int section = std::max(element.section, 0) + 1;
    for (const int field : {element.material + 1, types[type_of(element)], section, section, 0, 0, 0, 0, static_cast<int>(nodes.size()), 0, element.number})
      fmt::print(out, "{:>10}", field);
    for (std::size_t n = 0; n < nodes.size(); ++n) fmt::print(out, "{}{:>10}", n == 8 ? "\n" : "", nodes[n]);
    out << '\n';
  }
  out << "        -1\n";
  for (const auto& [name, nodes] : model.node_sets) write_component(out, name, "NODE", nodes);
  for (std::size_t m = 0; m < model.materials.size(); ++m) {
    std::vector<int> members;
    for (const ModelElement& element : model.elements)
      if (element.material == static_cast<int>(m)) members.push_back(element.number);
    write_component(out, model.materials[m].name, "ELEM", members);
  }
  static const std::array<const char*, 6> supports = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};
  for (const ModelSupport& s : model.supports) fmt::print(out, "D,{},{},{:.17g}\n", s.node, supports[s.component], s.value);
  for (const ModelForce& f : model.forces) fmt::print(out, "F,{},F{},{:.17g}\n", f.node, "XYZ"[f.component], f.value);
  std::map<int, ElementKind> kinds;
  for (const ModelElement& element : model.elements) kinds[element.number] = element.kind;
  for (const ModelPressure& p : model.pressures) {
    const ElementKind kind = kinds[p.element];
    fmt::print(out, "SFE,{},{},PRES,,{:.17g}\n", p.element, ansys_face(kind, p.face), p.value);
  }
  out << "FINISH\n/SOLU\nANTYPE,STATIC\nNLGEOM,ON\nSOLVE\nFINISH\n";
}

}  // namespace snug::mesh
