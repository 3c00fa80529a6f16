#include "postproc/comfort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "postproc/sensation.hpp"

// Choices that the source lost with its figures, all declared here:
//  - bells of the sensations: centres at the marks 0 ... 4 of the scale, half width 0.5, so that neighbours cross at
//  1/2
//    midway between their marks; exponent 2b = 5;
//  - bells of the comfort: three terms at 0, 2 and 4 of [0, 4] in the order of growing discomfort (table 5.3 lists them
//  in
//    another order and gives no places). Half widths 1.5, 0.5, 1.5 make neighbours cross at 1/2 (at 1.5 and 2.5). They
//    also make "comfortable" outweigh "acceptable" where both rules hold fully, so that a garment whose every location
//    is comfortable is called comfortable; with equal widths the half bell at the edge would lose;
//  - "or" between terms of one location is the bounded sum. With the maximum, "uncomfortable or worse" would hold only
//  by
//    half between two marks, and a rating of 2.5 would score better than 2; with the bounded sum it holds fully from 2
//    on.
// The rules of table 5.4 are kept as they are. They prefer "all comfortable" (rating 1) to "all neutral" (rating 0), so
// the score grows with the ratings from 1 upwards only.

namespace snug::postproc {
namespace {

constexpr double exponent = 2.5;  // b of the bell

const std::array<const char*, 5> sensation_ids = {"neutral", "comfortable", "uncomfortable", "very_uncomfortable",
                                                  "extremely_uncomfortable"};
const std::array<const char*, 3> comfort_terms = {"comfortable", "acceptable", "uncomfortable"};

FuzzyVariable sensation(const std::string& name) {
  FuzzyVariable variable{name, lowest_rating, highest_rating, {}};
  for (std::size_t mark = 0; mark < sensation_ids.size(); ++mark)
    variable.terms.push_back({sensation_ids[mark], static_cast<double>(mark), 0.5, exponent});
  return variable;
}

FuzzyVariable overall() {
  const std::array half_widths = {1.5, 0.5, 1.5};
  FuzzyVariable variable{"RP", 0.0, 4.0, {}};
  for (std::size_t t = 0; t < comfort_terms.size(); ++t)
    variable.terms.push_back({comfort_terms[t], 2.0 * t, half_widths[t], exponent});
  return variable;
}

std::string id(std::size_t location) { return fmt::format("P{}", location + 1); }

/// The condition of every location, joined by "and".
template <class Condition>
std::string every(std::size_t locations, Condition condition) {
  std::string text = condition(id(0));
  for (std::size_t i = 1; i < locations; ++i) text += " and " + condition(id(i));
  return text;
}

std::string is_bad(const std::string& p) {
  return fmt::format("{0} is uncomfortable or {0} is very_uncomfortable or {0} is extremely_uncomfortable", p);
}
std::string is_comfortable(const std::string& p) { return p + " is comfortable"; }
std::string is_good(const std::string& p) { return fmt::format("({0} is neutral or {0} is comfortable)", p); }

/// One "uncomfortable or worse" rule a location, then the two rules over all.
std::vector<std::string> readable_rules(const std::vector<std::pair<std::string, double>>& ratings) {
  std::vector<std::string> rules;
  for (const auto& [location, rating] : ratings)
    rules.push_back(fmt::format("if {} is uncomfortable or worse then the garment is uncomfortable", location));
  rules.emplace_back("if every location is comfortable then the garment is comfortable");
  rules.emplace_back("if every location is neutral or comfortable then the garment is acceptable");
  return rules;
}

}  // namespace

FuzzySystem comfort_system(std::size_t locations) {
  FuzzySystem system;
  system.disjunction = Disjunction::bounded_sum;
  system.output = overall();
  for (std::size_t i = 0; i < locations; ++i) {
    system.inputs.push_back(sensation(id(i)));
    system.rules.push_back("if " + is_bad(id(i)) + " then RP is uncomfortable");
  }
  system.rules.push_back("if " + every(locations, is_comfortable) + " then RP is comfortable");
  system.rules.push_back("if " + every(locations, is_good) + " then RP is acceptable");
  return system;
}

Comfort judge(const std::vector<std::pair<std::string, double>>& ratings) {
  if (ratings.empty()) throw std::invalid_argument("comfort: no location has a rating");
  std::vector<double> values;
  for (const auto& [location, rating] : ratings) values.push_back(rating);
  const FuzzyAnswer answer = infer(comfort_system(ratings.size()), values);

  Comfort comfort;
  comfort.score = answer.score;
  const auto& degrees = answer.output_memberships;
  comfort.term = comfort_terms[std::max_element(degrees.begin(), degrees.end()) - degrees.begin()];
  for (std::size_t mark = 0; mark < sensation_ids.size(); ++mark)
    comfort.sensation_terms.push_back(sensation_term(mark));
  for (std::size_t i = 0; i < ratings.size(); ++i)
    comfort.memberships.push_back({ratings[i].first, ratings[i].second, answer.memberships[i]});
  const std::vector<std::string> rules = readable_rules(ratings);
  for (std::size_t r = 0; r < rules.size(); ++r) comfort.rules.push_back({rules[r], answer.strengths[r]});
  for (std::size_t t = 0; t < comfort_terms.size(); ++t)
    comfort.output_memberships.emplace_back(comfort_terms[t], answer.output_memberships[t]);
  return comfort;
}

}  // namespace snug::postproc
