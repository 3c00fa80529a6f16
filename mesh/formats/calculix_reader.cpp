#include <fmt/format.h>

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "mesh/formats/calculix_loads.hpp"
#include "mesh/formats/calculix_material.hpp"
#include "mesh/formats/calculix_sets.hpp"
#include "mesh/formats/calculix_source.hpp"

namespace snug::mesh {

namespace {

class InpReader {
 public:
  InpReader(const std::string& text, const std::string& file, const IncludeRules& rules, input::Diagnostics& diagnostics, int load_step)
      : source_(text, file, rules), file_(file), diagnostics_(diagnostics), loads_(sets_, file, diagnostics, load_step), load_step_(load_step) {}

  Model read() {
    for (std::string_view line; source_.next(line) && diagnostics_.errors().size() < most_model_errors;) {
      const FieldLine fields{source_.file(), source_.number(), fields_of(line), diagnostics_};
      if (trimmed(line).starts_with("*"))
        keyword(fields);
      else if (data_)
        data_(fields);
    }
    return assemble();
  }

 private:
  /// Value of a parameter of the last keyword, "TYPE=S4": upper case, empty where it has none.
  std::string parameter(const std::string& key) const { return value_of(parameters_, key); }

  void keyword(const FieldLine& line) {
    std::string name = upper_case(line.text(0).substr(1));
    std::erase_if(name, [](char c) { return c == ' ' || c == '\t'; });
    parameters_.clear();
    for (std::size_t f = 1; f < line.fields.size(); ++f) {
      const std::string_view text = line.text(f);
      const auto equals = text.find('=');
      std::string key = upper_case(trimmed(text.substr(0, equals)));
      std::erase(key, ' ');
      if (!key.empty()) parameters_[key] = equals == text.npos ? "" : inp_name(text.substr(equals + 1));
      if (key == "INPUT" && name == "INCLUDE")
        return source_.include(std::string(trimmed(text.substr(equals + 1))), line.at(f), diagnostics_);
    }
    data_ = {};
    if (loads_.over() && name != "STEP") return;
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
        {"NSET", [](R& r, L) { r.data_ = r.sets_.read(r.parameters_); }},
        {"ELSET", [](R& r, L) { r.data_ = r.sets_.read(r.parameters_); }},
        {"SURFACE", [](R& r, L l) { r.data_ = r.loads_.surface(l, r.parameters_); }},
        {"TRANSFORM", [](R& r, L l) { r.data_ = r.loads_.transform(l, r.parameters_); }},
        {"AMPLITUDE", [](R& r, L) { r.data_ = r.loads_.amplitude(r.parameters_); }},
        {"MATERIAL", [](R& r, L) { r.model_.materials.push_back({r.parameter("NAME"), ModelLaw::none, {}, 0.0}); }},
        {"ELASTIC", [](R& r, L l) { r.data_ = r.constants(l, true); }},
        {"HYPERELASTIC", [](R& r, L l) { r.data_ = r.constants(l, false); }},
        {"DENSITY", [](R& r, L) { r.data_ = [&r](L d) { if (r.material()) r.material()->density = d.number_at(0); }; }},
        {"SOLIDSECTION", [](R& r, L l) { r.section(l, false); }},
        {"SHELLSECTION", [](R& r, L l) { r.section(l, true), r.data_ = [&r](L d) { r.thickness(d); }; }},
        {"BOUNDARY", [](R& r, L l) { r.data_ = r.loads_.boundary(l, r.parameters_); }},
        {"CLOAD", [](R& r, L l) { r.data_ = r.loads_.forces(l, r.parameters_); }},
        {"DLOAD", [](R& r, L l) { r.data_ = r.loads_.pressures(l, r.parameters_); }},
        {"DSLOAD", [](R& r, L l) { r.data_ = r.loads_.surface_pressures(l, r.parameters_); }},
        {"PART", [](R& r, L l) { if (++r.parts_ > 1) l.error(0, "there is a second part", "give one part: merge the parts, or write a flat input"); }},
        {"INSTANCE", [](R& r, L l) { r.instance(l); }},
        {"STEP", [](R& r, L l) { r.loads_.step(l, r.parameters_); }},
        {"STATIC", [](R& r, L) { r.data_ = r.loads_.static_step(); }}};
    return table;
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
  InpData nodes(const FieldLine& card) {
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
      if (!name.empty()) sets_.nodes[name].push_back(number);
    };
  }

  /// Elements of lines and surfaces only mark them where there are solids.
  InpData elements(const FieldLine& card) {
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
        sets_.elements[name].push_back(pending_->number);
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

  ModelMaterial* material() { return model_.materials.empty() ? nullptr : &model_.materials.back(); }

  InpData constants(const FieldLine& card, bool elastic) {
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
    for (const auto& [name, members] : sets_.elements) {
      if (name.empty() || members.empty() || sets_.nodes.contains(name)) continue;
      if (!std::all_of(members.begin(), members.end(), [&](int e) { return marks_.contains(e); })) continue;
      std::vector<int>& nodes = sets_.nodes[name];
      for (const int element : members) nodes.insert(nodes.end(), marks_.at(element).nodes.begin(), marks_.at(element).nodes.end());
    }
  }

  Model assemble() {
    sets_.nodes.erase("");
    sets_.drop_gaps(model_.nodes);
    std::map<int, std::size_t> place;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) place[model_.elements[e].number] = e;
    for (const Section& section : sections_) apply(section, place);
    take_marks();
    loads_.give(model_);
    model_.node_sets = std::move(sets_.nodes);
    tell_load_step(model_, loads_.steps(), load_step_, {file_, loads_.step_line(), loads_.steps() > 0 ? 1 : 0}, diagnostics_);
    const bool elastic = std::any_of(model_.materials.begin(), model_.materials.end(), [](const auto& m) { return m.law == ModelLaw::elastic; });
    if (loads_.steps() > 0 && !loads_.large_displacements() && elastic) model_.remarks.push_back(linear_step_remark(file_, "*STEP, NLGEOM", loads_.step_line()));
    for (const ModelElement& element : model_.elements)
      if ((element.material < 0 || (is_shell(element.kind) && element.section < 0)) && diagnostics_.errors().size() < most_model_errors)
        diagnostics_.error({file_, model_.element_line[element.number], 1}, fmt::format("element {} has no section", element.number),
                           is_shell(element.kind) ? "give its set a *SHELL SECTION with a thickness" : "give its set a *SOLID SECTION");
    finish(model_, file_, diagnostics_);
    return std::move(model_);
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
    const auto set = found_by_name(sets_.elements, section.elements);
    if (set == sets_.elements.end())
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
  InpSets sets_;
  InpLoads loads_;
  InpParameters parameters_;
  std::map<int, Mark> marks_;
  std::vector<Section> sections_;
  std::optional<ModelElement> pending_;
  InpData data_;
  int load_step_, parts_ = 0, instances_ = 0;
};

}  // namespace

Model parse_calculix(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics, const std::filesystem::path& folder,
                     const std::filesystem::path& root, int load_step) {
  return InpReader(text, shown_as, {folder, root}, diagnostics, load_step).read();
}

}  // namespace snug::mesh
