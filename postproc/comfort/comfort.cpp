#include "postproc/comfort/comfort.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "postproc/comfort/comfort_system.hpp"
#include "postproc/comfort/fuzzy_rule.hpp"
#include "postproc/comfort/score_interval.hpp"

namespace snug::postproc {
namespace {

/// The inputs that the ratings speak of, in the order of the ratings.
struct Question {
  FuzzySystem system;  ///< restricted to the inputs asked
  std::vector<LocationRating> ratings;
  std::vector<std::string> left_out, silent;
};

Question ask(const std::vector<LocationRating>& ratings, const FuzzySystem& system) {
  Question question;
  std::vector<std::size_t> present;
  std::vector<char> asked(system.inputs.size(), 0);
  for (const LocationRating& rating : ratings) {
    std::size_t i = 0;
    while (i < system.inputs.size() && (asked[i] || plain_name(system.inputs[i].name) != plain_name(rating.location)))
      ++i;
    if (i == system.inputs.size()) {
      question.left_out.push_back(rating.location);
      continue;
    }
    asked[i] = 1;
    present.push_back(i);
    question.ratings.push_back(rating);
  }
  for (std::size_t i = 0; i < asked.size(); ++i)
    if (!asked[i]) question.silent.push_back(spoken_name(system.inputs[i].name));
  question.system = restricted(system, present);
  return question;
}

/// Where a term of the output is fully true; none for shapes without one such place.
std::optional<double> peak(const FuzzyTerm& term) {
  if (term.parameters.empty()) return std::nullopt;
  if (term.shape == "Bell" || term.shape == "Gaussian") return term.parameters[0];
  if (term.shape == "Triangle" && term.parameters.size() > 1) return term.parameters[1];
  return std::nullopt;
}

std::string scale_of(const FuzzyVariable& output) {
  std::string text;
  for (const FuzzyTerm& term : output.terms) {
    const auto at = peak(term);
    text += (text.empty() ? "" : ", ") + (at ? fmt::format("{:g} ", *at) : "") + spoken_name(term.name);
  }
  return text;
}

void describe(const Question& question, const FuzzyAnswer& answer, Comfort& comfort) {
  const FuzzySystem& system = question.system;
  for (const FuzzyTerm& term : system.inputs.front().terms) comfort.sensation_terms.push_back(spoken_name(term.name));
  for (std::size_t i = 0; i < question.ratings.size(); ++i)
    comfort.memberships.push_back({question.ratings[i].location, question.ratings[i].rating, answer.memberships[i]});
  for (std::size_t r = 0; r < system.rules.size(); ++r) {
    const FuzzyRule rule = parse_rule(system.rules[r]);
    comfort.rules.push_back({in_words(rule, system), spoken_name(rule.term), answer.strengths[r]});
  }
  for (std::size_t t = 0; t < system.output.terms.size(); ++t)
    comfort.output_memberships.emplace_back(spoken_name(system.output.terms[t].name), answer.output_memberships[t]);
}

}  // namespace

Comfort judge(const std::vector<LocationRating>& ratings, const FuzzySystem& system, const Sampling& sampling) {
  const Question question = ask(ratings, system);
  if (question.ratings.empty()) throw std::invalid_argument("comfort: no location with a rating is an input");
  if (question.system.rules.empty()) throw std::invalid_argument("comfort: no rule speaks of the rated locations");
  FuzzyEngine engine(question.system);
  std::vector<double> values;
  for (const LocationRating& one : question.ratings) values.push_back(one.rating);
  const FuzzyAnswer answer = engine.answer(values);

  Comfort comfort;
  comfort.score = answer.score;
  const auto& degrees = answer.output_memberships;
  const auto most = std::max_element(degrees.begin(), degrees.end()) - degrees.begin();
  comfort.term = std::isfinite(answer.score) ? spoken_name(system.output.terms[most].name) : "undecided";
  comfort.scale = scale_of(system.output);
  comfort.system = system.name;
  comfort.left_out = question.left_out;
  comfort.silent = question.silent;
  describe(question, answer, comfort);
  if (sampling.samples > 0) comfort.interval = score_interval(question.ratings, engine, sampling);
  return comfort;
}

Comfort judge(const std::vector<LocationRating>& ratings) {
  std::vector<std::string> names;
  for (const LocationRating& one : ratings) names.push_back(one.location);
  if (names.empty()) throw std::invalid_argument("comfort: no location has a rating");
  return judge(ratings, comfort_system(names));
}

}  // namespace snug::postproc
