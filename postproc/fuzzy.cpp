#include "postproc/fuzzy.hpp"

#include <fl/Headers.h>

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace snug::postproc {
namespace {

// fuzzylite's containers own the raw pointers that they are given.

fl::Term* bell(const FuzzyTerm& term) { return new fl::Bell(term.name, term.center, term.width, term.slope); }

void add_input(fl::Engine& engine, const FuzzyVariable& from) {
  auto variable = std::make_unique<fl::InputVariable>(from.name, from.low, from.high);
  variable->setLockValueInRange(true);
  for (const FuzzyTerm& term : from.terms) variable->addTerm(bell(term));
  engine.addInputVariable(variable.release());
}

void add_output(fl::Engine& engine, const FuzzyVariable& from, int resolution) {
  auto variable = std::make_unique<fl::OutputVariable>(from.name, from.low, from.high);
  for (const FuzzyTerm& term : from.terms) variable->addTerm(bell(term));
  variable->setAggregation(new fl::Maximum);
  variable->setDefuzzifier(new fl::Centroid(resolution));
  engine.addOutputVariable(variable.release());
}

fl::SNorm* make(Disjunction disjunction) {
  if (disjunction == Disjunction::bounded_sum) return new fl::BoundedSum;
  return new fl::Maximum;
}

void add_rules(fl::Engine& engine, const FuzzySystem& system) {
  auto block = std::make_unique<fl::RuleBlock>();
  block->setConjunction(new fl::Minimum);
  block->setDisjunction(make(system.disjunction));
  block->setImplication(new fl::Minimum);
  block->setActivation(new fl::General);
  for (const std::string& rule : system.rules) block->addRule(fl::Rule::parse(rule, &engine));
  engine.addRuleBlock(block.release());
}

std::unique_ptr<fl::Engine> build(const FuzzySystem& system) {
  auto engine = std::make_unique<fl::Engine>();
  for (const FuzzyVariable& variable : system.inputs) add_input(*engine, variable);
  add_output(*engine, system.output, system.resolution);
  add_rules(*engine, system);
  return engine;
}

std::vector<double> degrees(const fl::Variable& variable, double value) {
  std::vector<double> result;
  for (const fl::Term* term : variable.terms()) result.push_back(term->membership(value));
  return result;
}

FuzzyAnswer ask(fl::Engine& engine, const std::vector<double>& values) {
  FuzzyAnswer answer;
  for (std::size_t i = 0; i < values.size(); ++i) {
    fl::InputVariable& input = *engine.getInputVariable(i);
    input.setValue(values[i]);
    answer.memberships.push_back(degrees(input, input.getValue()));
  }
  engine.process();
  fl::RuleBlock& block = *engine.getRuleBlock(0);
  for (const fl::Rule* rule : block.rules()) answer.strengths.push_back(rule->getActivationDegree());
  const fl::OutputVariable& output = *engine.getOutputVariable(0);
  answer.score = output.getValue();
  answer.output_memberships = degrees(output, answer.score);
  return answer;
}

}  // namespace

FuzzyAnswer infer(const FuzzySystem& system, const std::vector<double>& values) {
  if (values.size() != system.inputs.size()) throw std::invalid_argument("fuzzy system: one value an input is needed");
  try {
    return ask(*build(system), values);
  } catch (const fl::Exception& fault) {
    throw std::invalid_argument("fuzzy system: " + fault.getWhat());
  }
}

}  // namespace snug::postproc
