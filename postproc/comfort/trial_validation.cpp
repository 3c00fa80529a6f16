#include "postproc/comfort/trial_validation.hpp"

#include <algorithm>
#include <cmath>

#include "cases/input/suggestion.hpp"
#include "postproc/comfort/curve_fit.hpp"

namespace snug::postproc {

namespace {

/// The rows of some garments.
input::Csv rows_of(const input::Csv& table, int column, const std::set<std::string>& garments) {
  input::Csv some = table;
  std::erase_if(some.rows, [&](const input::Csv::Row& row) { return !garments.contains(row.cells[static_cast<std::size_t>(column)]); });
  return some;
}

void check_garments(const input::Csv& table, int column, const std::set<std::string>& train, const std::set<std::string>& test) {
  const input::Location where{table.file, 0, 0};
  if (column < 0) throw input::InputError(where, "the table has no column garment", "name the garment of each rating, so that some can be kept for the test");
  std::set<std::string> known;
  for (const input::Csv::Row& row : table.rows) known.insert(row.cells[static_cast<std::size_t>(column)]);
  for (const auto* garments : {&train, &test})
    for (const std::string& garment : *garments)
      if (!known.contains(garment)) throw input::InputError(where, "there is no garment " + garment, input::did_you_mean(garment, {known.begin(), known.end()}));
  for (const std::string& garment : train)
    if (test.contains(garment)) throw input::InputError(where, "garment " + garment + " is fitted and tested", "a test is of garments that the curves do not know");
}

}  // namespace

TrialValidation validate_trial(const input::Csv& table, const std::string& shape, const std::set<std::string>& train, const std::set<std::string>& test) {
  const int column = table.find("garment");
  check_garments(table, column, train, test);
  const SensationCurves curves = fit_curves(rows_of(table, column, train), shape);
  TrialValidation validation;
  double all = 0.0;
  for (const Observations& seen : observations(rows_of(table, column, test))) {
    const SensationCurve* curve = curves.find(seen.location);
    if (!curve) continue;
    LocationValidation here{.location = seen.location, .tested = static_cast<int>(seen.rating.size()), .significant = curve->significant};
    double squares = 0.0;
    for (std::size_t i = 0; i < seen.rating.size(); ++i) {
      const double error = rate(*curve, seen.pressure[i]).value - seen.rating[i];
      squares += error * error, here.largest = std::max(here.largest, std::abs(error));
    }
    here.rms = std::sqrt(squares / here.tested);
    if (here.significant) all += squares, validation.ratings += here.tested;
    validation.locations.push_back(std::move(here));
  }
  validation.rms = validation.ratings > 0 ? std::sqrt(all / validation.ratings) : 0.0;
  return validation;
}

}  // namespace snug::postproc
