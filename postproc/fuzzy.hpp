// A Mamdani fuzzy system with generalised bell memberships: the part of fuzzylite that snug uses, as plain data.
#pragma once

#include <string>
#include <vector>

namespace snug::postproc {

/// Generalised bell 1 / (1 + |(x - center) / width|^(2 slope)): 1/2 at center +- width, slope there -+ slope/(2 width).
struct FuzzyTerm {
  std::string name;  ///< one word
  double center = 0.0, width = 1.0, slope = 1.0;
};

struct FuzzyVariable {
  std::string name;  ///< one word
  double low = 0.0, high = 1.0;
  std::vector<FuzzyTerm> terms;
};

/// How "or" inside a rule joins degrees of truth.
enum class Disjunction { maximum, bounded_sum };

/// and: minimum, implication: minimum, aggregation: maximum, result: centroid of the aggregate.
struct FuzzySystem {
  std::vector<FuzzyVariable> inputs;
  FuzzyVariable output;
  std::vector<std::string> rules;  ///< "if p is low and s is soft then y is good"; "or" and parentheses are allowed
  Disjunction disjunction = Disjunction::maximum;
  int resolution = 1001;  ///< sub-intervals of the output's range; the midpoint rule integrates over them
};

struct FuzzyAnswer {
  double score = 0.0;                            ///< NaN when no rule fires
  std::vector<std::vector<double>> memberships;  ///< per input, per term
  std::vector<double> strengths;                 ///< per rule, degree of truth of its condition
  std::vector<double> output_memberships;        ///< of the score in the output's terms
};

/// Answers for the input values, which are clamped to their variable's range.
/// Throws std::invalid_argument when their number is wrong or a rule cannot be read.
FuzzyAnswer infer(const FuzzySystem& system, const std::vector<double>& values);

}  // namespace snug::postproc
