#include "postproc/sensation.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>

#include "postproc/pressure_table.hpp"
#include "postproc/shipped_tables.hpp"

namespace snug::postproc {
namespace {

constexpr double significance_level = 0.05;
constexpr const char* shipped_trial = "wear trial 2002";

/// What the trial measured at one location.
struct Observations {
  std::string location;
  std::vector<double> pressure, rating;
};

std::vector<Observations> observations(const input::Csv& table) {
  input::Diagnostics diagnostics;
  const std::vector<std::string> locations = input::texts(table, "location", diagnostics);
  const std::vector<double> ratings = input::numbers(table, "sensation_rating", "", diagnostics);
  const std::vector<double> pressures = pressures_of(table, diagnostics);
  diagnostics.throw_if_any();
  std::vector<Observations> groups;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const auto here = [&](const Observations& group) { return same_name(group.location, locations[row]); };
    auto group = std::find_if(groups.begin(), groups.end(), here);
    if (group == groups.end()) group = groups.insert(group, {locations[row], {}, {}});
    if (!(ratings[row] >= lowest_rating && ratings[row] <= highest_rating))
      diagnostics.error(table.place(row, table.find("sensation_rating")), fmt::format("a rating of {}", ratings[row]),
                        "write ratings on the scale 0 to 4");
    group->pressure.push_back(pressures[row]);
    group->rating.push_back(ratings[row]);
  }
  diagnostics.throw_if_any();
  return groups;
}

void require_a_line(const Observations& seen, const std::string& source) {
  const std::set<double> different(seen.pressure.begin(), seen.pressure.end());
  if (different.size() < 3)
    throw input::InputError({source, 0, 0},
                            fmt::format("location '{}' has fewer than three different pressures", seen.location),
                            "give at least three, so that a line and its scatter can be computed");
}

/// Two-sided p of "the slope is zero": t = slope / its standard error, n - 2 degrees of freedom.
double slope_p_value(double slope, double variance, int degrees) {
  if (variance <= 0) return slope == 0 ? 1.0 : 0.0;  // all points on the line
  return 2 * gsl_cdf_tdist_Q(std::abs(slope) / std::sqrt(variance), degrees);
}

SensationCurve fit(const Observations& seen, const std::string& source) {
  require_a_line(seen, source);
  const std::size_t n = seen.pressure.size();
  const int degrees = static_cast<int>(n) - 2;
  SensationCurve curve;
  curve.location = seen.location;
  curve.points = static_cast<int>(n);
  double cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
  gsl_fit_linear(seen.pressure.data(), 1, seen.rating.data(), 1, n, &curve.intercept, &curve.slope, &cov00, &cov01,
                 &cov11, &squares);
  curve.scatter = std::sqrt(squares / degrees);
  curve.p_value = slope_p_value(curve.slope, cov11, degrees);
  curve.significant = curve.p_value < significance_level;
  curve.mean_rating = std::accumulate(seen.rating.begin(), seen.rating.end(), 0.0) / n;
  const auto [low, high] = std::minmax_element(seen.pressure.begin(), seen.pressure.end());
  curve.low = *low;
  curve.high = *high;
  for (std::size_t i = 0; i < n; ++i) {
    const double residual = seen.rating[i] - curve.intercept - curve.slope * seen.pressure[i];
    curve.largest_residual = std::max(curve.largest_residual, std::abs(residual));
  }
  return curve;
}

}  // namespace

std::string sensation_term(double rating) {
  static constexpr std::array terms = {"neutral", "comfortable", "uncomfortable", "very uncomfortable",
                                       "extremely uncomfortable"};
  return terms[std::lround(std::clamp(rating, lowest_rating, highest_rating))];
}

Rating rate(const SensationCurve& curve, double pressure) {
  const double value = curve.significant ? curve.intercept + curve.slope * pressure : curve.mean_rating;
  Rating rating;
  rating.value = std::clamp(value, lowest_rating, highest_rating);
  rating.term = sensation_term(rating.value);
  rating.significant = curve.significant;
  rating.extrapolated = pressure < curve.low || pressure > curve.high;
  return rating;
}

const SensationCurve* SensationCurves::find(std::string_view location) const {
  const auto found = std::find_if(curves.begin(), curves.end(),
                                  [&](const auto& curve) { return same_name(curve.location, location); });
  return found == curves.end() ? nullptr : &*found;
}

SensationCurves fit_curves(const input::Csv& table) {
  SensationCurves curves{table.file, {}};
  for (const Observations& seen : observations(table)) curves.curves.push_back(fit(seen, table.file));
  return curves;
}

SensationCurves load_curves(const input::ComfortSpec& spec, const std::filesystem::path& directory) {
  const std::string& name = spec.curves.name;
  if (same_name(name, shipped_trial)) return fit_curves(shipped_csv(wear_trial_2002(), shipped_trial));
  const std::filesystem::path file = directory / name;
  if (name.empty() || !std::filesystem::is_regular_file(file))
    throw input::InputError(spec.curves.where, fmt::format("there are no sensation curves \"{}\"", name),
                            fmt::format("write \"{}\" or the path of a CSV file with the columns location, "
                                        "pressure_gf_per_cm2, sensation_rating",
                                        shipped_trial));
  input::Diagnostics diagnostics;
  const input::Csv table = input::read_csv(file, diagnostics);
  diagnostics.throw_if_any();
  return fit_curves(table);
}

}  // namespace snug::postproc
