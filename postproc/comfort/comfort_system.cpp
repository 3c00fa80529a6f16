#include "postproc/comfort/comfort_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <stdexcept>

#include "cases/input/suggestion.hpp"
#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/fuzzy_file.hpp"
#include "postproc/comfort/pressure_table.hpp"
#include "postproc/comfort/shipped_data.hpp"

// What the source lost with its figures and what was chosen for it stands in postproc/data/wear_trial_2002.fll:
//  - bells of the sensations: centres at the marks 0 ... 4 of the scale, half width 0.5, so that neighbours cross at
//    1/2 midway between their marks; exponent 2b = 5;
//  - bells of the comfort: three terms at 0, 2 and 4 of [0, 4] in the order of growing discomfort (table 5.3 lists them
//    in another order and gives no places). Half widths 1.5, 0.5, 1.5 make neighbours cross at 1/2 (at 1.5 and 2.5).
//    They also make "comfortable" outweigh "acceptable" where both rules hold fully, so that a garment whose every
//    location is comfortable is called comfortable; with equal widths the half bell at the edge would lose;
//  - "or" between terms of one location is the bounded sum. With the maximum, "uncomfortable or worse" would hold only
//    by half between two marks, and a rating of 2.5 would score better than 2; with the bounded sum it holds fully from
//    2 on. wear_trial_2002.fis has the maximum and one term of a location a rule, as the source's toolbox holds rules.
// The rules of table 5.4 are kept as they are. They prefer "all comfortable" (rating 1) to "all neutral" (rating 0), so
// the score grows with the ratings from 1 upwards only.

namespace snug::postproc {
namespace {

struct ShippedSystem {
  const char *name, *file;
  FuzzyFormat format;
};
constexpr std::array<ShippedSystem, 2> shipped = {
    {{"wear trial 2002", "wear_trial_2002.fll", FuzzyFormat::fll},
     {"wear trial 2002, single terms", "wear_trial_2002.fis", FuzzyFormat::fis}}};

FuzzySystem read_shipped(const ShippedSystem& system) {
  return read_fuzzy_text(std::string(shipped_text(system.file)), system.format,
                         std::string("postproc/data/") + system.file);
}

/// The condition of every location, joined by "and".
template <class Condition>
std::string every(const std::vector<FuzzyVariable>& inputs, Condition condition) {
  std::string text;
  for (const FuzzyVariable& input : inputs) text += (text.empty() ? "" : " and ") + condition(input.name);
  return text;
}

std::string is_bad(const std::string& p) {
  return fmt::format("{0} is uncomfortable or {0} is very_uncomfortable or {0} is extremely_uncomfortable", p);
}
std::string is_comfortable(const std::string& p) { return p + " is comfortable"; }

/// Table 5.4: one "uncomfortable or worse" rule a location, then the two rules over all.
std::vector<std::string> rules_of_table_5_4(const std::vector<FuzzyVariable>& inputs, const std::string& output) {
  std::vector<std::string> rules;
  for (const FuzzyVariable& input : inputs)
    rules.push_back(fmt::format("if {} then {} is uncomfortable", is_bad(input.name), output));
  const bool alone = inputs.size() == 1;
  const auto is_good = [&](const std::string& p) {
    const std::string good = fmt::format("{0} is neutral or {0} is comfortable", p);
    return alone ? good : "(" + good + ")";
  };
  rules.push_back(fmt::format("if {} then {} is comfortable", every(inputs, is_comfortable), output));
  rules.push_back(fmt::format("if {} then {} is acceptable", every(inputs, is_good), output));
  return rules;
}

/// `location` as one word of a rule, different from those `taken`; its plain_name stays what it is.
std::string identifier(const std::string& location, const std::vector<FuzzyVariable>& taken) {
  static const std::vector<std::string> words = {"if",  "is",   "and",       "or",     "then",     "with",
                                                 "any", "very", "extremely", "seldom", "somewhat", "not"};
  std::string name;
  for (const unsigned char c : location) name += std::isalnum(c) ? static_cast<char>(c) : '_';
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) ||
      std::find(words.begin(), words.end(), name) != words.end())
    name = "_" + name;
  const auto used = [&](const std::string& text) {
    return std::any_of(taken.begin(), taken.end(), [&](const FuzzyVariable& one) { return one.name == text; });
  };
  while (used(name)) name += '_';
  return name;
}

}  // namespace

std::string plain_name(const std::string& name) {
  std::string plain;
  for (const unsigned char c : name)
    if (std::isalnum(c)) plain += static_cast<char>(std::tolower(c));
  return plain;
}

std::string spoken_name(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::vector<std::string> fuzzy_names() {
  std::vector<std::string> names;
  for (const ShippedSystem& system : shipped) names.emplace_back(system.name);
  return names;
}

FuzzySystem comfort_system(const std::vector<std::string>& locations) {
  static const FuzzySystem base = read_shipped(shipped.front());  // constant text
  FuzzySystem system = base;
  system.inputs.clear();
  for (const std::string& location : locations) {
    const auto known = std::find_if(base.inputs.begin(), base.inputs.end(), [&](const FuzzyVariable& input) {
      return plain_name(input.name) == plain_name(location);
    });
    FuzzyVariable input = known == base.inputs.end() ? base.inputs.front() : *known;
    if (known == base.inputs.end()) input.name = identifier(location, system.inputs);
    system.inputs.push_back(std::move(input));
  }
  system.rules = rules_of_table_5_4(system.inputs, system.output.name);
  return system;
}

FuzzySystem load_fuzzy(const input::MaterialEntry& reference, const std::vector<std::string>& locations,
                       const std::filesystem::path& directory) {
  const std::string& name = reference.name;
  if (name.empty() && !reference.is_inline()) return comfort_system(locations);
  for (const ShippedSystem& system : shipped)
    if (same_name(name, system.name)) return read_shipped(system);
  const std::filesystem::path file = directory / name;
  if (name.empty() || !std::filesystem::is_regular_file(file))
    throw input::InputError(
        reference.where, fmt::format("there is no fuzzy system \"{}\"", name),
        fmt::format("write \"{}\", \"{}\", or the path of a .fll or .fis file", shipped[0].name, shipped[1].name));
  return read_fuzzy(file, reference.where);
}

}  // namespace snug::postproc
