#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "cases/input/files.hpp"
#include "postproc/comfort/fuzzy_file.hpp"
#include "postproc/comfort/fuzzy_rule.hpp"

namespace snug::postproc {
namespace {

// ---- FLL

std::string fll_variable(const std::string& kind, const FuzzyVariable& variable, const std::string& settings) {
  std::string text = fmt::format("{}: {}\n  enabled: true\n  range: {} {}\n{}", kind, variable.name, variable.low,
                                 variable.high, settings);
  for (const FuzzyTerm& term : variable.terms)
    text += fmt::format("  term: {} {} {}\n", term.name, term.shape, fmt::join(term.parameters, " "));
  return text;
}

// ---- FIS

struct FisShape {
  const char *fuzzylite, *fis;
  std::vector<int> order;  ///< of fuzzylite's parameters in a FIS file
};
const std::array<FisShape, 4> fis_shapes = {{{"Bell", "gbellmf", {1, 2, 0}},
                                             {"Gaussian", "gaussmf", {1, 0}},
                                             {"Triangle", "trimf", {0, 1, 2}},
                                             {"Trapezoid", "trapmf", {0, 1, 2, 3}}}};

struct FisNorm {
  const char *fuzzylite, *fis;
};
constexpr std::array<FisNorm, 5> fis_norms = {{{"Minimum", "min"},
                                               {"AlgebraicProduct", "prod"},
                                               {"Maximum", "max"},
                                               {"AlgebraicSum", "probor"},
                                               {"BoundedSum", "bounded_sum"}}};

std::string fis_norm(const std::string& name) {
  for (const FisNorm& norm : fis_norms)
    if (name == norm.fuzzylite) return norm.fis;
  throw std::invalid_argument("FIS has no name for the norm " + name + "; write FLL");
}

std::string fis_term(const FuzzyTerm& term) {
  for (const FisShape& shape : fis_shapes) {
    if (term.shape != shape.fuzzylite || term.parameters.size() != shape.order.size()) continue;
    std::vector<double> parameters;
    for (const int i : shape.order) parameters.push_back(term.parameters[i]);
    return fmt::format("'{}':'{}',[{}]", term.name, shape.fis, fmt::join(parameters, " "));
  }
  throw std::invalid_argument("the term " + term.name + " of shape " + term.shape + " has no form in FIS; write FLL");
}

std::string fis_variable(const std::string& section, const FuzzyVariable& variable) {
  std::string text = fmt::format("\n[{}]\nName='{}'\nRange=[{} {}]\nNumMFs={}\n", section, variable.name, variable.low,
                                 variable.high, variable.terms.size());
  for (std::size_t t = 0; t < variable.terms.size(); ++t)
    text += fmt::format("MF{}={}\n", t + 1, fis_term(variable.terms[t]));
  return text;
}

template <class Named>
int index_of(const std::vector<Named>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Named& one) { return one.name == name; });
  if (found == all.end()) throw std::invalid_argument("a rule names " + name + ", which the system does not have");
  return static_cast<int>(found - all.begin());
}

/// One row of the table: 1-based term of each input (0: none, negative: not), the output's term, weight, connective.
struct FisRow {
  std::vector<int> terms = {};
  int output = 0;
  double weight = 1.0;
  int connective = 1;  ///< 1 and, 2 or
};

/// False when two propositions speak of one input: no row can hold them.
bool fill(FisRow& row, const std::vector<Condition>& propositions, const FuzzySystem& system) {
  row.terms.assign(system.inputs.size(), 0);
  for (const Condition& one : propositions) {
    if (one.kind != Condition::Kind::proposition) return false;
    const bool negated = one.hedges == std::vector<std::string>{"not"};
    if (!one.hedges.empty() && !negated)
      throw std::invalid_argument("FIS as written here knows no hedge but \"not\"; write FLL");
    const int input = index_of(system.inputs, one.variable);
    int& term = row.terms[input];
    if (term != 0) return false;
    term = (index_of(system.inputs[input].terms, one.term) + 1) * (negated ? -1 : 1);
  }
  return true;
}

void require_a_lattice(const FuzzySystem& system, const std::string& rule) {
  if (system.conjunction == "Minimum" && system.disjunction == "Maximum" && system.aggregation == "Maximum") return;
  throw std::invalid_argument("the rule \"" + rule +
                              "\" must be split for FIS, which is exact with minimum, maximum and maximum for \"and\", "
                              "\"or\" and the aggregation only; write FLL");
}

std::vector<FisRow> fis_rows(const FuzzySystem& system, const std::string& text) {
  const FuzzyRule rule = parse_rule(text);
  FisRow row{.output = index_of(system.output.terms, rule.term) + 1, .weight = rule.weight};
  const Condition& condition = rule.condition;
  const bool plain = condition.kind == Condition::Kind::proposition;
  row.connective = condition.kind == Condition::Kind::disjunction ? 2 : 1;
  if (fill(row, plain ? std::vector{condition} : condition.parts, system)) return {row};
  require_a_lattice(system, text);
  row.connective = 1;
  std::vector<FisRow> rows;
  for (const auto& alternative : alternatives(condition, 4096)) {
    if (!fill(row, alternative, system))
      throw std::invalid_argument("the rule \"" + text + "\" joins two terms of one input by \"and\"; write FLL");
    rows.push_back(row);
  }
  return rows;
}

std::string row_text(const FisRow& row) {
  return fmt::format("{}, {} ({}) : {}\n", fmt::join(row.terms, " "), row.output, row.weight, row.connective);
}

}  // namespace

std::string fll_text(const FuzzySystem& system) {
  std::string text = fmt::format("Engine: {}\n", system.name);
  for (const FuzzyVariable& variable : system.inputs)
    text += fll_variable("InputVariable", variable, "  lock-range: true\n");
  text += fll_variable("OutputVariable", system.output,
                       fmt::format("  lock-range: false\n  aggregation: {}\n  defuzzifier: Centroid {}\n"
                                   "  default: nan\n  lock-previous: false\n",
                                   system.aggregation, system.resolution));
  text += fmt::format(
      "RuleBlock: rules\n  enabled: true\n  conjunction: {}\n  disjunction: {}\n  implication: {}\n"
      "  activation: General\n",
      system.conjunction, system.disjunction, system.implication);
  for (const std::string& rule : system.rules) text += "  rule: " + rule + "\n";
  return text;
}

std::string fis_text(const FuzzySystem& system) {
  std::vector<FisRow> rows;
  for (const std::string& rule : system.rules)
    for (FisRow& row : fis_rows(system, rule)) rows.push_back(std::move(row));
  std::string text = fmt::format(
      "[System]\nName='{}'\nType='mamdani'\nVersion=2.0\nNumInputs={}\nNumOutputs=1\nNumRules={}\nAndMethod='{}'\n"
      "OrMethod='{}'\nImpMethod='{}'\nAggMethod='{}'\nDefuzzMethod='centroid'\n",
      system.name, system.inputs.size(), rows.size(), fis_norm(system.conjunction), fis_norm(system.disjunction),
      fis_norm(system.implication), fis_norm(system.aggregation));
  for (std::size_t i = 0; i < system.inputs.size(); ++i)
    text += fis_variable(fmt::format("Input{}", i + 1), system.inputs[i]);
  text += fis_variable("Output1", system.output) + "\n[Rules]\n";
  for (const FisRow& row : rows) text += row_text(row);
  return text;
}

void write_fuzzy(const FuzzySystem& system, const std::filesystem::path& file) {
  const std::string text = fuzzy_format(file) == FuzzyFormat::fll ? fll_text(system) : fis_text(system);
  input::write_file(file, text);
}

}  // namespace snug::postproc
