#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "mesh/formats/apdl_deck.hpp"

namespace snug::mesh {

namespace {

constexpr std::size_t most_errors = 20;

struct InpElement {
  ModelElement element;
  std::string set;
};

/// Cards that say nothing about the model of one static step.
const std::set<std::string>& without_meaning() {
  static const std::set<std::string> names = {
      "HEADING", "STEP", "STATIC", "ENDSTEP", "NODEPRINT", "NODEFILE", "NODEOUTPUT", "ELPRINT", "ELFILE", "ELEMENTOUTPUT",
      "CONTROLS", "OUTPUT", "RESTART", "PREPRINT", "PREPARSE", "SOLIDSECTIONCONTROLS", "PARAMETER_NONE", "CONTACTFILE",
      "CONTACTPRINT", "PART", "ENDPART", "ASSEMBLY", "ENDASSEMBLY", "ENDINSTANCE", "EXPANSION", "CONDUCTIVITY",
      "SPECIFICHEAT", "HISTORYOUTPUT", "FIELDOUTPUT", "MONITOR", "FILEFORMAT", "SECTIONCONTROLS"};
  return names;
}

/// Kind of an element type; the letters of reduced integration and the like change nothing here.
const std::map<std::string, ElementKind>& element_types() {
  static const std::map<std::string, ElementKind> types = {
      {"C3D4", ElementKind::tet4},   {"C3D10", ElementKind::tet10}, {"C3D10M", ElementKind::tet10}, {"C3D10T", ElementKind::tet10},
      {"C3D10H", ElementKind::tet10}, {"C3D8", ElementKind::hex8},  {"C3D8R", ElementKind::hex8},   {"C3D8I", ElementKind::hex8},
      {"C3D8H", ElementKind::hex8},  {"C3D20", ElementKind::hex20}, {"C3D20R", ElementKind::hex20}, {"C3D20H", ElementKind::hex20},
      {"C3D20RH", ElementKind::hex20}, {"S3", ElementKind::tri3},   {"S3R", ElementKind::tri3},     {"S6", ElementKind::tri6},
      {"STRI65", ElementKind::tri6}, {"S4", ElementKind::quad4},    {"S4R", ElementKind::quad4},    {"S8", ElementKind::quad8},
      {"S8R", ElementKind::quad8}};
  return types;
}
constexpr const char* supported = "snug reads C3D4 C3D10 C3D8 C3D20 (also R, I, H) and the shells S3 S4 S6 S8 (also R)";

class InpReader {
 public:
  InpReader(const std::string& text, const std::string& file, input::Diagnostics& diagnostics)
      : source_(text), file_(file), diagnostics_(diagnostics) {}

  Model read() {
    for (std::string_view line; source_.next(line) && diagnostics_.errors().size() < most_errors;) {
      const std::string_view text = trimmed(line);
      if (text.empty() || text.starts_with("**")) continue;
      const FieldLine fields{file_, source_.number(), fields_of(line), diagnostics_};
      if (text.starts_with("*"))
        keyword(fields);
      else if (data_)
        data_(fields);
    }
    return assemble();
  }

 private:
  using Data = std::function<void(const FieldLine&)>;

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
      parameters_[key] = equals == text.npos ? "" : upper_case(trimmed(text.substr(equals + 1)));
    }
    data_ = {};
    if (name == "NODE") data_ = nodes();
    else if (name == "ELEMENT") data_ = elements(line);
    else if (name == "NSET") data_ = set(model_.node_sets[parameter("NSET")]);
    else if (name == "ELSET") data_ = set(element_sets_[parameter("ELSET")]);
    else if (name == "MATERIAL") begin_material();
    else if (name == "ELASTIC") data_ = constants(line, ModelLaw::elastic);
    else if (name == "HYPERELASTIC") data_ = constants(line, hyperelastic(line));
    else if (name == "DENSITY") data_ = [this](const FieldLine& l) { if (material()) material()->density = l.number_at(0); };
    else if (name == "SOLIDSECTION") section(line, false);
    else if (name == "SHELLSECTION") section(line, true), data_ = [this](const FieldLine& l) { thickness(l); };
    else if (name == "BOUNDARY") data_ = [this](const FieldLine& l) { boundary(l); };
    else if (name == "CLOAD") data_ = [this](const FieldLine& l) { force(l); };
    else if (name == "DLOAD") data_ = [this](const FieldLine& l) { pressure(l); };
    else if (!without_meaning().contains(name) || name == "INSTANCE")
      line.error(0, fmt::format("the card {} is not taken over", line.text(0)),
                 "leave it out; snug reads nodes, elements, sets, materials, sections, *BOUNDARY, *CLOAD and *DLOAD");
    if (name == "STEP" && ++steps_ > 1)
      line.error(0, "there is a second step", "give one step: snug brings all loads up together");
  }

  Data nodes() {
    const std::string name = parameter("NSET");
    return [this, name](const FieldLine& line) {
      const int number = line.integer_at(0);
      if (number < 1) return line.error(0, fmt::format("\"{}\" is no node number", line.text(0)), "nodes count from 1");
      model_.nodes.push_back({number, {line.number_at(1), line.number_at(2), line.number_at(3)}});
      if (!name.empty()) model_.node_sets[name].push_back(number);
    };
  }

  Data elements(const FieldLine& card) {
    const std::string type = parameter("TYPE"), name = parameter("ELSET");
    const auto kind = element_types().find(type);
    if (kind == element_types().end()) {
      card.error(1, fmt::format("elements of type {} are not taken over", type), supported);
      return {};
    }
    const ElementKind of = kind->second;
    pending_.reset();
    return [this, of, name](const FieldLine& line) {
      std::size_t f = 0;
      if (!pending_ || static_cast<int>(pending_->nodes.size()) >= node_count(of)) {
        pending_ = ModelElement{line.integer_at(f++), of, {}, -1, -1};
        model_.element_line[pending_->number] = line.number;
        element_sets_[name].push_back(pending_->number);
      }
      for (; f < line.fields.size(); ++f) {
        if (line.empty(f) && f + 1 == line.fields.size()) break;  // the comma before a continuation
        pending_->nodes.push_back(line.integer_at(f));
      }
      const int count = static_cast<int>(pending_->nodes.size());
      const bool continues = line.text(line.fields.size() - 1).empty();
      if (count == node_count(of)) model_.elements.push_back(*pending_);
      if (count > node_count(of) || (count < node_count(of) && !continues)) {
        line.error(0, fmt::format("element {} has {} nodes where a {} has {}", pending_->number, count, to_string(of), node_count(of)),
                   "complete it; a line that goes on ends in a comma");
        pending_.reset();
      }
    };
  }

  /// Numbers or names of other sets; GENERATE: from, to, step.
  Data set(std::vector<int>& members) {
    const bool generate = parameters_.contains("GENERATE"), of_nodes = parameters_.contains("NSET");
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
        const auto other = sets.find(upper_case(line.text(f)));
        if (other == sets.end() || other->second.size() + members.size() > 20'000'000)
          return line.error(f, fmt::format("there is no set \"{}\"", line.text(f)), "define it before, or give numbers");
        const std::vector<int> copy = other->second;
        members.insert(members.end(), copy.begin(), copy.end());
      }
    };
  }

  void begin_material() { model_.materials.push_back({parameter("NAME"), ModelLaw::none, {}, 0.0}); }
  ModelMaterial* material() { return model_.materials.empty() ? nullptr : &model_.materials.back(); }

  ModelLaw hyperelastic(const FieldLine& line) {
    if (parameters_.contains("NEOHOOKE")) return ModelLaw::neo_hooke;
    if (parameters_.contains("MOONEY-RIVLIN")) return ModelLaw::mooney_rivlin;
    if (parameters_.contains("OGDEN")) return ModelLaw::ogden;
    line.error(0, "this hyperelastic law is not taken over", "use NEO HOOKE, MOONEY-RIVLIN or OGDEN");
    return ModelLaw::none;
  }

  /// CalculiX: C10, D1; C10, C01, D1; mu_1, alpha_1, ..., D_1, ...; kappa = 2/D1, Ogden's mu are our mu alpha/2.
  Data constants(const FieldLine& card, ModelLaw law) {
    if (!material()) {
      card.error(0, "these constants belong to no material", "write *MATERIAL, NAME=... before them");
      return {};
    }
    const int terms = law == ModelLaw::ogden ? std::clamp(integer_of(parameter("N").empty() ? "1" : parameter("N")).value_or(1), 1, 3) : 0;
    if (law == ModelLaw::elastic && !parameter("TYPE").empty() && parameter("TYPE").substr(0, 3) != "ISO")
      card.error(1, "the material is not isotropic", "use *ELASTIC with E and nu");
    return [this, law, terms](const FieldLine& line) {
      if (material()->law != ModelLaw::none)
        return line.error(0, "the constants depend on the temperature, or go on", "give one line of constants");
      std::vector<double>& c = material()->constants;
      material()->law = law;
      const auto at = [&](std::size_t f) { return line.number_at(f); };
      if (law == ModelLaw::elastic) c = {at(0), at(1)};
      if (law == ModelLaw::neo_hooke) c = {2.0 * at(0), 2.0 / at(1)};
      if (law == ModelLaw::mooney_rivlin) c = {at(0), at(1), 2.0 / at(2)};
      for (int t = 0; t < terms; ++t) c.insert(c.end(), {2.0 * at(2 * t) / at(2 * t + 1), at(2 * t + 1)});
      if (law == ModelLaw::ogden) c.push_back(2.0 / at(2 * terms));
      for (const double value : c)
        if (!std::isfinite(value)) line.error(0, "the material is perfectly incompressible or incomplete (D1 = 0)", "give D1 = 2/kappa");
    };
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
    if (parameters_.contains("ORIENTATION")) line.error(0, "the section has an orientation", "materials are isotropic: leave it out");
  }
  void thickness(const FieldLine& line) {
    sections_.back().thickness = line.number_at(0);
    if (!(sections_.back().thickness > 0.0)) line.error(0, "a shell needs a positive thickness", "give it in the line after *SHELL SECTION");
  }

  /// A number or a set in field 0.
  std::vector<int> nodes_named(const FieldLine& line) {
    if (const auto number = integer_of(line.text(0))) return {*number};
    const auto set = model_.node_sets.find(upper_case(line.text(0)));
    if (set != model_.node_sets.end()) return set->second;
    line.error(0, fmt::format("there is no set \"{}\" of nodes", line.text(0)), "define it with *NSET, or give a number");
    return {};
  }

  void boundary(const FieldLine& line) {
    const int first = line.integer_at(1), last = line.integer_at(2, first);
    if (first < 1 || last > 6 || last < first)
      return line.error(1, "this is no component of displacement", "write node, first component, last component, value (1 to 3; 4 to 6 of shells)");
    for (const int node : nodes_named(line))
      for (int c = first; c <= last; ++c) model_.supports.push_back({node, c - 1, line.number_at(3)});
  }

  void force(const FieldLine& line) {
    const int component = line.integer_at(1);
    if (component < 1 || component > 3)
      return line.error(1, "this is no force", "write node, component 1 to 3, force; moments are not taken over");
    for (const int node : nodes_named(line)) model_.forces.push_back({node, component - 1, line.number_at(2)});
  }

  /// P1 ... P6 of solids, P of shells (along the normal of a shell: CalculiX manual, *DLOAD).
  void pressure(const FieldLine& line) {
    const std::string label = upper_case(line.text(1));
    const int face = label.size() == 2 && label[0] == 'P' ? label[1] - '1' : label == "P" ? 0 : -1;
    if (face < 0 || face > 5)
      return line.error(1, fmt::format("the load {} is not taken over", line.text(1)), "use pressures P1 ... P6, or [load] gravity in case.toml");
    std::vector<int> elements;
    if (const auto number = integer_of(line.text(0))) elements = {*number};
    else if (const auto set = element_sets_.find(upper_case(line.text(0))); set != element_sets_.end()) elements = set->second;
    else line.error(0, fmt::format("there is no set \"{}\" of elements", line.text(0)), "define it with *ELSET, or give a number");
    for (const int element : elements) model_.pressures.push_back({element, face, line.number_at(2)});
  }

  Model assemble() {
    model_.node_sets.erase("");
    std::map<int, std::size_t> place;
    for (std::size_t e = 0; e < model_.elements.size(); ++e) place[model_.elements[e].number] = e;
    for (const Section& section : sections_) apply(section, place);
    for (const ModelElement& element : model_.elements)
      if ((element.material < 0 || (is_shell(element.kind) && element.section < 0)) && diagnostics_.errors().size() < most_errors)
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
    for (const int e : element_sets_[section.elements])
      if (const auto it = place.find(e); it != place.end()) {
        model_.elements[it->second].material = material;
        if (is_shell(model_.elements[it->second].kind)) model_.elements[it->second].section = number;
      }
  }

  LineSource source_;
  const std::string& file_;
  input::Diagnostics& diagnostics_;
  Model model_;
  std::map<std::string, std::string> parameters_;
  std::map<std::string, std::vector<int>> element_sets_;
  std::vector<Section> sections_;
  std::optional<ModelElement> pending_;
  Data data_;
  int steps_ = 0;
};

}  // namespace

Model parse_calculix(const std::string& text, const std::string& shown_as, input::Diagnostics& diagnostics) {
  return InpReader(text, shown_as, diagnostics).read();
}

}  // namespace snug::mesh
