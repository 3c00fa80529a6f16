#include "mesh/formats/febio_loads.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mesh/formats/fields.hpp"

namespace snug::mesh {

using Xml = pugi::xml_node;

void FebioLoads::read(const Xml& parent) {
  for (const Xml& bc : parent.child("Boundary").children()) {
    const std::string_view type = bc.attribute("type").value();
    if (type == "fix" || type == "zero displacement") hold(bc);
    else if (type == "prescribe" || type == "prescribed displacement") move(bc);
    else document_.error(bc, fmt::format("the boundary condition is of type \"{}\"", type), "use \"zero displacement\" and \"prescribed displacement\" of node sets");
  }
  for (const Xml& load : parent.child("Loads").children()) {
    const std::string_view name = load.name(), type = load.attribute("type").value();
    if (name == "nodal_load" && (type == "nodal_load" || type == "nodal_force")) push(load);
    else if (name == "surface_load" && type == "pressure") press(load);
    else document_.error(load, fmt::format("the load <{} type=\"{}\"> is not taken over", name, type), "use nodal_force and pressure; weight is [load] gravity in case.toml");
  }
}

const std::vector<int>& FebioLoads::nodes_of(const Xml& node) const {
  static const std::vector<int> none;
  std::string name = node.attribute("node_set").value();
  if (name.starts_with("@")) name.erase(0, std::min(name.find(':'), name.size() - 1) + 1);  // @surface:NAME
  const auto set = model_.node_sets.find(name);
  if (set != model_.node_sets.end()) return set->second;
  document_.error(node, fmt::format("there is no node set \"{}\"", name), "define it in <Mesh>");
  return none;
}

int FebioLoads::component(const Xml& node, std::string_view name) const {
  const std::string_view plain = trimmed(name);
  if (plain == "x" || plain == "y" || plain == "z") return plain[0] - 'x';
  document_.error(node, fmt::format("\"{}\" is no component of displacement", plain), "write x, y or z");
  return -1;
}

void FebioLoads::hold(const Xml& bc) {
  std::vector<int> components;
  for (int c = 0; c < 3; ++c)
    if (bc.child(fmt::format("{}_dof", "xyz"[c]).c_str()).text().as_int() != 0) components.push_back(c);
  for (const TextField& field : fields_of(bc.child("dofs").text().get()))
    if (!field.text.empty())
      if (const int c = component(bc, field.text); c >= 0) components.push_back(c);
  if (components.empty()) document_.error(bc, "the support holds no component", "give x_dof, y_dof or z_dof, or <dofs>x,y,z</dofs>");
  for (const int node : nodes_of(bc))
    for (const int c : components) model_.supports.push_back({node, c, 0.0});
}

void FebioLoads::move(const Xml& bc) {
  const int c = component(bc, bc.child("dof").text().get());
  const auto value = document_.value(bc, bc.child("value") ? "value" : "scale", time_);
  if (bc.child("relative").text().as_int() != 0) document_.error(bc, "the displacement is relative to where the step begins", "give it from the place at rest");
  if (c < 0) return;
  if (!value) return document_.error(bc, "the displacement has no value", "give <value>");
  for (const int node : nodes_of(bc)) model_.supports.push_back({node, c, *value});
}

void FebioLoads::push(const Xml& load) {
  if (load.attribute("type").value() == std::string_view("nodal_load")) {
    const int c = component(load, load.child("dof").text().get());
    const auto value = document_.value(load, load.child("scale") ? "scale" : "value", time_);
    if (c < 0) return;
    if (!value) return document_.error(load, "the force has no value", "give <scale>");
    for (const int node : nodes_of(load)) model_.forces.push_back({node, c, *value});
    return;
  }
  const Xml value = load.child("value");
  const std::vector<double> force = document_.numbers(value);
  if (force.size() != 3) return document_.error(load, "a force has three components", "write <value>x, y, z</value>");
  const double factor = document_.curve_at(value, time_);
  for (const int node : nodes_of(load))
    for (int c = 0; c < 3; ++c)
      if (force[c] != 0.0) model_.forces.push_back({node, c, factor * force[c]});
}

void FebioLoads::index_faces() {
  if (!faces_.empty()) return;
  for (const ModelElement& element : model_.elements) {
    const auto& faces = model_faces(element.kind);
    for (std::size_t f = 0; f < faces.size(); ++f) {
      std::vector<int> corners;
      for (const int a : faces[f]) corners.push_back(element.nodes[a]);
      std::vector<int> sorted = corners;
      std::sort(sorted.begin(), sorted.end());
      faces_[sorted] = {element.number, static_cast<int>(f), std::move(corners)};
    }
  }
}

/// Against the normal of the facet, which points out of the body where the facet turns against the face.
void FebioLoads::press(const Xml& load) {
  index_faces();
  const auto surface = surfaces_.find(load.attribute("surface").value());
  const auto value = document_.value(load, "pressure", time_);
  if (load.child("linear").text().as_int() != 0) document_.error(load, "the pressure keeps the direction that it has at rest", "leave linear out: the pressure follows the surface");
  if (surface == surfaces_.end()) return document_.error(load, fmt::format("there is no surface \"{}\"", load.attribute("surface").value()), "define it in <Mesh>");
  if (!value) return document_.error(load, "the pressure has no value", "give <pressure>");
  for (const FebioFacet& facet : surface->second) {
    std::vector<int> sorted = facet.nodes;
    std::sort(sorted.begin(), sorted.end());
    const auto face = faces_.find(sorted);
    if (face == faces_.end()) {
      document_.error(facet.xml, "the facet is a face of no element", "take the facets of the surface from the elements");
      continue;
    }
    const std::vector<int>& corners = face->second.corners;
    const auto first = std::find(corners.begin(), corners.end(), facet.nodes[0]);
    const bool inwards = corners[(first - corners.begin() + 1) % corners.size()] == facet.nodes[1];
    model_.pressures.push_back({face->second.element, face->second.face, inwards ? -*value : *value});
  }
}

}  // namespace snug::mesh
