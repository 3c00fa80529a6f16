// A Mamdani fuzzy system as plain data, and the engine (fuzzylite) that answers for it.
#pragma once

#include <memory>
#include <string>
#include <vector>

namespace snug::postproc {

/// A membership function. `shape` and the order of `parameters` are fuzzylite's; the ones of FIS files:
/// Bell (center width slope), Gaussian (mean deviation), Triangle (a b c), Trapezoid (a b c d) and others.
struct FuzzyTerm {
  std::string name;  ///< one word
  std::string shape = "Bell";
  std::vector<double> parameters;

  bool operator==(const FuzzyTerm&) const = default;
};

/// Generalised bell 1 / (1 + |(x - center) / width|^(2 slope)): 1/2 at center +- width, slope there -+ slope/(2 width).
FuzzyTerm bell(const std::string& name, double center, double width, double slope);

struct FuzzyVariable {
  std::string name;  ///< one word
  double low = 0.0, high = 1.0;
  std::vector<FuzzyTerm> terms;

  bool operator==(const FuzzyVariable&) const = default;
};

/// How the centroid of the aggregate is integrated over the output's range with `resolution` = n:
/// n intervals with their midpoints (fuzzylite's way), or n equally spaced points, ends included, with plain sums (the
/// way of the toolbox that the source used, n = 101 there) or the trapezoidal rule.
enum class Integration { midpoints, point_sums, trapezoids };

/// The result is the centroid of the aggregate. Norms have fuzzylite's names: Minimum, AlgebraicProduct; Maximum,
/// BoundedSum, AlgebraicSum, ...
struct FuzzySystem {
  std::string name;
  std::vector<FuzzyVariable> inputs;
  FuzzyVariable output;
  std::vector<std::string> rules;  ///< "if p is low and s is soft then y is good"; "or", "not" and parentheses as well
  std::string conjunction = "Minimum", disjunction = "Maximum", implication = "Minimum", aggregation = "Maximum";
  int resolution = 1001;
  Integration integration = Integration::midpoints;

  bool operator==(const FuzzySystem&) const = default;
};

struct FuzzyAnswer {
  double score = 0.0;                            ///< NaN when no rule fires
  std::vector<std::vector<double>> memberships;  ///< per input, per term
  std::vector<double> strengths;                 ///< per rule, degree of truth of its condition
  std::vector<double> output_memberships;        ///< of the score in the output's terms
};

/// A system ready to answer many times.
class FuzzyEngine {
 public:
  /// Throws std::invalid_argument when a rule cannot be read or a name is none of fuzzylite's.
  explicit FuzzyEngine(const FuzzySystem& system);
  ~FuzzyEngine();
  FuzzyEngine(FuzzyEngine&&) noexcept;

  /// Input values are clamped to their variable's range. Throws std::invalid_argument when their number is wrong.
  FuzzyAnswer answer(const std::vector<double>& values);
  double score(const std::vector<double>& values);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// One answer of one system.
FuzzyAnswer infer(const FuzzySystem& system, const std::vector<double>& values);

}  // namespace snug::postproc
