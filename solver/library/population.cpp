#include "solver/library/population.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "cases/input/csv.hpp"
#include "solver/library/size_search.hpp"
#include "solver/scene/laplace.hpp"

namespace snug::solver {

namespace {

constexpr double slackest = 0.9, tightest = 2.9;  // girth of the wearer over that of the garment

/// Where a function that grows from low to high is a value; an end where it is not between.
double solve_growing(const std::function<double(double)>& f, double value, double low, double high) {
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = 0.5 * (low + high);
    (f(middle) < value ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<double> in_proportion(double first, const std::vector<double>& body) {
  std::vector<double> girths;
  for (const double girth : body) girths.push_back(first * girth / body.front());
  return girths;
}

std::vector<std::string> column_names(const input::Csv& csv) {
  std::vector<std::string> names;
  for (const input::Csv::Column& column : csv.columns) names.push_back(column.name);
  return names;
}

double misfit(const Wearer& wearer, const std::vector<WornPressure>& places, const std::vector<double>& wanted, double size) {
  double sum = 0.0;
  for (std::size_t i = 0; i < places.size(); ++i) sum += std::pow(std::log(std::max(places[i].at(wearer.girths[i], size) / wanted[i], 1e-6)), 2);
  return sum;
}

bool inside(const Wearer& wearer, const std::vector<WornPressure>& places, const std::vector<PressureRange>& ranges, double size) {
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double pressure = places[i].at(wearer.girths[i], size);
    if (pressure < ranges[i].low || pressure > ranges[i].high) return false;
  }
  return true;
}

/// By girth at the first place.
std::vector<Wearer> sorted(std::vector<Wearer> wearers) {
  std::stable_sort(wearers.begin(), wearers.end(), [](const Wearer& a, const Wearer& b) { return a.girths.front() < b.girths.front(); });
  return wearers;
}

/// The one that a share of the sorted wearers is below.
const Wearer& wearer_below(const std::vector<Wearer>& sorted, double share) {
  double below = 0.0;
  for (const Wearer& wearer : sorted)
    if ((below += wearer.share) >= share - 1e-12) return wearer;
  return sorted.back();
}

}  // namespace

std::vector<Wearer> read_wearers(const std::filesystem::path& file, const std::vector<std::string>& places, const std::vector<double>& body_girths) {
  input::Diagnostics diagnostics;
  const input::Csv csv = input::read_csv(file, diagnostics);
  diagnostics.throw_if_any();
  std::vector<std::vector<double>> columns;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::string name = csv.find(places[i]) < 0 && places.size() == 1 && csv.find("girth") >= 0 ? "girth" : places[i];
    if (csv.find(name) < 0 && i == 0)
      throw input::InputError({file.string(), 1, 1}, fmt::format("there is no column of girths at {}", places[i]),
                              fmt::format("call it \"{} [mm]\"; there are: {}", places[i], fmt::join(column_names(csv), ", ")));
    columns.push_back(csv.find(name) < 0 ? std::vector<double>{} : input::numbers(csv, name, "m", diagnostics));
  }
  const std::vector<double> shares = csv.find("share") < 0 ? std::vector<double>(csv.rows.size(), 1.0) : input::numbers(csv, "share", "", diagnostics);
  diagnostics.throw_if_any();
  const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
  std::vector<Wearer> wearers;
  for (std::size_t row = 0; row < csv.rows.size(); ++row) {
    Wearer wearer{in_proportion(columns.front()[row], body_girths), shares[row] / all};
    for (std::size_t i = 1; i < places.size(); ++i)
      if (!columns[i].empty()) wearer.girths[i] = columns[i][row];
    for (std::size_t i = 0; i < places.size(); ++i)
      if (!(wearer.girths[i] > 0.3 * body_girths[i] && wearer.girths[i] < 3.0 * body_girths[i]) || !(shares[row] >= 0.0))
        diagnostics.error(csv.place(row, 0), fmt::format("a girth of {:.4g} mm at {}, where the body of the case has {:.4g} mm", 1e3 * wearer.girths[i], places[i], 1e3 * body_girths[i]),
                          "see the unit of the column, and that shares are not negative");
    wearers.push_back(std::move(wearer));
  }
  diagnostics.throw_if_any();
  if (wearers.empty() || !(all > 0.0)) throw input::InputError({file.string(), 1, 1}, "the table has no wearers", "give a row each, with a share above 0 where there are shares");
  return wearers;
}

std::vector<Wearer> normal_wearers(double mean, double deviation, const std::vector<double>& body_girths) {
  constexpr int count = 400;
  std::vector<Wearer> wearers;
  for (int i = 0; i < count; ++i) {
    const double below = (i + 0.5) / count;
    const double z = solve_growing([](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); }, below, -6.0, 6.0);
    wearers.push_back({in_proportion(mean + z * deviation, body_girths), 1.0 / count});
  }
  return wearers;
}

WornPressure::WornPressure(const GarmentModel& garment, mesh::FitRow row, bool warp_along, double body_girth, double found)
    : garment_(garment), row_(std::move(row)), warp_along_(warp_along), factor_(1.0) {
  factor_ = found / std::max(law(body_girth, 1.0), 1e-12);
}

double WornPressure::law(double girth, double size) const {
  const double stretch = girth / garment_girth(size);
  return stretch <= 1.0 ? 0.0 : tensions(garment_, row_, warp_along_, std::min(stretch, tightest)).x() / girth;
}

double WornPressure::at(double girth, double size) const { return factor_ * law(girth, size); }

double WornPressure::girth_for(double pressure, double size) const {
  return solve_growing([&](double girth) { return at(girth, size); }, pressure, slackest * garment_girth(size), tightest * garment_girth(size));
}

std::vector<SizeRow> size_table(const std::vector<Wearer>& wearers, const std::vector<WornPressure>& places, const std::vector<double>& wanted,
                                const std::vector<PressureRange>& ranges, int sizes) {
  const std::vector<Wearer> people = sorted(wearers);
  std::vector<SizeRow> rows;
  for (int k = 0; k < sizes; ++k) {
    const Wearer& middle = wearer_below(people, (k + 0.5) / sizes);
    const double about = middle.girths.front() / places.front().garment_girth(1.0);
    SizeRow row{.size = least([&](double size) { return misfit(middle, places, wanted, size); }, about / tightest, about / slackest)};
    row.garment_girth = places.front().garment_girth(row.size);
    row.from_girth = places.front().girth_for(ranges.front().low, row.size), row.to_girth = places.front().girth_for(ranges.front().high, row.size);
    row.from_ease = row.garment_girth / row.from_girth - 1.0, row.to_ease = row.garment_girth / row.to_girth - 1.0;
    rows.push_back(row);
  }
  for (const Wearer& wearer : people) {
    const auto nearer = [&](const SizeRow& a, const SizeRow& b) { return misfit(wearer, places, wanted, a.size) < misfit(wearer, places, wanted, b.size); };
    SizeRow& taken = *std::min_element(rows.begin(), rows.end(), nearer);
    taken.worn += wearer.share;
    if (inside(wearer, places, ranges, taken.size)) taken.inside += wearer.share;
  }
  return rows;
}

double girth_below(const std::vector<Wearer>& wearers, double share) { return wearer_below(sorted(wearers), share).girths.front(); }

}  // namespace snug::solver
