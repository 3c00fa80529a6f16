#include "postproc/comfort/fuzzy.hpp"

#include <fl/Headers.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>
#include <stdexcept>

namespace snug::postproc {
namespace {

// fuzzylite's containers own the raw pointers that they are given.

fl::Term* make_term(const FuzzyTerm& from) {
  std::unique_ptr<fl::Term> term(fl::FactoryManager::instance()->term()->constructObject(from.shape));
  term->setName(from.name);
  term->configure(fmt::format("{}", fmt::join(from.parameters, " ")));
  return term.release();
}

fl::TNorm* t_norm(const std::string& name) { return fl::FactoryManager::instance()->tnorm()->constructObject(name); }
fl::SNorm* s_norm(const std::string& name) { return fl::FactoryManager::instance()->snorm()->constructObject(name); }

void add_input(fl::Engine& engine, const FuzzyVariable& from) {
  auto variable = std::make_unique<fl::InputVariable>(from.name, from.low, from.high);
  variable->setLockValueInRange(true);
  for (const FuzzyTerm& term : from.terms) variable->addTerm(make_term(term));
  engine.addInputVariable(variable.release());
}

void add_output(fl::Engine& engine, const FuzzySystem& system) {
  const FuzzyVariable& from = system.output;
  auto variable = std::make_unique<fl::OutputVariable>(from.name, from.low, from.high);
  for (const FuzzyTerm& term : from.terms) variable->addTerm(make_term(term));
  variable->setAggregation(s_norm(system.aggregation));
  engine.addOutputVariable(variable.release());
}

void add_rules(fl::Engine& engine, const FuzzySystem& system) {
  auto block = std::make_unique<fl::RuleBlock>();
  block->setConjunction(t_norm(system.conjunction));
  block->setDisjunction(s_norm(system.disjunction));
  block->setImplication(t_norm(system.implication));
  block->setActivation(new fl::General);
  for (const std::string& rule : system.rules) block->addRule(fl::Rule::parse(rule, &engine));
  engine.addRuleBlock(block.release());
}

std::vector<double> degrees(const fl::Variable& variable, double value) {
  std::vector<double> result;
  for (const fl::Term* term : variable.terms()) result.push_back(term->membership(value));
  return result;
}

/// Under the maximum, rules with one conclusion count as the strongest of them: max_k T(w_k, m) = T(max_k w_k, m) for
/// every implication T, because it is monotone. Keeps hundreds of rules as cheap as the terms of the output.
void keep_the_strongest(fl::Aggregated& aggregate) {
  std::vector<fl::Activated> strongest;
  for (const fl::Activated& one : aggregate.terms()) {
    const auto same = [&](const fl::Activated& other) { return other.getTerm() == one.getTerm(); };
    const auto found = std::find_if(strongest.begin(), strongest.end(), same);
    if (found == strongest.end()) {
      strongest.push_back(one);
    } else if (found->getDegree() < one.getDegree()) {
      found->setDegree(one.getDegree());
    }
  }
  aggregate.setTerms(strongest);
}

/// Sum of x m(x) over sum of m(x); the trapezoidal rule halves the ends.
double centroid(const fl::Aggregated& aggregate, const FuzzySystem& system) {
  const double low = system.output.low, range = system.output.high - low;
  const int n = system.resolution;
  const bool midpoints = system.integration == Integration::midpoints;
  double moment = 0.0, area = 0.0;
  for (int i = 0; i < n; ++i) {
    const double x = low + range * (midpoints ? (i + 0.5) / n : static_cast<double>(i) / (n - 1));
    const bool end = i == 0 || i == n - 1;
    const double weight = system.integration == Integration::trapezoids && end ? 0.5 : 1.0;
    const double m = weight * aggregate.membership(x);
    moment += m * x;
    area += m;
  }
  return area > 0.0 ? moment / area : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

FuzzyTerm bell(const std::string& name, double center, double width, double slope) {
  return {name, "Bell", {center, width, slope}};
}

struct FuzzyEngine::Parts {
  FuzzySystem system;
  fl::Engine engine;

  double process(const std::vector<double>& values) {
    if (values.size() != system.inputs.size())
      throw std::invalid_argument("fuzzy system: one value an input is needed");
    for (std::size_t i = 0; i < values.size(); ++i) engine.getInputVariable(i)->setValue(values[i]);
    fl::OutputVariable& output = *engine.getOutputVariable(0);
    output.fuzzyOutput()->clear();
    engine.getRuleBlock(0)->activate();
    if (system.aggregation == "Maximum") keep_the_strongest(*output.fuzzyOutput());
    return centroid(*output.fuzzyOutput(), system);
  }
};

FuzzyEngine::FuzzyEngine(const FuzzySystem& system) : parts_(std::make_unique<Parts>()) {
  parts_->system = system;
  if (system.resolution < 2) throw std::invalid_argument("fuzzy system: a resolution of two or more is needed");
  try {
    for (const FuzzyVariable& variable : system.inputs) add_input(parts_->engine, variable);
    add_output(parts_->engine, system);
    add_rules(parts_->engine, system);
  } catch (const fl::Exception& fault) {
    throw std::invalid_argument("fuzzy system: " + fault.getWhat());
  }
}

FuzzyEngine::~FuzzyEngine() = default;
FuzzyEngine::FuzzyEngine(FuzzyEngine&&) noexcept = default;

double FuzzyEngine::score(const std::vector<double>& values) { return parts_->process(values); }

FuzzyAnswer FuzzyEngine::answer(const std::vector<double>& values) {
  FuzzyAnswer answer;
  answer.score = parts_->process(values);
  fl::Engine& engine = parts_->engine;
  for (const fl::InputVariable* input : engine.inputVariables())
    answer.memberships.push_back(degrees(*input, input->getValue()));
  for (const fl::Rule* rule : engine.getRuleBlock(0)->rules()) answer.strengths.push_back(rule->getActivationDegree());
  answer.output_memberships = degrees(*engine.getOutputVariable(0), answer.score);
  return answer;
}

FuzzyAnswer infer(const FuzzySystem& system, const std::vector<double>& values) {
  return FuzzyEngine(system).answer(values);
}

}  // namespace snug::postproc
