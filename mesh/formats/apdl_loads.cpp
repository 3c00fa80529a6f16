#include "mesh/formats/apdl_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

namespace snug::mesh {

bool ApdlLoads::take(const std::string& name, const FieldLine& line) {
  using Handler = std::function<void(ApdlLoads&, const FieldLine&)>;
  using R = ApdlLoads;
  using L = const FieldLine&;
  static const std::map<std::string, Handler> commands = {{"D", [](R& r, L l) { r.support(l, r.deck_.supports); }},
                                                          {"DK", [](R& r, L l) { r.support(l, r.deck_.keypoint_supports); }},
                                                          {"F", [](R& r, L l) { r.force(l, r.deck_.forces); }},
                                                          {"FK", [](R& r, L l) { r.force(l, r.deck_.keypoint_forces); }},
                                                          {"SFE", [](R& r, L l) { r.surface_load(l); }},
                                                          {"DDEL", [](R& r, L l) { r.remove_supports(l); }},
                                                          {"FDEL", [](R& r, L l) { r.remove_forces(l); }},
                                                          {"SFED", [](R& r, L l) { r.remove_pressures(l); }},
                                                          {"LSCL", [](R& r, L l) { r.clear(l); }}};
  if (name == "SOLV" || name == "LSWR") return end_step(name, line.number), true;
  const auto command = commands.find(name);
  if (command == commands.end()) return false;
  changed_ = true;
  if (chosen_ == 0 || ended_ < chosen_) command->second(*this, line);
  return true;
}

/// SOLVE behind LSWRITE solves what has been written; it ends no step of its own unless loads have changed since.
void ApdlLoads::end_step(const std::string& name, int line) {
  if (name == "LSWR") written_ = true;
  else if (written_ && !changed_) return;
  ++ended_;
  changed_ = false;
  if (chosen_ == 0 || ended_ <= chosen_) line_ = line;
}

namespace {

const std::vector<std::string>& displacement_labels() {
  static const std::vector<std::string> labels = {"UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ"};
  return labels;
}
const std::vector<std::string>& force_labels() {
  static const std::vector<std::string> labels = {"FX", "FY", "FZ"};
  return labels;
}

/// Place of the label in field 2; as many as there are labels for ALL (or where left out), -1 for none of them.
int label_at(const FieldLine& line, const std::vector<std::string>& labels) {
  const std::string label = upper_case(line.text(2));
  if (label.empty() || label == "ALL") return static_cast<int>(labels.size());
  const auto found = std::find(labels.begin(), labels.end(), label);
  return found == labels.end() ? -1 : static_cast<int>(found - labels.begin());
}

/// Takes out the loads of a component (`all` of them) at nodes that field 1 names.
template <class Load>
void remove(const FieldLine& line, const ApdlSelection& selection, const std::vector<std::string>& labels, std::vector<Load>& loads) {
  const int label = label_at(line, labels), all = static_cast<int>(labels.size());
  if (label < 0) return;  // of what is not read here there is none
  const std::vector<int> named = selection.named(line, 3);
  const std::set<int> nodes(named.begin(), named.end());
  std::erase_if(loads, [&](const Load& load) { return nodes.contains(load.node) && (label == all || label == load.component); });
}

}  // namespace

void ApdlLoads::remove_supports(const FieldLine& line) const { remove(line, selection_, displacement_labels(), deck_.supports); }
void ApdlLoads::remove_forces(const FieldLine& line) const { remove(line, selection_, force_labels(), deck_.forces); }

void ApdlLoads::remove_pressures(const FieldLine& line) const {
  const bool every = upper_case(line.text(1)) == "ALL", each_face = upper_case(line.text(2)) == "ALL" || line.empty(2);
  const int element = every ? 0 : line.integer_at(1), face = each_face ? 0 : line.integer_at(2, 1);
  std::erase_if(deck_.pressures, [&](const ModelPressure& p) { return (every || p.element == element) && (each_face || p.face == face); });
}

void ApdlLoads::clear(const FieldLine& line) const {
  const std::string what = upper_case(line.text(1));
  if (what == "SOLID" || what == "INERT" || what == "LFACT" || what == "LSOPT") return;
  if (what != "ALL" && what != "FE") return line.error(1, fmt::format("\"{}\" says not which loads are cleared", line.text(1)), "write LSCLEAR,ALL or LSCLEAR,FE");
  deck_.supports.clear(), deck_.forces.clear(), deck_.pressures.clear();
  if (what == "ALL") deck_.keypoint_supports.clear(), deck_.keypoint_forces.clear();
}

void ApdlLoads::support(const FieldLine& line, std::vector<ModelSupport>& supports) const {
  const std::vector<std::string>& labels = displacement_labels();
  for (const std::size_t field : {2u, 7u, 8u, 9u, 10u, 11u}) {
    const std::string label = upper_case(line.text(field));
    if (label.empty() && field > 2) continue;
    const auto place = std::find(labels.begin(), labels.end(), label) - labels.begin();
    if (label != "ALL" && place == 6)
      return line.error(field, fmt::format("\"{}\" is no component of displacement", line.text(field)), "write UX UY UZ ROTX ROTY ROTZ or ALL");
    const double value = line.number_at(3);
    for (const int node : selection_.named(line, 5))
      for (int c = 0; c < 6; ++c)
        if (label == "ALL" || c == place) supports.push_back({node, c, value});
  }
}

void ApdlLoads::force(const FieldLine& line, std::vector<ModelForce>& forces) const {
  const std::vector<std::string>& labels = force_labels();
  const auto place = std::find(labels.begin(), labels.end(), upper_case(line.text(2))) - labels.begin();
  if (place == 3) return line.error(2, fmt::format("\"{}\" is no force", line.text(2)), "write FX, FY or FZ; moments are not taken over");
  for (const int node : selection_.named(line, 5)) forces.push_back({node, static_cast<int>(place), line.number_at(3)});
}

void ApdlLoads::surface_load(const FieldLine& line) const {
  if (upper_case(line.text(3)) != "PRES") return line.error(3, "only pressures on elements are read", "write SFE,element,face,PRES,,value");
  if (line.integer_at(4) == 2) return;  // of harmonic loads, the part out of phase
  const double value = line.number_at(5);
  for (std::size_t f = 6; f < line.fields.size() && f < 9; ++f)
    if (!line.empty(f) && line.number_at(f) != value) line.error(f, "the pressure varies over the face", "give one value a face");
  deck_.pressures.push_back({line.integer_at(1), line.integer_at(2, 1), value});
}

}  // namespace snug::mesh
