// FEBio models (.feb), format 3 and 4. Source: FEBio User's Manual, version 4, chapter 3 "Free Format Input" (and that of version 3 for what it named otherwise).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "mesh/formats/febio_document.hpp"
#include "mesh/formats/febio_loads.hpp"
#include "mesh/formats/fields.hpp"

namespace snug::mesh {

namespace {

using Xml = pugi::xml_node;

struct FebioElement {
  ElementKind kind;
  std::size_t nodes;  ///< in the file, of which the first ones are ours
};

/// Corners and middles of edges stand as with Abaqus; the middles of faces and of the cell of 27 nodes come last and are left out.
std::optional<FebioElement> element_of(std::string_view type) {
  static const std::map<std::string, FebioElement, std::less<>> kinds = {
      {"tet4", {ElementKind::tet4, 4}},     {"tet10", {ElementKind::tet10, 10}},    {"hex8", {ElementKind::hex8, 8}},    {"hex20", {ElementKind::hex20, 20}},
      {"hex27", {ElementKind::hex20, 27}},  {"penta6", {ElementKind::wedge6, 6}},   {"penta15", {ElementKind::wedge15, 15}},
      {"pyra5", {ElementKind::pyramid5, 5}}, {"pyra13", {ElementKind::pyramid13, 13}}};
  const std::string_view plain = type.substr(0, type.ends_with("G4") || type.ends_with("G8") ? type.size() - 2 : type.size());  // TET10G4: its rule
  const auto known = kinds.find(plain);
  return known == kinds.end() ? std::nullopt : std::optional(known->second);
}

class FebioReader {
 public:
  FebioReader(const std::string& text, const std::string& file, input::Diagnostics& diagnostics, int load_step)
      : document_(text, file, diagnostics), file_(file), diagnostics_(diagnostics), asked_(load_step) {}

  Model read() {
    const Xml root = document_.root();
    if (!root) return {};
    const std::string version = root.attribute("version").value();
    if (!version.starts_with("3") && !version.starts_with("4"))
      document_.error(root, fmt::format("the file has the format {}", version.empty() ? "of an early FEBio" : version), "open it in FEBio Studio and save it in format 4.0");
    else if (const std::string module = root.child("Module").attribute("type").value(); module != "solid")
      document_.error(root.child("Module") ? root.child("Module") : root, fmt::format("the module is \"{}\"", module), "give a model of solid mechanics: <Module type=\"solid\"/>");
    if (diagnostics_.any()) return {};
    refuse_others(root);
    read_materials(root.child("Material"));
    read_mesh(root.child("Mesh"));
    assign_materials(root.child("MeshDomains"));
    read_steps(root);
    finish(model_, file_, diagnostics_);
    return std::move(model_);
  }

 private:
  void refuse_others(const Xml& parent) const {
    static const std::map<std::string, const char*, std::less<>> others = {
        {"Contact", "contact"},        {"Constraints", "constraints"}, {"Rigid", "rigid bodies"},  {"Discrete", "springs"}, {"MeshAdaptor", "remeshing"},
        {"Initial", "an initial state"}, {"MeshData", "data of elements"}, {"Include", "other files"}};
    for (const Xml& child : parent.children())
      if (const auto other = others.find(std::string_view(child.name())); other != others.end() && child.first_child())
        document_.error(child, fmt::format("the model has {}, which are not taken over", other->second), "leave them out; supports, forces and pressures on solids are read");
  }

  double constant(const Xml& material, const char* name) const {
    const auto value = document_.value(material, name, 0.0);
    if (!value) document_.error(material, fmt::format("the material \"{}\" has no <{}>", material.attribute("name").value(), name), "give it");
    return value.value_or(1.0);
  }

  void read_materials(const Xml& materials) {
    for (const Xml& one : materials.children("material")) {
      ModelMaterial material{one.attribute("name").value(), ModelLaw::none, {}, document_.value(one, "density", 0.0).value_or(0.0)};
      const std::string_view type = one.attribute("type").value();
      if (material.name.empty()) material.name = fmt::format("material {}", one.attribute("id").value());
      if (type == "neo-Hookean") {
        material.law = ModelLaw::compressible_neo_hooke, material.constants = {constant(one, "E"), constant(one, "v")};
      } else if (type == "Mooney-Rivlin") {
        material.law = ModelLaw::mooney_rivlin, material.constants = {constant(one, "c1"), document_.value(one, "c2", 0.0).value_or(0.0), constant(one, "k")};
      } else if (type == "incomp neo-Hookean") {
        material.law = ModelLaw::neo_hooke, material.constants = {constant(one, "G"), constant(one, "k")};
      } else {
        document_.error(one, fmt::format("the material \"{}\" is of type \"{}\"", material.name, type),
                        "use neo-Hookean, incomp neo-Hookean or Mooney-Rivlin, without viscosity, fibres or growth");
      }
      if (document_.value(one, "pressure_model", 0.0).value_or(0.0) != 0.0) document_.error(one.child("pressure_model"), "the energy of volume is another one", "leave pressure_model out");
      material.volume = ModelVolume::logarithmic;
      by_id_[one.attribute("id").value()] = by_name_[material.name] = static_cast<int>(model_.materials.size());
      model_.materials.push_back(std::move(material));
    }
  }

  void read_mesh(const Xml& mesh) {
    for (const Xml& nodes : mesh.children("Nodes"))
      for (const Xml& node : nodes.children("node")) {
        const std::vector<double> at = document_.numbers(node);
        const int number = node.attribute("id").as_int();
        if (at.size() != 3 || number < 1) document_.error(node, "a node has a number and three coordinates", "write <node id=\"1\">x, y, z</node>");
        else model_.nodes.push_back({number, {at[0], at[1], at[2]}}), add_to_set(nodes.attribute("name").value(), number);
      }
    for (const Xml& elements : mesh.children("Elements")) read_elements(elements);
    for (const Xml& set : mesh.children("NodeSet")) {
      const std::string name = set.attribute("name").value();
      for (const Xml& node : set.children("n")) add_to_set(name, node.attribute("id").as_int());
      if (!set.child("n"))
        for (const int node : document_.integers(set)) add_to_set(name, node);
    }
    for (const Xml& surface : mesh.children("Surface")) {
      const std::string name = surface.attribute("name").value();
      for (const Xml& facet : surface.children()) {
        FebioFacet& to = surfaces_[name].emplace_back(FebioFacet{document_.integers(facet), facet});
        if (!model_.node_sets.contains(name) || surface_names_.contains(name))
          for (const int node : to.nodes) surface_names_.insert(name), add_to_set(name, node);
        to.nodes.resize(std::min<std::size_t>(to.nodes.size(), std::string_view(facet.name()).starts_with("tri") ? 3 : 4));
      }
    }
  }
  void add_to_set(const std::string& name, int node) {
    if (!name.empty()) model_.node_sets[name].push_back(node);
  }

  void read_elements(const Xml& elements) {
    const std::string type = elements.attribute("type").value(), part = elements.attribute("name").value();
    const auto kind = element_of(type);
    if (!kind) return document_.error(elements, fmt::format("elements of type {} are not taken over", type), "use tet4 tet10 hex8 hex20 hex27 penta6 penta15 pyra5 pyra13");
    const auto by_attribute = by_id_.find(elements.attribute("mat").value());
    for (const Xml& one : elements.children("elem")) {
      ModelElement element{one.attribute("id").as_int(), kind->kind, document_.integers(one), by_attribute == by_id_.end() ? -1 : by_attribute->second, -1};
      if (element.nodes.size() != kind->nodes) {
        document_.error(one, fmt::format("element {} has {} nodes where a {} has {}", element.number, element.nodes.size(), type, kind->nodes), "give as many");
        continue;
      }
      element.nodes.resize(node_count(kind->kind));
      model_.element_line[element.number] = document_.place(one).line;
      parts_[part].push_back(model_.elements.size());
      model_.elements.push_back(std::move(element));
    }
  }

  void assign_materials(const Xml& domains) {
    for (const Xml& domain : domains.children()) {
      const auto part = parts_.find(domain.attribute("name").value());
      const std::string name = domain.attribute("mat").value();
      const auto material = by_name_.find(name);
      if (std::string_view(domain.name()) != "SolidDomain") document_.error(domain, fmt::format("there is a {}", domain.name()), "the domains that are read are solid: <SolidDomain>");
      else if (part == parts_.end()) document_.error(domain, fmt::format("there are no elements \"{}\"", domain.attribute("name").value()), "name <Elements> so");
      else if (material == by_name_.end()) document_.error(domain, fmt::format("there is no material \"{}\"", name), "define it in <Material>");
      else
        for (const std::size_t element : part->second) model_.elements[element].material = material->second;
    }
    for (const ModelElement& element : model_.elements)
      if (element.material < 0 && diagnostics_.errors().size() < most_model_errors)
        diagnostics_.error({file_, model_.line_of(element.number), 1}, fmt::format("element {} has no material", element.number), "give its part a <SolidDomain> with mat");
  }

  static double length_of(const Xml& control) { return control.child("time_steps").text().as_double(1.0) * control.child("step_size").text().as_double(1.0); }

  /// Supports and loads outside of steps hold in all of them, those of a step in that one.
  void read_steps(const Xml& root) {
    std::vector<Xml> steps;
    for (const Xml& group : root.children("Step"))
      for (const Xml& step : group.children("step")) steps.push_back(step);
    const std::size_t chosen = asked_ > 0 ? std::min(steps.size(), static_cast<std::size_t>(asked_)) : steps.size();
    double time = steps.empty() ? length_of(root.child("Control")) : 0.0;
    for (std::size_t s = 0; s < chosen; ++s) time += length_of(steps[s].child("Control"));
    FebioLoads loads(document_, surfaces_, model_, time);
    loads.read(root);
    if (chosen > 0) refuse_others(steps[chosen - 1]), loads.read(steps[chosen - 1]);
    tell_load_step(model_, static_cast<int>(steps.size()), asked_, chosen > 0 ? document_.place(steps[chosen - 1]) : input::Location{file_, 0, 0}, diagnostics_);
  }

  FebioDocument document_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  int asked_;
  Model model_;
  std::map<std::string, int> by_id_, by_name_;
  std::map<std::string, std::vector<std::size_t>> parts_;  ///< elements, by place
  FebioSurfaces surfaces_;
  std::set<std::string> surface_names_;  ///< whose nodes make a set
};

}  // namespace

Model parse_febio(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, int load_step) {
  return FebioReader(text, shown_as, diagnostics, load_step).read();
}

}  // namespace snug::mesh
