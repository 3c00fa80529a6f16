#include "mesh/formats/apdl_commands.hpp"

#include <map>
#include <set>

#include "mesh/formats/fields.hpp"

namespace snug::mesh {

std::string short_name(std::string_view name) {
  const std::string upper = upper_case(name);
  return upper.starts_with("/") || upper.starts_with("*") ? upper : upper.substr(0, 4);
}

bool says_nothing(const std::string& name) {
  static const std::set<std::string> names = {
      "FINI", "SAVE", "ANTY", "OUTR", "OUTP", "NSUB", "DELT", "TIME", "KBC", "AUTO", "EQSL", "NUMO", "EXTO", "SHPP", "PRNS", "PRES",
      "PLNS", "PLDI", "SET", "EPLO", "NPLO", "KPLO", "APLO", "NLIS", "ELIS", "DSYS", "RSYS", "WPCS", "NROP", "CNVT", "ERES",
      "MPTE", "MPTG", "TBTE", "LSTR", "LSSO", "L", "DOF", "PSTR", "LUMP", "BCSO", "MSHC", "MSHK", "PRRS", "RATE", "NCNV", "LNSR", "PRED",
      "EALI", "DMPR", "ALPH", "BETA", "EXIT", "NERR", "EOF", "CRPL", "NEQI", "KUSE", "TOFF", "TRNO", "STEF", "THOP", "DMPO", "EMUN", "SOLC",
      "STAB", "RESC", "MONI", "OPNC", "PIVC", "TIMI", "SSTI", "OUTG", "GST", "CNTR", "PCGO", "LOCA", "CLOC", "CS", "WPOF", "WPRO", "WPAV", "WPLA",
      "NUMS", "CMGR", "CMPL", "NLDI", "MXPA", "ETCO", "REST", "RIGI", "TINT", "CECM", "NLHI", "CMDI", "ESYS", "LOCL", "CSCI",
      // how modes, harmonics and buckling are computed, and how a solver goes its way: the equilibrium is the same
      "MODO", "MODC", "HROP", "HARF", "BUCO", "MDAM", "DMPS", "EXPA", "ARCL", "CUTC", "QRDO", "SOLO", "MSAV", "DDOP", "MIDT", "SUBO", "SPOP"};
  return names.contains(name);
}

std::optional<std::string> load_of_command(const std::string& name) {
  static const std::map<std::string, const char*> names = {{"ACEL", "an acceleration acts"},  {"OMEG", "the model rotates"},       {"DOME", "the model rotates faster and faster"},
                                                           {"CGLO", "the frame is accelerated"}, {"CGOM", "the frame rotates"},    {"DCGO", "the frame rotates"},
                                                           {"CMAC", "an acceleration acts"},  {"CMOM", "a component rotates"},     {"CMDO", "a component rotates"},
                                                           {"IRLF", "its inertia balances the loads"}};
  const auto known = names.find(name);
  return known == names.end() ? std::nullopt : std::optional<std::string>(known->second);
}

}  // namespace snug::mesh
