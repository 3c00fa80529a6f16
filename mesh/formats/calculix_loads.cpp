#include "mesh/formats/calculix_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace snug::mesh {

void InpLoads::step(const FieldLine& card, const InpParameters& parameters) {
  ++steps_;
  if (over()) return;
  forces_.begin_step(), pressures_.begin_step(), surface_pressures_.begin_step(), weights_.begin_step();
  if (parameters.contains("PERTURBATION")) card.error(0, "the step is a perturbation of another", "give one static step");
  large_displacements_ = large_displacements_ || (parameters.contains("NLGEOM") && parameters.at("NLGEOM") != "NO");
  step_line_ = card.number;
}

InpData InpLoads::static_step() {
  return [this](const FieldLine& line) { period_ = line.number_at(1, 1.0); };
}

InpData InpLoads::amplitude(const InpParameters& parameters) {
  auto& pairs = amplitudes_[value_of(parameters, "NAME")];
  return [&pairs](const FieldLine& line) {
    for (std::size_t f = 0; f + 1 < line.fields.size(); f += 2)
      if (!line.empty(f)) pairs.emplace_back(line.number_at(f), line.number_at(f + 1));
  };
}

/// Data of a load with the value that its amplitude has at the end of the step.
InpData InpLoads::scaled(const FieldLine& card, const InpParameters& parameters, Scaled take) const {
  if (const std::string type = value_of(parameters, "TYPE"); !type.empty() && type != "DISPLACEMENT")
    card.error(0, fmt::format("the type {} is not taken over", type), "prescribe displacements");
  for (const auto& [key, value] : parameters)
    if (key != "OP" && key != "AMPLITUDE" && key != "TYPE" && key != "INPUT" && key != "LOADCASE")
      card.error(0, fmt::format("the parameter {} is not taken over", key), "of supports and loads OP, AMPLITUDE and TYPE are read");
  double by = 1.0;
  if (const std::string name = value_of(parameters, "AMPLITUDE"); !name.empty()) {
    const auto amplitude = amplitudes_.find(name);
    if (amplitude == amplitudes_.end() || amplitude->second.empty())
      card.error(0, fmt::format("there is no amplitude \"{}\"", name), "define it with *AMPLITUDE before, as pairs of time and value");
    else
      by = interpolated(amplitude->second, period_);
  }
  return [take = std::move(take), by](const FieldLine& line) { take(line, by); };
}

namespace {

/// OP=NEW: what earlier steps have set of this kind is over.
bool begins_anew(const InpParameters& parameters) { return value_of(parameters, "OP") == "NEW"; }

}  // namespace

InpData InpLoads::boundary(const FieldLine& card, const InpParameters& parameters) {
  if (begins_anew(parameters)) supports_.clear();
  return scaled(card, parameters, [this](const FieldLine& line, double by) { hold(line, by); });
}
InpData InpLoads::forces(const FieldLine& card, const InpParameters& parameters) {
  if (begins_anew(parameters)) forces_.clear();
  return scaled(card, parameters, [this](const FieldLine& line, double by) { push(line, by); });
}
InpData InpLoads::pressures(const FieldLine& card, const InpParameters& parameters) {
  if (begins_anew(parameters)) pressures_.clear(), weights_.clear();
  return scaled(card, parameters, [this](const FieldLine& line, double by) { press(line, by); });
}
InpData InpLoads::surface_pressures(const FieldLine& card, const InpParameters& parameters) {
  if (begins_anew(parameters)) surface_pressures_.clear();
  return scaled(card, parameters, [this](const FieldLine& line, double by) { press_surface(line, by); });
}

void InpLoads::hold(const FieldLine& line, double by) {
  std::vector<int> components = held_by_name(upper_case(line.text(1)));
  if (components.empty()) {
    const int first = line.integer_at(1), last = line.integer_at(2, first);
    if (first < 1 || last > 6 || last < first)
      return line.error(1, "this is no component of displacement",
                        "write node, first component, last component, value (1 to 3; 4 to 6 of shells), or ENCASTRE, PINNED, XSYMM ...");
    for (int c = first; c <= last; ++c) components.push_back(c - 1);
  }
  for (const int node : sets_.nodes_named(line))
    for (const int c : components) supports_.push_back({node, c, by * line.number_at(3)});
}

void InpLoads::push(const FieldLine& line, double by) {
  const int component = line.integer_at(1);
  if (component < 1 || component > 3) return line.error(1, "this is no force", "write node, component 1 to 3, force; moments are not taken over");
  for (const int node : sets_.nodes_named(line))
    forces_.put({node, component - 1, by * line.number_at(2)}, [&](const ModelForce& f) { return f.node == node && f.component == component - 1; });
}

void InpLoads::put(Loads<ModelPressure>& pressures, const ModelPressure& pressure) {
  pressures.put(pressure, [&](const ModelPressure& p) { return p.element == pressure.element && p.face == pressure.face; });
}

/// P1 ... P6 of solids, P of shells (along the normal of a shell: CalculiX manual, *DLOAD).
void InpLoads::press(const FieldLine& line, double by) {
  const std::string label = upper_case(line.text(1));
  if (label == "GRAV") return weigh(line, by);
  const int face = label.size() == 2 && label[0] == 'P' ? label[1] - '1' : label == "P" ? 0 : -1;
  if (face < 0 || face > 5)
    return line.error(1, fmt::format("the load {} is not taken over", line.text(1)), "use pressures P1 ... P6, or weight: set, GRAV, acceleration, direction");
  for (const int element : sets_.elements_named(line)) {
    if (label == "P") along_normal_.emplace(element, line.at(1));
    put(pressures_, {element, face, by * line.number_at(2)});
  }
}

/// Set, GRAV, acceleration, direction of any length (CalculiX manual, *DLOAD).
void InpLoads::weigh(const FieldLine& line, double by) {
  const Eigen::Vector3d towards(line.number_at(3), line.number_at(4), line.number_at(5));
  if (!(towards.norm() > 0.0)) return line.error(3, "the weight has no direction", "write set, GRAV, acceleration, and its direction x, y, z, e.g. 0, 0, -1");
  const Eigen::Vector3d acceleration = by * line.number_at(2) * towards.normalized();
  for (const int element : sets_.elements_named(line)) {
    weighed_.emplace(element, line.at(1));
    weights_.put({element, acceleration}, [&](const ModelWeight& w) { return w.element == element && w.acceleration.normalized().dot(acceleration.normalized()) > 1.0 - 1e-12; });
  }
}

void InpLoads::check_weights(const Model& model) {
  for (const ModelElement& element : model.elements) {
    const auto at = weighed_.find(element.number);
    if (at == weighed_.end() || element.material < 0) continue;
    if (is_shell(element.kind))
      return diagnostics_.error(at->second, fmt::format("the weight of element {}, a shell, is not taken over", element.number), "give it as [[load.traction]] in case.toml");
    if (const ModelMaterial& material = model.materials[element.material]; !(material.density > 0.0))
      return diagnostics_.error(at->second, fmt::format("the weight of element {} is unknown: its material \"{}\" has no density", element.number, material.name),
                                "give it with *DENSITY behind *MATERIAL");
  }
}

void InpLoads::check_faces(const Model& model) {
  for (const ModelElement& element : model.elements)
    if (const auto at = along_normal_.find(element.number); at != along_normal_.end() && !is_shell(element.kind))
      return diagnostics_.error(at->second, fmt::format("the pressure P acts along the normal of a shell, and element {} is a solid", element.number),
                                "name the face of the solid: P1 ... P6, or *DSLOAD on a surface");
}

/// S1 ... S6 of solids; SPOS and SNEG of shells, of which a pressure on the upper side (SPOS) acts against the normal.
InpData InpLoads::surface(const FieldLine& card, const InpParameters& parameters) {
  std::vector<SurfaceFace>& faces = surfaces_[value_of(parameters, "NAME")];
  const bool of_nodes = value_of(parameters, "TYPE") == "NODE";
  if (parameters.contains("COMBINE")) card.error(0, "the surface is made of others", "give its elements and faces");
  return [this, &faces, of_nodes](const FieldLine& line) {
    if (of_nodes) return;
    const std::string label = upper_case(line.text(1));
    const bool numbered = label.size() == 2 && label[0] == 'S' && label[1] >= '1' && label[1] <= '6';
    if (!numbered && label != "SPOS" && label != "SNEG")
      return line.error(1, fmt::format("\"{}\" is no face of an element", line.text(1)), "write S1 to S6, of shells SPOS or SNEG");
    for (const int element : sets_.elements_named(line)) faces.push_back({element, numbered ? label[1] - '1' : 0, label == "SPOS" ? -1.0 : 1.0});
  };
}

void InpLoads::press_surface(const FieldLine& line, double by) {
  const auto surface = found_by_name(surfaces_, line.text(0));
  if (upper_case(line.text(1)) != "P") return line.error(1, fmt::format("the load {} is not taken over", line.text(1)), "use pressures: surface, P, value");
  if (surface == surfaces_.end() || surface->second.empty())
    return line.error(0, fmt::format("there is no surface \"{}\" of faces", line.text(0)), "define it with *SURFACE, TYPE=ELEMENT before");
  for (const SurfaceFace& at : surface->second) put(surface_pressures_, {at.element, at.face, by * at.sign * line.number_at(2)});
}

InpData InpLoads::transform(const FieldLine& card, const InpParameters& parameters) {
  const std::string name = value_of(parameters, "NSET"), type = value_of(parameters, "TYPE");
  if (!type.empty() && type != "R" && type != "C") card.error(0, fmt::format("the frame of nodes is of type {}", type), "use R or C");
  return [this, name, cylindrical = type == "C"](const FieldLine& line) {
    const FrameByPoints frame{{line.number_at(0), line.number_at(1), line.number_at(2)}, {line.number_at(3), line.number_at(4), line.number_at(5)}, cylindrical};
    if (!frame.is_one()) return line.error(0, "these points make no frame", "give two points apart, none at the origin");
    transforms_.emplace_back(name, frame);
  };
}

NodalFrames InpLoads::frames(const Model& model) {
  NodalFrames frames;
  for (const auto& [name, frame] : transforms_) {
    const auto set = found_by_name(sets_.nodes, name);
    if (set == sets_.nodes.end()) {
      diagnostics_.error({file_, 0, 0}, fmt::format("there is no set \"{}\" of nodes, which *TRANSFORM names", name), "define it with *NSET");
      continue;
    }
    const std::set<int> members(set->second.begin(), set->second.end());
    for (const ModelNode& node : model.nodes)
      if (members.contains(node.number)) frames[node.number] = frame.at(node.at);
  }
  return frames;
}

void InpLoads::give(Model& model) {
  check_faces(model);
  check_weights(model);
  model.supports = std::move(supports_);
  model.forces = std::move(forces_.all);
  model.pressures = std::move(pressures_.all);
  model.pressures.insert(model.pressures.end(), surface_pressures_.all.begin(), surface_pressures_.all.end());
  model.weights = std::move(weights_.all);
  turn_into_global(model, frames(model), file_, diagnostics_);
}

}  // namespace snug::mesh
