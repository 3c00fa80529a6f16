#include <fmt/format.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <set>

#include "mesh/formats/calculix_material.hpp"
#include "mesh/formats/calculix_source.hpp"
#include "mesh/formats/calculix_words.hpp"
#include "mesh/formats/nodal_frames.hpp"

namespace snug::mesh {

namespace {

constexpr std::size_t most_errors = most_model_errors;

/// A name as it is compared: capitals, without quotes and without the instance before its point.
std::string name_of(std::string_view text) {
  text = trimmed(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"') text = trimmed(text.substr(1, text.size() - 2));
  return upper_case(text);
}

class InpReader {
 public:
  InpReader(const std::string& text, const std::string& file, const IncludeRules& rules, input::Diagnostics& diagnostics)
      : source_(text, file, rules), file_(file), diagnostics_(diagnostics) {}

  Model read() {
    for (std::string_view line; source_.next(line) && diagnostics_.errors().size() < most_errors;) {
      const FieldLine fields{source_.file(), source_.number(), fields_of(line), diagnostics_};
      if (trimmed(line).starts_with("*"))
        keyword(fields);
      else if (data_)
        data_(fields);
    }
    return assemble();
  }

 private:
  using Data = std::function<void(const FieldLine&)>;

  /// A set by its name, or by that behind the name of an instance ("Part-1-1.top").
  template <class Sets>
  static auto found(Sets& sets, std::string_view text) {
    const auto whole = sets.find(name_of(text));
    const auto point = text.find('.');
    return whole != sets.end() || point == text.npos ? whole : sets.find(name_of(text.substr(point + 1)));
  }

  /// Value of a parameter of the last keyword, "TYPE=S4": upper case, empty where it has none.
  std::string parameter(const std::string& key) const {
    const auto it = parameters_.find(key);
    return it == parameters_.end() ? "" : it->second;
  }

  void keyword(const FieldLine& line) {
    std::string name = upper_case(line.text(0).substr(1));
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t'; });
    parameters_.clear();
    for (std::size_t f = 1; f < line.fields.size(); ++f) {
      const std::string_view text = line.text(f);
      const auto equals = text.find('=');
      std::string key = upper_case(trimmed(text.substr(0, equals)));
      std::erase(key, ' ');
      if (!key.empty()) parameters_[key] = equals == text.npos ? "" : name_of(text.substr(equals + 1));
      if (key == "INPUT" && name == "INCLUDE")
        return source_.include(std::string(trimmed(text.substr(equals + 1))), line.at(f), diagnostics_);
    }
    data_ = {};
    const auto& table = cards();
    if (const auto card = table.find(name); card != table.end()) {
      card->second(*this, line);
      for (std::size_t f = 1; f < line.fields.size(); ++f)  // *NODE, INPUT=...: the data lines stand in a file
        if (const auto equals = line.text(f).find('='); upper_case(trimmed(line.text(f).substr(0, equals))) == "INPUT")
          source_.include(std::string(trimmed(line.text(f).substr(equals + 1))), line.at(f), diagnostics_);
      return;
    }
    if (!is_card_without_meaning(name))
      line.error(0, fmt::format("the card {} is not taken over", line.text(0)),
                 "leave it out; snug reads nodes, elements, sets, materials, sections, surfaces, supports, forces and pressures of one static step");
  }

  using Card = std::function<void(InpReader&, const FieldLine&)>;
  static const std::map<std::string, Card>& cards() {
    using R = InpReader;
    using L = const FieldLine&;
    static const std::map<std::string, Card> table = {
        {"NODE", [](R& r, L l) { r.data_ = r.nodes(l); }},
        {"ELEMENT", [](R& r, L l) { r.data_ = r.elements(l); }},
        {"NSET", [](R& r, L) { r.data_ = r.set(r.model_.node_sets[r.parameter("NSET")]); }},
        {"ELSET", [](R& r, L) { r.data_ = r.set(r.element_sets_[r.parameter("ELSET")]); }},
        {"SURFACE", [](R& r, L l) { r.data_ = r.surface(l); }},
        {"TRANSFORM", [](R& r, L l) { r.data_ = r.transform(l); }},
        {"AMPLITUDE", [](R& r, L) { r.data_ = r.amplitude(); }},
        {"MATERIAL", [](R& r, L) { r.model_.materials.push_back({r.parameter("NAME"), ModelLaw::none, {}, 0.0}); }},
        {"ELASTIC", [](R& r, L l) { r.data_ = r.constants(l, true); }},
        {"HYPERELASTIC", [](R& r, L l) { r.data_ = r.constants(l, false); }},
        {"DENSITY", [](R& r, L) { r.data_ = [&r](L d) { if (r.material()) r.material()->density = d.number_at(0); }; }},
        {"SOLIDSECTION", [](R& r, L l) { r.section(l, false); }},
        {"SHELLSECTION", [](R& r, L l) { r.section(l, true), r.data_ = [&r](L d) { r.thickness(d); }; }},
        {"BOUNDARY", [](R& r, L l) { r.data_ = r.scaled(l, [&r](L d, double by) { r.boundary(d, by); }); }},
        {"CLOAD", [](R& r, L l) { r.data_ = r.scaled(l, [&r](L d, double by) { r.force(d, by); }); }},
        {"DLOAD", [](R& r, L l) { r.data_ = r.scaled(l, [&r](L d, double by) { r.pressure(d, by); }); }},
        {"DSLOAD", [](R& r, L l) { r.data_ = r.scaled(l, [&r](L d, double by) { r.surface_pressure(d, by); }); }},
        {"PART", [](R& r, L l) { if (++r.parts_ > 1) l.error(0, "there is a second part", "give one part: merge the parts, or write a flat input"); }},
        {"INSTANCE", [](R& r, L l) { r.instance(l); }},
        {"STEP", [](R& r, L l) { r.step(l); }},
        {"STATIC", [](R& r, L) { r.data_ = [&r](L d) { r.period_ = d.number_at(1, 1.0); }; }}};
    return table;
  }

  void step(const FieldLine& line) {
    ++steps_;
    first_force_ = model_.forces.size(), first_pressure_ = pressures_.size(), first_surface_pressure_ = surface_pressures_.size();
    if (parameters_.contains("PERTURBATION")) line.error(0, "the step is a perturbation of another", "give one static step");
    large_displacements_ = large_displacements_ || (parameters_.contains("NLGEOM") && parameter("NLGEOM") != "NO");
    step_line_ = line.number;
  }

  /// A part stands where its instance puts it.
  void instance(const FieldLine& line) {
    if (++instances_ > 1) return line.error(0, "there is a second instance", "give one instance of one part");
    data_ = [this, moved = false](const FieldLine& data) mutable {
      if (moved) return data.error(0, "the instance is turned", "turn the part itself");
      const Eigen::Vector3d way(data.number_at(0), data.number_at(1), data.number_at(2));
      for (ModelNode& node : model_.nodes) node.at += way;
      moved = true;
    };
  }

  /// SYSTEM=C: radius, angle in degrees, height.
  Data nodes(const FieldLine& card) {
    const std::string name = parameter("NSET"), system = parameter("SYSTEM");
    if (!system.empty() && system != "R" && system != "C")
      card.error(0, fmt::format("the nodes are given in the system {}", system), "give them as x, y, z (R), or radius, angle, z (C)");
    const bool cylindrical = system == "C";
    return [this, name, cylindrical](const FieldLine& line) {
      const int number = line.integer_at(0);
      if (number < 1) return line.error(0, fmt::format("\"{}\" is no node number", line.text(0)), "nodes count from 1");
      Eigen::Vector3d at(line.number_at(1), line.number_at(2), line.number_at(3));
      if (cylindrical) at.head<2>() = at.x() * Eigen::Vector2d(std::cos(at.y() * std::numbers::pi / 180.0), std::sin(at.y() * std::numbers::pi / 180.0));
      model_.nodes.push_back({number, at});
      if (!name.empty()) model_.node_sets[name].push_back(number);
    };
  }

  /// Elements of lines and surfaces only mark them where there are solids.
  Data elements(const FieldLine& card) {
    const std::string type = parameter("TYPE"), name = parameter("ELSET");
    const auto kind = element_kind_of(type);
    const int marking = marking_nodes_of(type), due = kind ? node_count(*kind) : marking;
    if (due == 0) {
      card.error(1, fmt::format("elements of type {} are not taken over", type), supported_inp_elements);
      return {};
    }
    pending_.reset();
    return [this, kind, due, type, name](const FieldLine& line) {
      std::size_t f = 0;
      if (!pending_ || static_cast<int>(pending_->nodes.size()) >= due) {
        pending_ = ModelElement{line.integer_at(f++), kind.value_or(ElementKind::tri3), {}, -1, -1};
        if (source_.in_main_file()) model_.element_line[pending_->number] = line.number;
        element_sets_[name].push_back(pending_->number);
      }
      for (; f < line.fields.size(); ++f) {
        if (line.empty(f) && f + 1 == line.fields.size()) break;  // the comma before a continuation
        pending_->nodes.push_back(line.integer_at(f));
      }
      const int count = static_cast<int>(pending_->nodes.size());
      const bool continues = line.text(line.fields.size() - 1).empty();
      if (count == due && kind) model_.elements.push_back(*pending_);
      if (count == due && !kind) marks_[pending_->number] = {type, pending_->nodes};
      if (count > due || (count < due && !continues)) {
        line.error(0, fmt::format("element {} has {} nodes where a {} has {}", pending_->number, count, kind ? to_string(*kind) : type, due),
                   "complete it; a line that goes on ends in a comma");
        pending_.reset();
      }
    };
  }

  /// Numbers or names of other sets; GENERATE: from, to, step.
  Data set(std::vector<int>& members) {
    const bool generate = parameters_.contains("GENERATE"), of_nodes = parameters_.contains("NSET");
    if (generate && of_nodes) generated_.insert(parameter("NSET"));
    return [this, &members, generate, of_nodes](const FieldLine& line) {
      if (generate) {
        const int first = line.integer_at(0), last = line.integer_at(1), step = std::max(1, line.integer_at(2, 1));
        if (last < first || (last - first) / step > 10'000'000 || members.size() > 20'000'000)
          return line.error(1, "this is no range", "write first, last, step");
        for (long n = first; n <= last; n += step) members.push_back(static_cast<int>(n));
        return;
      }
      for (std::size_t f = 0; f < line.fields.size(); ++f) {
        if (line.empty(f)) continue;
        if (const auto number = integer_of(line.text(f))) {
          members.push_back(*number);
          continue;
        }
        const auto& sets = of_nodes ? model_.node_sets : element_sets_;
        const auto other = found(sets, line.text(f));
        if (other == sets.end() || other->second.size() + members.size() > 20'000'000)
          return line.error(f, fmt::format("there is no set \"{}\"", line.text(f)), "define it before, or give numbers");
        const std::vector<int> copy = other->second;
        members.insert(members.end(), copy.begin(), copy.end());
      }
    };
  }

  ModelMaterial* material() { return model_.materials.empty() ? nullptr : &model_.materials.back(); }

  Data constants(const FieldLine& card, bool elastic) {
    if (!material()) {
      card.error(0, "these constants belong to no material", "write *MATERIAL, NAME=... before them");
      return {};
    }
    if (material()->law != ModelLaw::none) card.error(0, "the material has a law already", "give it one");
    return [this, constants = InpConstants(card, parameters_, elastic)](const FieldLine& line) mutable { constants.take(line, *material()); };
  }

  struct Section {
    std::string elements, material;
    double thickness = 0.0;
    int line = 0;
  };
  void section(const FieldLine& line, bool shell) {
    sections_.push_back({parameter("ELSET"), parameter("MATERIAL"), 0.0, line.number});
    if (parameters_.contains("COMPOSITE")) line.error(0, "the shell has several layers", "use one layer");
    if (shell && parameters_.contains("OFFSET") && number_of(parameter("OFFSET")).value_or(1.0) != 0.0)
      line.error(0, "the shell is off its nodes", "leave OFFSET out");
  }
  void thickness(const FieldLine& line) {
    sections_.back().thickness = line.number_at(0);
    if (!(sections_.back().thickness > 0.0)) line.error(0, "a shell needs a positive thickness", "give it in the line after *SHELL SECTION");
  }

  using Scaled = std::function<void(const FieldLine&, double)>;
  /// Data of a load with the value that its amplitude has at the end of the step.
  Data scaled(const FieldLine& card, Scaled take) {
    if (const std::string type = parameter("TYPE"); !type.empty() && type != "DISPLACEMENT")
      card.error(0, fmt::format("the type {} is not taken over", type), "prescribe displacements");
    if (parameter("OP") == "NEW") remove_earlier(card);
    for (const auto& [key, value] : parameters_)
      if (key != "OP" && key != "AMPLITUDE" && key != "TYPE" && key != "INPUT" && key != "LOADCASE")
        card.error(0, fmt::format("the parameter {} is not taken over", key), "of supports and loads OP, AMPLITUDE and TYPE are read");
    double by = 1.0;
    if (const std::string name = parameter("AMPLITUDE"); !name.empty()) {
      const auto amplitude = amplitudes_.find(name);
      if (amplitude == amplitudes_.end() || amplitude->second.empty())
        card.error(0, fmt::format("there is no amplitude \"{}\"", name), "define it with *AMPLITUDE before, as pairs of time and value");
      else
        by = interpolated(amplitude->second, period_);
    }
    return [take = std::move(take), by](const FieldLine& line) { take(line, by); };
  }
  /// OP=NEW: what earlier steps have set of this kind is over.
  void remove_earlier(const FieldLine& card) {
    std::string name = upper_case(card.text(0).substr(1));
    std::erase(name, ' ');
    if (name == "BOUNDARY") model_.supports.clear();
    if (name == "CLOAD") model_.forces.clear(), first_force_ = 0;
    if (name == "DLOAD") pressures_.clear(), first_pressure_ = 0;
    if (name == "DSLOAD") surface_pressures_.clear(), first_surface_pressure_ = 0;
  }
  /// Adds a load, or puts its value in the place of that of an earlier step.
  template <class Load, class Same>
  static void put(std::vector<Load>& loads, std::size_t first_of_step, const Load& load, Same same) {
    const auto end = loads.begin() + static_cast<std::ptrdiff_t>(first_of_step);
    const auto earlier = std::find_if(loads.begin(), end, same);
    if (earlier != end) *earlier = load;
    else loads.push_back(load);
  }
  void put(std::vector<ModelPressure>& pressures, std::size_t first_of_step, const ModelPressure& pressure) const {
    put(pressures, first_of_step, pressure, [&](const ModelPressure& p) { return p.element == pressure.element && p.face == pressure.face; });
  }

  Data amplitude() {
    auto& pairs = amplitudes_[parameter("NAME")];
    return [&pairs](const FieldLine& line) {
      for (std::size_t f = 0; f + 1 < line.fields.size(); f += 2)
        if (!line.empty(f)) pairs.emplace_back(line.number_at(f), line.number_at(f + 1));
    };
  }
  Data transform(const FieldLine& card) {
    const std::string name = parameter("NSET"), type = parameter("TYPE");
    if (!type.empty() && type != "R" && type != "C") card.error(0, fmt::format("the frame of nodes is of type {}", type), "use R or C");
    return [this, name, cylindrical = type == "C"](const FieldLine& line) {
      const FrameByPoints frame{{line.number_at(0), line.number_at(1), line.number_at(2)}, {line.number_at(3), line.number_at(4), line.number_at(5)}, cylindrical};
      if (!frame.is_one()) return line.error(0, "these points make no frame", "give two points apart, none at the origin");
      transforms_.emplace_back(name, frame);
    };
  }
  NodalFrames frames() {
    NodalFrames frames;
    for (const auto& [name, frame] : transforms_) {
      const auto set = found(model_.node_sets, name);
      if (set == model_.node_sets.end()) {
        diagnostics_.error({file_, 0, 0}, fmt::format("there is no set \"{}\" of nodes, which *TRANSFORM names", name), "define it with *NSET");
        continue;
      }
      const std::set<int> members(set->second.begin(), set->second.end());
      for (const ModelNode& node : model_.nodes)
        if (members.contains(node.number)) frames[node.number] = frame.at(node.at);
    }
    return frames;
  }

  /// A number or a set in field 0.
  std::vector<int> nodes_named(const FieldLine& line) {
    if (const auto number = integer_of(line.text(0))) return {*number};
    const auto set = found(model_.node_sets, line.text(0));
    if (set != model_.node_sets.end()) return set->second;
    line.error(0, fmt::format("there is no set \"{}\" of nodes", line.text(0)), "define it with *NSET, or give a number");
    return {};
  }
  std::vector<int> elements_named(const FieldLine& line) {
    if (const auto number = integer_of(line.text(0))) return {*number};
    const auto set = found(element_sets_, line.text(0));
    if (set != element_sets_.end()) return set->second;
    line.error(0, fmt::format("there is no set \"{}\" of elements", line.text(0)), "define it with *ELSET, or give a number");
    return {};
  }

  void boundary(const FieldLine& line, double by) {
    std::vector<int> components = held_by_name(upper_case(line.text(1)));
    if (components.empty()) {
      const int first = line.integer_at(1), last = line.integer_at(2, first);
      if (first < 1 || last > 6 || last < first)
        return line.error(1, "this is no component of displacement",
                          "write node, first component, last component, value (1 to 3; 4 to 6 of shells), or ENCASTRE, PINNED, XSYMM ...");
      for (int c = first; c <= last; ++c) components.push_back(c - 1);
    }
    for (const int node : nodes_named(line))
      for (const int c : components) model_.supports.push_back({node, c, by * line.number_at(3)});
  }

  void force(const FieldLine& line, double by) {
    const int component = line.integer_at(1);
    if (component < 1 || component > 3)
      return line.error(1, "this is no force", "write node, component 1 to 3, force; moments are not taken over");
    for (const int node : nodes_named(line))
      put(model_.forces, first_force_, {node, component - 1, by * line.number_at(2)},
          [&](const ModelForce& f) { return f.node == node && f.component == component - 1; });
  }

  /// P1 ... P6 of solids, P of shells (along the normal of a shell: CalculiX manual, *DLOAD).
  void pressure(const FieldLine& line, double by) {
    const std::string label = upper_case(line.text(1));
    const int face = label.size() == 2 && label[0] == 'P' ? label[1] - '1' : label == "P" ? 0 : -1;
    if (face < 0 || face > 5)
      return line.error(1, fmt::format("the load {} is not taken over", line.text(1)), "use pressures P1 ... P6, or [load] gravity in case.toml");
    for (const int element : elements_named(line)) put(pressures_, first_pressure_, {element, face, by * line.number_at(2)});
  }

  /// S1 ... S6 of solids; SPOS and SNEG of shells, of which a pressure on the upper side (SPOS) acts against the normal.
  Data surface(const FieldLine& card) {
    std::vector<SurfaceFace>& faces = surfaces_[parameter("NAME")];
    const bool of_nodes = parameter("TYPE") == "NODE";
    if (parameters_.contains("COMBINE")) card.error(0, "the surface is made of others", "give its elements and faces");
    return [this, &faces, of_nodes](const FieldLine& line) {
      if (of_nodes) return;
      const std::string label = upper_case(line.text(1));
      const bool numbered = label.size() == 2 && label[0] == 'S' && label[1] >= '1' && label[1] <= '6';
      if (!numbered && label != "SPOS" && label != "SNEG")
        return line.error(1, fmt::format("\"{}\" is no face of an element", line.text(1)), "write S1 to S6, of shells SPOS or SNEG");
      for (const int element : elements_named(line)) faces.push_back({element, numbered ? label[1] - '1' : 0, label == "SPOS" ? -1.0 : 1.0});
    };
  }
  void surface_pressure(const FieldLine& line, double by) {
    const auto surface = found(surfaces_, line.text(0));
    if (upper_case(line.text(1)) != "P") return line.error(1, fmt::format("the load {} is not taken over", line.text(1)), "use pressures: surface, P, value");
    if (surface == surfaces_.end() || surface->second.empty())
      return line.error(0, fmt::format("there is no surface \"{}\" of faces", line.text(0)), "define it with *SURFACE, TYPE=ELEMENT before");
    for (const SurfaceFace& at : surface->second) put(surface_pressures_, first_surface_pressure_, {at.element, at.face, by * at.sign * line.number_at(2)});
  }
  struct SurfaceFace {
    int element, face;
    double sign;
  };

  /// What only marks lines and surfaces beside the solids leaves sets of nodes.
  void take_marks() {
    const bool solids = std::any_of(model_.elements.begin(), model_.elements.end(), [](const ModelElement& e) { return !is_shell(e.kind); });
    if (!solids && !marks_.empty()) {
      const auto& [number, mark] = *marks_.begin();
      return diagnostics_.error({file_, model_.line_of(number), 1}, fmt::format("elements of type {} are not taken over", mark.type), supported_inp_elements);
    }
    if (solids)
      std::erase_if(model_.elements, [&](const ModelElement& e) {
        const bool mark = is_shell(e.kind) && e.material < 0;
        if (mark) marks_[e.number] = {"a shell", e.nodes};
        return mark;
      });
    for (const auto& [name, members] : element_sets_) {
      if (name.empty() || members.empty() || model_.node_sets.contains(name)) continue;
      if (!std::all_of(members.begin(), members.end(), [&](int e) { return marks_.contains(e); })) continue;
      std::vector<int>& nodes = model_.node_sets[name];
      for (const int element : members) nodes.insert(nodes.end(), marks_.at(element).nodes.begin(), marks_.at(element).nodes.end());
    }
  }

  Model assemble() {
    model_.node_sets.erase("");
    drop_gaps();
    std::map<int, std::size_t> place;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) place[model_.elements[e].number] = e;
    for (const Section& section : sections_) apply(section, place);
    take_marks();
    model_.pressures = pressures_;
    model_.pressures.insert(model_.pressures.end(), surface_pressures_.begin(), surface_pressures_.end());
    if (steps_ > 1)
      model_.remarks.push_back({{file_, step_line_, 1}, fmt::format("there are {} steps: the loads and supports at the end of the last one are brought up together", steps_),
                                "take later steps away to have the end of an earlier one"});
    turn_into_global(model_, frames(), file_, diagnostics_);
    const bool elastic = std::any_of(model_.materials.begin(), model_.materials.end(), [](const auto& m) { return m.law == ModelLaw::elastic; });
    if (steps_ > 0 && !large_displacements_ && elastic) model_.remarks.push_back(linear_step_remark(file_, "*STEP, NLGEOM", step_line_));
    for (const ModelElement& element : model_.elements)
      if ((element.material < 0 || (is_shell(element.kind) && element.section < 0)) && diagnostics_.errors().size() < most_errors)
        diagnostics_.error({file_, model_.element_line[element.number], 1}, fmt::format("element {} has no section", element.number),
                           is_shell(element.kind) ? "give its set a *SHELL SECTION with a thickness" : "give its set a *SOLID SECTION");
    finish(model_, file_, diagnostics_);
    return std::move(model_);
  }

  /// Ranges may run over numbers that are not used.
  void drop_gaps() {
    std::set<int> known;
    if (!generated_.empty())
      for (const ModelNode& node : model_.nodes) known.insert(node.number);
    for (const std::string& name : generated_)
      if (const auto set = model_.node_sets.find(name); set != model_.node_sets.end()) std::erase_if(set->second, [&](int node) { return !known.contains(node); });
  }

  void apply(const Section& section, const std::map<int, std::size_t>& place) {
    int material = -1;
    for (std::size_t m = 0; m < model_.materials.size(); ++m)
      if (model_.materials[m].name == section.material) material = static_cast<int>(m);
    if (material < 0)
      return diagnostics_.error({file_, section.line, 1}, fmt::format("there is no material \"{}\"", section.material), "define it with *MATERIAL, NAME=...");
    int number = -1;
    if (section.thickness > 0.0) {
      const ModelSection shell{section.thickness, 0.0};
      number = static_cast<int>(std::find(model_.sections.begin(), model_.sections.end(), shell) - model_.sections.begin());
      if (number == static_cast<int>(model_.sections.size())) model_.sections.push_back(shell);
    }
    const auto set = found(element_sets_, section.elements);
    if (set == element_sets_.end())
      return diagnostics_.error({file_, section.line, 1}, fmt::format("there is no set \"{}\" of elements", section.elements), "define it with *ELSET");
    for (const int e : set->second)
      if (const auto it = place.find(e); it != place.end()) {
        model_.elements[it->second].material = material;
        if (is_shell(model_.elements[it->second].kind)) model_.elements[it->second].section = number;
      }
  }

  struct Mark {
    std::string type;
    std::vector<int> nodes;
  };

  InpSource source_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  Model model_;
  InpParameters parameters_;
  std::map<std::string, std::vector<int>> element_sets_;
  std::map<std::string, std::vector<SurfaceFace>> surfaces_;
  std::map<std::string, std::vector<std::pair<double, double>>> amplitudes_;  ///< times and values
  std::map<int, Mark> marks_;
  std::set<std::string> generated_;  ///< sets of nodes by ranges
  std::vector<std::pair<std::string, FrameByPoints>> transforms_;  ///< of sets of nodes
  std::vector<Section> sections_;
  std::optional<ModelElement> pending_;
  Data data_;
  std::vector<ModelPressure> pressures_, surface_pressures_;  ///< of *DLOAD and *DSLOAD
  std::size_t first_force_ = 0, first_pressure_ = 0, first_surface_pressure_ = 0;  ///< those of the present step
  int steps_ = 0, parts_ = 0, instances_ = 0, step_line_ = 0;
  double period_ = 1.0;  ///< of the step
  bool large_displacements_ = false;
};

}  // namespace

Model parse_calculix(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, const std::filesystem::path& folder,
                     const std::filesystem::path& root) {
  return InpReader(text, shown_as, {folder, root}, diagnostics).read();
}

}  // namespace snug::mesh
