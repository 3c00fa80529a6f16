#include "postproc/comfort/curve_fit.hpp"

#include <fmt/format.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <set>

#include "postproc/comfort/least_squares.hpp"
#include "postproc/comfort/pressure_table.hpp"

namespace snug::postproc {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double squares_about_mean(const std::vector<double>& values, double mean) {
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

double mean_of(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

void require_enough(const Observations& seen, std::size_t least, const std::string& source) {
  const std::set<double> different(seen.pressure.begin(), seen.pressure.end());
  if (different.size() < least)
    throw input::InputError({source, 0, 0},
                            fmt::format("location '{}' has {} different pressures", seen.location, different.size()),
                            fmt::format("give at least {}, so that the curve and its scatter can be computed", least));
}

double residual_squares(const CurveShape& shape, const Observations& seen) {
  double sum = 0.0;
  for (std::size_t i = 0; i < seen.pressure.size(); ++i)
    sum += std::pow(seen.rating[i] - value_at(shape, seen.pressure[i]), 2);
  return sum;
}

/// p of the F-test "the curve explains no more than the mean": F = ((S0 - S)/(k - 1)) / (S/(n - k)).
double f_test(double about_mean, double residual, int parameters, int points) {
  if (residual <= 0.0) return about_mean > 0.0 ? 0.0 : 1.0;  // all points on the curve
  const double f = (about_mean - residual) / (parameters - 1) / (residual / (points - parameters));
  return f > 0.0 ? gsl_cdf_fdist_Q(f, parameters - 1, points - parameters) : 1.0;
}

// ---- shapes

void fit_line(const Observations& seen, SensationCurve& curve) {
  Line line;
  double cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
  gsl_fit_linear(seen.pressure.data(), 1, seen.rating.data(), 1, seen.pressure.size(), &line.intercept, &line.slope,
                 &cov00, &cov01, &cov11, &squares);
  curve.shape = line;
  curve.parameters = 2;
  curve.intercept_error = std::sqrt(cov00);
  curve.slope_error = std::sqrt(cov11);
}

/// Constant up to `start`, a straight line from there on: linear least squares in (base, slope) of max(p - start, 0).
Polyline hinge(const Observations& seen, double start) {
  std::vector<double> beyond;
  for (const double p : seen.pressure) beyond.push_back(std::max(p - start, 0.0));
  double base = 0, slope = 0, cov00 = 0, cov01 = 0, cov11 = 0, squares = 0;
  gsl_fit_linear(beyond.data(), 1, seen.rating.data(), 1, beyond.size(), &base, &slope, &cov00, &cov01, &cov11,
                 &squares);
  const auto [low, high] = std::minmax_element(seen.pressure.begin(), seen.pressure.end());
  return {{*low, start, *high}, {base, base, base + slope * (*high - start)}};
}

/// The minimum of f between a and b by golden sections: f need not be smooth.
double golden_section(const std::function<double(double)>& f, double a, double b) {
  const double ratio = (std::sqrt(5.0) - 1.0) / 2.0;
  double c = b - ratio * (b - a), d = a + ratio * (b - a);
  double at_c = f(c), at_d = f(d);
  for (int i = 0; i < 80; ++i) {
    if (at_c < at_d) {
      b = d, d = c, at_d = at_c;
      c = b - ratio * (b - a), at_c = f(c);
    } else {
      a = c, c = d, at_c = at_d;
      d = a + ratio * (b - a), at_d = f(d);
    }
  }
  return (a + b) / 2.0;
}

/// The sum of squares is smooth in the break between two measured pressures only: each interval has its own minimum.
void fit_hinge(const Observations& seen, SensationCurve& curve) {
  const std::set<double> different(seen.pressure.begin(), seen.pressure.end());
  const std::vector<double> p(different.begin(), different.end());
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 2 < p.size(); ++i) {  // two pressures beyond the break at least
    const auto squares = [&](double start) { return residual_squares(hinge(seen, start), seen); };
    const double margin = 1e-9 * (p[i + 1] - p[i]);  // points of the polyline stay apart
    const double start = golden_section(squares, p[i] + margin, p[i + 1]);
    if (squares(start) < best) {
      best = squares(start);
      curve.shape = hinge(seen, start);
    }
  }
  curve.parameters = 3;
}

/// A line where no logistic curve fits: the ratings do not grow with the pressure there.
void fit_logistic(const Observations& seen, SensationCurve& curve) {
  const auto [low, high] = std::minmax_element(seen.pressure.begin(), seen.pressure.end());
  const double scale = *high - *low;
  const auto shape = [&](const std::vector<double>& x) {  // x = (middle, log width) in units of the range
    return Logistic{.middle = *low + scale * x[0], .width = scale * std::exp(x[1])};
  };
  const auto residuals = [&](const std::vector<double>& x, std::vector<double>& r) {
    const CurveShape now = shape(x);
    for (std::size_t i = 0; i < r.size(); ++i) r[i] = value_at(now, seen.pressure[i]) - seen.rating[i];
  };
  const auto answer = least_squares(residuals, {1.0, -1.0}, seen.pressure.size());
  if (!answer) return fit_line(seen, curve);
  curve.shape = shape(*answer);
  curve.parameters = 2;
}

void add_statistics(const Observations& seen, SensationCurve& curve) {
  const int n = curve.points = static_cast<int>(seen.pressure.size());
  curve.mean_rating = mean_of(seen.rating);
  curve.mean_pressure = mean_of(seen.pressure);
  curve.pressure_squares = squares_about_mean(seen.pressure, curve.mean_pressure);
  const double about_mean = squares_about_mean(seen.rating, curve.mean_rating);
  const double residual = residual_squares(curve.shape, seen);
  curve.mean_scatter = std::sqrt(about_mean / (n - 1));
  curve.scatter = std::sqrt(residual / (n - curve.parameters));
  curve.r_squared = about_mean > 0.0 ? 1.0 - residual / about_mean : 0.0;
  curve.p_value = f_test(about_mean, residual, curve.parameters, n);
  curve.significant = curve.p_value < significance_level;
  for (std::size_t i = 0; i < seen.pressure.size(); ++i)
    curve.largest_residual =
        std::max(curve.largest_residual, std::abs(seen.rating[i] - value_at(curve.shape, seen.pressure[i])));
}

}  // namespace

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
    if (group == groups.end()) group = groups.insert(group, {locations[row], {}, {}, {}});
    if (!(ratings[row] >= lowest_rating && ratings[row] <= highest_rating))
      diagnostics.error(table.place(row, table.find("sensation_rating")), fmt::format("a rating of {}", ratings[row]),
                        "write ratings on the scale 0 to 4");
    group->pressure.push_back(pressures[row]);
    group->rating.push_back(ratings[row]);
    group->rows.push_back(row);
  }
  diagnostics.throw_if_any();
  if (groups.empty())
    throw input::InputError({table.file, 0, 0}, "the table has no rows", "give ratings and pressures");
  return groups;
}

SensationCurve fit_curve(const Observations& seen, const std::string& shape, const std::string& source) {
  require_enough(seen, shape == "piecewise" ? 4 : 3, source);
  SensationCurve curve;
  curve.location = seen.location;
  curve.slope_error = curve.intercept_error = unknown;
  const auto [low, high] = std::minmax_element(seen.pressure.begin(), seen.pressure.end());
  curve.low = *low;
  curve.high = *high;
  if (shape == "linear")
    fit_line(seen, curve);
  else if (shape == "piecewise")
    fit_hinge(seen, curve);
  else
    fit_logistic(seen, curve);
  add_statistics(seen, curve);
  return curve;
}

SensationCurves fit_curves(const input::Csv& table, const std::string& shape) {
  SensationCurves all;
  all.name = all.source = table.file;
  for (const Observations& seen : observations(table)) all.curves.push_back(fit_curve(seen, shape, table.file));
  return all;
}

}  // namespace snug::postproc
