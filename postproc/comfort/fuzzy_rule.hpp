// The rules of a fuzzy system as trees: what has to be known to leave an input out, to write a FIS table, or to say a
// rule in words.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/comfort/fuzzy.hpp"

namespace snug::postproc {

/// "p is not low", or parts joined by "and" or by "or".
struct Condition {
  enum class Kind { proposition, conjunction, disjunction };
  Kind kind = Kind::proposition;
  std::string variable = {};
  std::vector<std::string> hedges = {};  ///< not, very, ...
  std::string term = {};
  std::vector<Condition> parts = {};

  bool operator==(const Condition&) const = default;
};

struct FuzzyRule {
  Condition condition;
  std::string output, term;
  double weight = 1.0;
};

/// Reads "if CONDITION then OUTPUT is TERM", optionally "with WEIGHT"; "and" binds tighter than "or".
/// Throws std::invalid_argument.
FuzzyRule parse_rule(const std::string& text);
std::string text_of(const FuzzyRule& rule);

/// The system for the inputs `present` (by index) only: propositions on the others drop out of their "and" or "or", and
/// a rule of which nothing is left drops out as well. "Every location is comfortable" so becomes "every location
/// present is comfortable".
FuzzySystem restricted(const FuzzySystem& system, const std::vector<std::size_t>& present);

/// Disjunctive normal form: the condition holds when all propositions of one alternative hold. Throws
/// std::invalid_argument when there were more than `most`.
std::vector<std::vector<Condition>> alternatives(const Condition& condition, std::size_t most);

/// The rule in words: "if Chest is uncomfortable, very uncomfortable or extremely uncomfortable then the garment is
/// uncomfortable", "if every location is neutral or comfortable then ...".
std::string in_words(const FuzzyRule& rule, const FuzzySystem& system);

}  // namespace snug::postproc
