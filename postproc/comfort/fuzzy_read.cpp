// Reading: fuzzylite parses, this turns its engine into plain data and its complaints into located errors.
#include <fl/Headers.h>
#include <fmt/format.h>

#include <memory>
#include <sstream>

#include "cases/input/files.hpp"
#include "postproc/comfort/fuzzy_file.hpp"
#include "postproc/comfort/fuzzy_rule.hpp"

namespace snug::postproc {
namespace {

/// fuzzylite writes numbers, also between its own parts, with three decimals and complains to standard error unless it
/// is told otherwise. Both settings belong to the whole library; they are put back.
class ExactAndQuiet {
 public:
  ExactAndQuiet()
      : decimals_(fl::fuzzylite::decimals()),
        format_(fl::fuzzylite::scalarFormat()),
        logging_(fl::fuzzylite::isLogging()) {
    fl::fuzzylite::setDecimals(17);
    fl::fuzzylite::setScalarFormat(std::ios_base::scientific);
    fl::fuzzylite::setLogging(false);
  }
  ~ExactAndQuiet() {
    fl::fuzzylite::setDecimals(decimals_);
    fl::fuzzylite::setScalarFormat(format_);
    fl::fuzzylite::setLogging(logging_);
  }
  ExactAndQuiet(const ExactAndQuiet&) = delete;
  ExactAndQuiet& operator=(const ExactAndQuiet&) = delete;

 private:
  int decimals_;
  std::ios_base::fmtflags format_;
  bool logging_;
};

/// Line of the first occurrence of `part`, from 1; 0 when it is nowhere.
int line_of(const std::string& text, const std::string& part) {
  if (part.empty()) return 0;
  const std::size_t at = text.find(part);
  if (at == std::string::npos) return 0;
  return 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
}

/// fuzzylite quotes what it found between < and >; the last quotation is the text of the file.
int line_of_complaint(const std::string& text, const std::string& complaint) {
  const std::size_t close = complaint.rfind('>'), open = complaint.rfind('<', close);
  if (open == std::string::npos || close == std::string::npos) return 0;
  return line_of(text, complaint.substr(open + 1, close - open - 1));
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::vector<double> numbers_of(const fl::Term& term) {
  std::istringstream stream(term.parameters());
  std::vector<double> numbers;
  for (std::string word; stream >> word;) numbers.push_back(fl::Op::toScalar(word));
  return numbers;
}

FuzzyVariable plain(const fl::Variable& from) {
  FuzzyVariable variable{from.getName(), from.getMinimum(), from.getMaximum(), {}};
  for (const fl::Term* term : from.terms())
    variable.terms.push_back({term->getName(), term->className(), numbers_of(*term)});
  return variable;
}

template <class Norm>
std::string name_of(const Norm* norm, const std::string& otherwise) {
  return norm ? norm->className() : otherwise;
}

/// Why the engine is none that we can use; empty when it is.
std::string fault_of(const fl::Engine& engine) {
  if (engine.numberOfInputVariables() == 0) return "it has no input";
  if (engine.numberOfOutputVariables() != 1) return fmt::format("it has {} outputs", engine.numberOfOutputVariables());
  if (engine.numberOfRuleBlocks() != 1 || engine.getRuleBlock(0)->numberOfRules() == 0)
    return "it has not one block of rules";
  if (engine.getOutputVariable(0)->terms().empty()) return "its output has no terms";
  if (!dynamic_cast<const fl::Centroid*>(engine.getOutputVariable(0)->getDefuzzifier()))
    return "its defuzzifier is not the centroid";
  return {};
}

FuzzySystem plain(const fl::Engine& engine, FuzzyFormat format) {
  const fl::OutputVariable& output = *engine.getOutputVariable(0);
  const fl::RuleBlock& block = *engine.getRuleBlock(0);
  FuzzySystem system;
  system.name = engine.getName();
  for (const fl::InputVariable* input : engine.inputVariables()) system.inputs.push_back(plain(*input));
  system.output = plain(output);
  for (const fl::Rule* rule : block.rules()) system.rules.push_back(text_of(parse_rule(rule->getText())));
  system.conjunction = name_of(block.getConjunction(), system.conjunction);
  system.disjunction = name_of(block.getDisjunction(), system.disjunction);
  system.implication = name_of(block.getImplication(), system.implication);
  system.aggregation = name_of(output.getAggregation(), system.aggregation);
  if (format == FuzzyFormat::fll)
    system.resolution = dynamic_cast<const fl::Centroid&>(*output.getDefuzzifier()).getResolution();
  return system;
}

std::unique_ptr<fl::Engine> import(const std::string& text, FuzzyFormat format) {
  return std::unique_ptr<fl::Engine>(format == FuzzyFormat::fis ? fl::FisImporter().fromString(text)
                                                                : fl::FllImporter().fromString(text));
}

}  // namespace

FuzzyFormat fuzzy_format(const std::filesystem::path& file, const input::Location& where) {
  if (file.extension() == ".fll") return FuzzyFormat::fll;
  if (file.extension() == ".fis") return FuzzyFormat::fis;
  throw input::InputError(where, fmt::format("the fuzzy file {} ends in neither .fll nor .fis", file.string()),
                          "write one of these formats");
}

FuzzySystem read_fuzzy_text(const std::string& text, FuzzyFormat format, const std::string& shown_as) {
  const ExactAndQuiet guard;
  const char* const remedy = "correct the file; snug explain comfort.fuzzy tells what it may hold";
  try {
    const auto engine = import(text, format);
    for (const fl::RuleBlock* block : engine->ruleBlocks())
      for (const fl::Rule* rule : block->rules())
        if (!rule->isLoaded())
          throw input::InputError({shown_as, line_of(text, rule->getText()), 1},
                                  fmt::format("the rule \"{}\" cannot be read", rule->getText()),
                                  "use the names of the variables and terms of this file");
    if (const std::string fault = fault_of(*engine); !fault.empty())
      throw input::InputError({shown_as, 0, 0}, "this fuzzy system cannot be used: " + fault,
                              "give inputs, one output with terms, one block of rules and the centroid");
    FuzzySystem system = plain(*engine, format);
    FuzzyEngine check(system);  // its own rules and norms must build again
    return system;
  } catch (const input::InputError&) {
    throw;
  } catch (const fl::Exception& fault) {
    throw input::InputError({shown_as, line_of_complaint(text, fault.getWhat()), 1}, first_line(fault.getWhat()),
                            remedy);
  } catch (const std::exception& fault) {  // what parsers of others throw at malformed text
    throw input::InputError({shown_as, 0, 0}, first_line(fault.what()), remedy);
  }
}

FuzzySystem read_fuzzy(const std::filesystem::path& file, const input::Location& where) {
  const FuzzyFormat format = fuzzy_format(file, where);
  return read_fuzzy_text(input::read_file(file, {.most = std::uintmax_t{1} << 20}), format, file.string());
}

}  // namespace snug::postproc
