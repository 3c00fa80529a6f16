#include "postproc/comfort/membership_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "cases/input/suggestion.hpp"
#include "postproc/comfort/comfort.hpp"
#include "postproc/comfort/comfort_system.hpp"
#include "postproc/comfort/least_squares.hpp"
#include "postproc/comfort/pressure_table.hpp"
#include "postproc/comfort/sensation.hpp"

namespace snug::postproc {
namespace {

/// Answers at one location: rating -> how often each word.
struct Answers {
  std::string location;
  std::map<double, std::vector<double>> at;
};

std::vector<std::string> words(const FuzzyVariable& variable) {
  std::vector<std::string> names;
  for (const FuzzyTerm& term : variable.terms) names.push_back(spoken_name(term.name));
  return names;
}

std::vector<Answers> collect(const input::Csv& table, const std::vector<std::string>& known) {
  input::Diagnostics diagnostics;
  const auto locations = input::texts(table, "location", diagnostics);
  const auto ratings = input::numbers(table, "sensation_rating", "", diagnostics);
  const auto terms = input::texts(table, "sensation_term", diagnostics);
  const auto counts = input::optional_numbers(table, "answers", "", diagnostics);
  diagnostics.throw_if_any();
  std::vector<Answers> all;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto word = std::find_if(known.begin(), known.end(),
                                   [&](const std::string& name) { return plain_name(name) == plain_name(terms[row]); });
    const double count = counts ? (*counts)[row] : 1.0;
    if (word == known.end())
      diagnostics.error(table.place(row, table.find("sensation_term")), fmt::format("the word \"{}\"", terms[row]),
                        input::did_you_mean(terms[row], known));
    if (!(count >= 0.0))
      diagnostics.error(table.place(row, table.find("answers")), fmt::format("{} answers", count), "write a count");
    if (word == known.end()) continue;
    auto here = std::find_if(all.begin(), all.end(),
                             [&](const Answers& one) { return same_name(one.location, locations[row]); });
    if (here == all.end()) here = all.insert(here, {locations[row], {}});
    auto& tally = here->at[ratings[row]];
    tally.resize(known.size());
    tally[word - known.begin()] += count;
  }
  diagnostics.throw_if_any();
  return all;
}

double bell_at(double x, double center, double width, double slope) {
  return 1.0 / (1.0 + std::pow(std::abs((x - center) / width), 2.0 * slope));
}

/// The bells of the words used at one location; parameters (log width, log slope) of each used word.
class Shares {
 public:
  Shares(const Answers& answers, const FuzzyVariable& variable) : variable_(variable) {
    std::vector<double> totals(variable.terms.size());
    for (const auto& [rating, tally] : answers.at)
      for (std::size_t t = 0; t < totals.size(); ++t) totals[t] += tally[t];
    for (std::size_t t = 0; t < totals.size(); ++t)
      if (totals[t] > 0.0) used_.push_back(t);
    for (const auto& [rating, tally] : answers.at) {
      double here = 0.0;
      for (const std::size_t t : used_) here += tally[t];
      if (here <= 0.0) continue;
      ratings_.push_back(rating);
      weights_.push_back(here);
      for (const std::size_t t : used_) shares_.push_back(tally[t] / here);
    }
    totals_ = totals;
  }

  const std::vector<std::size_t>& used() const { return used_; }
  double answers(std::size_t term) const { return totals_[term]; }
  std::size_t count() const { return shares_.size(); }

  std::vector<double> start() const {
    std::vector<double> x;
    for (const std::size_t t : used_) {
      x.push_back(std::log(variable_.terms[t].parameters[1]));
      x.push_back(std::log(variable_.terms[t].parameters[2]));
    }
    return x;
  }

  void residuals(const std::vector<double>& x, std::vector<double>& r) const {
    std::vector<double> m(used_.size());
    for (std::size_t i = 0; i < ratings_.size(); ++i) {
      double sum = 0.0;
      for (std::size_t u = 0; u < used_.size(); ++u)
        sum += m[u] =
            bell_at(ratings_[i], variable_.terms[used_[u]].parameters[0], std::exp(x[2 * u]), std::exp(x[2 * u + 1]));
      for (std::size_t u = 0; u < used_.size(); ++u)
        r[i * used_.size() + u] = std::sqrt(weights_[i]) * (m[u] / sum - shares_[i * used_.size() + u]);
    }
  }

  double deviation(const std::vector<double>& x) const {
    std::vector<double> r(count());
    residuals(x, r);
    double squares = 0.0, weight = 0.0;
    for (const double one : r) squares += one * one;
    for (const double one : weights_) weight += one * used_.size();
    return std::sqrt(squares / weight);
  }

 private:
  const FuzzyVariable& variable_;
  std::vector<std::size_t> used_;
  std::vector<double> ratings_, weights_, shares_, totals_;
};

FittedVariable fit(const Answers& answers, FuzzyVariable& variable, const std::string& file) {
  const Shares shares(answers, variable);
  FittedVariable result{answers.location, {}, 0.0};
  for (std::size_t t = 0; t < variable.terms.size(); ++t) {
    const auto& p = variable.terms[t].parameters;
    result.terms.push_back({spoken_name(variable.terms[t].name), static_cast<int>(std::lround(shares.answers(t))),
                            false, p[1], p[2], p[1], p[2]});
  }
  if (shares.used().size() < 2) return result;  // a word that nothing competes with says nothing of its width
  const auto x =
      least_squares([&](const auto& at, auto& r) { shares.residuals(at, r); }, shares.start(), shares.count());
  if (!x)
    throw input::InputError({file, 0, 0}, fmt::format("no bells fit the words at the location '{}'", answers.location),
                            "give answers at more ratings, some of them between the marks of the scale");
  result.deviation = shares.deviation(*x);
  for (std::size_t u = 0; u < shares.used().size(); ++u) {
    FittedTerm& term = result.terms[shares.used()[u]];
    term.fitted = true;
    term.width = std::exp((*x)[2 * u]);
    term.slope = std::exp((*x)[2 * u + 1]);
    variable.terms[shares.used()[u]].parameters = {variable.terms[shares.used()[u]].parameters[0], term.width,
                                                   term.slope};
  }
  return result;
}

std::vector<std::string> locations_of(const input::Csv& table) {
  input::Diagnostics diagnostics;
  std::vector<std::string> names;
  for (const std::string& name : input::texts(table, "location", diagnostics))
    if (std::none_of(names.begin(), names.end(), [&](const std::string& one) { return same_name(one, name); }))
      names.push_back(name);
  diagnostics.throw_if_any();
  return names;
}

}  // namespace

MembershipFit fit_memberships(const input::Csv& table) {
  MembershipFit result{comfort_system(locations_of(table)), {}};
  result.system.name = "fitted to " + table.file;
  if (table.find("sensation_term") < 0) return result;
  const std::vector<Answers> answers = collect(table, words(result.system.inputs.front()));
  for (std::size_t i = 0; i < answers.size(); ++i)
    result.variables.push_back(fit(answers[i], result.system.inputs[i], table.file));
  return result;
}

}  // namespace snug::postproc
