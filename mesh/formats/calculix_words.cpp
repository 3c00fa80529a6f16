#include "mesh/formats/calculix_words.hpp"

#include <set>
#include <string_view>

namespace snug::mesh {

std::string value_of(const InpParameters& parameters, const std::string& key) {
  const auto it = parameters.find(key);
  return it == parameters.end() ? "" : it->second;
}

bool is_card_without_meaning(const std::string& card) {
  static const std::set<std::string> names = {
      "HEADING", "ENDSTEP", "NODEPRINT", "NODEFILE", "NODEOUTPUT", "ELPRINT", "ELFILE", "ELEMENTOUTPUT", "CONTROLS", "OUTPUT", "RESTART",
      "PREPRINT", "PREPARSE", "SOLIDSECTIONCONTROLS", "CONTACTFILE", "CONTACTPRINT", "CONTACTOUTPUT", "ASSEMBLY", "ENDASSEMBLY", "ENDPART",
      "ENDINSTANCE", "EXPANSION", "CONDUCTIVITY", "SPECIFICHEAT", "HISTORYOUTPUT", "FIELDOUTPUT", "MONITOR", "FILEFORMAT", "SECTIONCONTROLS",
      "ENERGYOUTPUT", "ENERGYPRINT", "ENERGYFILE", "TIMEPOINTS", "SURFACESECTION", "ORIENTATION", "TRANSVERSESHEARSTIFFNESS", "SECTIONPRINT",
      "DAMPING", "SECTIONFILE", "PRINT", "SOLUTIONTECHNIQUE", "DEPVAR", "FILTER", "INTEGRATEDOUTPUT", "PHYSICALCONSTANTS", "USERNODE", "NOANALYSIS"};
  return names.contains(card);
}

const char* const supported_inp_elements =
    "snug reads the solids C3D4 C3D10 C3D8 C3D20 C3D6 C3D15 C3D5 C3D13 and the shells S3 S4 S6 S8 STRI65, also with letters such as R, I, H, RH, IH, M, T behind";

namespace {

/// The type without what stands behind its last digit, where that is one of `letters`.
std::string without_letters(const std::string& type, const std::set<std::string>& letters) {
  const auto digit = type.find_last_of("0123456789");
  return digit != type.npos && letters.contains(type.substr(digit + 1)) ? type.substr(0, digit + 1) : type;
}

}  // namespace

std::optional<ElementKind> element_kind_of(const std::string& type) {
  static const std::set<std::string> letters = {"R", "I", "H", "RH", "IH", "M", "MH", "T", "RT", "HT", "RHT", "E", "S", "HS", "RS"};
  static const std::map<std::string, ElementKind> kinds = {
      {"C3D4", ElementKind::tet4},   {"C3D10", ElementKind::tet10}, {"C3D8", ElementKind::hex8},     {"C3D20", ElementKind::hex20},
      {"C3D6", ElementKind::wedge6}, {"C3D15", ElementKind::wedge15}, {"C3D5", ElementKind::pyramid5}, {"C3D13", ElementKind::pyramid13},
      {"S3", ElementKind::tri3},     {"S6", ElementKind::tri6},     {"STRI65", ElementKind::tri6},   {"S4", ElementKind::quad4},
      {"S8", ElementKind::quad8}};
  const auto kind = kinds.find(without_letters(type, letters));
  return kind == kinds.end() ? std::nullopt : std::optional(kind->second);
}

int marking_nodes_of(const std::string& type) {
  static const std::map<std::string, int> types = {
      {"T3D2", 2},  {"T3D3", 3},  {"B31", 2},   {"B32", 3},   {"CPS3", 3},  {"CPS4", 4},  {"CPS6", 6},   {"CPS8", 8},   {"CPE3", 3},   {"CPE4", 4},
      {"CPE6", 6},  {"CPE8", 8},  {"CAX3", 3},  {"CAX4", 4},  {"CAX6", 6},  {"CAX8", 8},  {"SFM3D3", 3}, {"SFM3D4", 4}, {"SFM3D6", 6}, {"SFM3D8", 8},
      {"M3D3", 3},  {"M3D4", 4},  {"M3D6", 6},  {"M3D8", 8},  {"R3D3", 3},  {"R3D4", 4},  {"STRI3", 3},  {"DS3", 3},    {"DS4", 4},    {"T2D2", 2}};
  const auto found = types.find(without_letters(type, {"R", "H", "I", "RH"}));
  return found == types.end() ? 0 : found->second;
}

double interpolated(const std::vector<std::pair<double, double>>& pairs, double time) {
  if (time <= pairs.front().first) return pairs.front().second;
  for (std::size_t i = 1; i < pairs.size(); ++i)
    if (time <= pairs[i].first) {
      const auto [t0, v0] = pairs[i - 1];
      const auto [t1, v1] = pairs[i];
      return t1 > t0 ? v0 + (v1 - v0) * (time - t0) / (t1 - t0) : v1;
    }
  return pairs.back().second;
}

std::vector<int> held_by_name(const std::string& name) {
  static const std::map<std::string, std::vector<int>> names = {
      {"ENCASTRE", {0, 1, 2, 3, 4, 5}}, {"PINNED", {0, 1, 2}}, {"XSYMM", {0, 4, 5}},  {"YSYMM", {1, 3, 5}},
      {"ZSYMM", {2, 3, 4}},             {"XASYMM", {1, 2, 3}}, {"YASYMM", {0, 2, 4}}, {"ZASYMM", {0, 1, 5}}};
  const auto found = names.find(name);
  return found == names.end() ? std::vector<int>{} : found->second;
}

}  // namespace snug::mesh
