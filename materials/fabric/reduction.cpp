#include "materials/fabric/reduction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace snug::materials {

namespace {

using input::InputError;
using Quantities = std::map<std::string, double>;
using Samples = std::vector<Sample>;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double at_rest = 0.02;  // of the largest value: a branch that comes back so far has come back

/// Area under y(x) by trapezia; negative where x falls.
double area(const Samples& samples) {
  double sum = 0.0;
  for (std::size_t k = 1; k < samples.size(); ++k)
    sum += 0.5 * (samples[k].y + samples[k - 1].y) * (samples[k].x - samples[k - 1].x);
  return sum;
}

/// One cycle: up to the largest y and back.
struct Cycle {
  Samples up, back;
};

/// y counts from `offset`; the way back ends where it is used up.
Cycle cycle_of(const Samples& samples, double offset) {
  const auto turn =
      std::max_element(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.y < b.y; });
  Cycle cycle;
  for (auto it = samples.begin(); it <= turn; ++it)
    cycle.up.push_back({it->x, std::max(0.0, it->y - offset), it->line});
  for (auto it = turn; it != samples.end(); ++it) {
    const Sample next{it->x, it->y - offset, it->line};
    if (next.y <= 0.0) {
      if (!cycle.back.empty()) {
        const Sample last = cycle.back.back();
        cycle.back.push_back({last.x + (next.x - last.x) * last.y / (last.y - next.y), 0.0, next.line});
      }
      break;
    }
    cycle.back.push_back(next);
  }
  return cycle;
}

bool has_come_back(const Cycle& cycle) {
  return cycle.back.size() >= 3 && cycle.back.back().y <= at_rest * cycle.up.back().y;
}

/// Work of the way back over `work`, that of the way up; nothing where the test ends before.
std::optional<double> resilience(const Cycle& cycle, double work, const input::Location& where) {
  if (!has_come_back(cycle)) return std::nullopt;
  const double share = std::abs(area(cycle.back)) / work;
  if (share > 1.0)
    throw InputError(where, fmt::format("the way back holds {:.4g} % of the work of the way up", 100.0 * share),
                     "cloth gives back less than it took: see whether the branches are exchanged");
  return share;
}

void refuse_cycles(const Samples& up, double direction, const std::string& what, const input::Location& where) {
  constexpr double noise = 0.1;  // of the range
  const double range = std::abs(up.back().x - up.front().x);
  double furthest = up.front().x;
  for (const Sample& sample : up) {
    if (direction * (sample.x - furthest) > 0.0) furthest = sample.x;
    if (direction * (furthest - sample.x) > noise * range)
      throw InputError({where.file, sample.line, sample.line ? 1 : 0},
                       fmt::format("the {} turns back before the largest value", what),
                       "give one cycle a table: from rest to the largest value, and back to rest");
  }
}

// WT = integral of F de up to (em, Fm), LT = WT/(Fm em/2), EMT = em, RT = WT'/WT with the work WT' of the way back (B1;
// Kawabata, The Standardization and Analysis of Hand Evaluation, 2nd ed. 1980). A force at no elongation is a
// pretension: the test counts from there.
Quantities tensile(const RawTest& test) {
  const double offset = test.samples.front().x > 0.0 ? 0.0 : std::max(0.0, test.samples.front().y);
  Cycle cycle = cycle_of(test.samples, offset);
  if (cycle.up.front().x > 0.0) cycle.up.insert(cycle.up.begin(), Sample{});
  refuse_cycles(cycle.up, 1.0, "elongation", test.where);
  const double em = cycle.up.back().x, Fm = cycle.up.back().y, WT = area(cycle.up);
  if (!(em > 0.0 && Fm > 0.0 && WT > 0.0))
    throw InputError(test.where, "the force does not rise over the elongation",
                     "give elongations from 0 and the force of each, in the order of the test");
  Quantities all = {{"WT", WT}, {"Fm", Fm}, {"EMT", em}, {"LT", 2.0 * WT / (Fm * em)}};
  if (const auto RT = resilience(cycle, WT, test.where)) all["RT"] = *RT;
  return all;
}

/// Pieces of a test in which x runs in one direction; a turn is a way back of more than a fiftieth of the range.
std::vector<Samples> runs_of(const Samples& samples) {
  double low = samples.front().x, high = low;
  for (const Sample& sample : samples) low = std::min(low, sample.x), high = std::max(high, sample.x);
  const double noise = 0.02 * (high - low);
  std::vector<std::size_t> turns = {0};
  int direction = 0;  // none yet
  std::size_t extreme = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const double moved = samples[k].x - samples[extreme].x;
    if (direction != 0 && direction * moved >= 0.0) {
      extreme = k;
    } else if (std::abs(moved) > noise) {
      if (direction != 0) turns.push_back(extreme);
      direction = moved > 0.0 ? 1 : -1, extreme = k;
    }
  }
  turns.push_back(samples.size() - 1);
  std::vector<Samples> runs;
  for (std::size_t t = 1; t < turns.size(); ++t)
    if (turns[t] > turns[t - 1])
      runs.emplace_back(samples.begin() + static_cast<std::ptrdiff_t>(turns[t - 1]),
                        samples.begin() + static_cast<std::ptrdiff_t>(turns[t]) + 1);
  return runs;
}

/// y where a run passes x; the mean where noise makes it pass several times.
std::optional<double> value_at(const Samples& run, double x) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 1; k < run.size(); ++k) {
    const Sample &a = run[k - 1], &b = run[k];
    if (a.x == b.x || (x - a.x) * (x - b.x) > 0.0) continue;
    sum += a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x), ++count;
  }
  return count ? std::optional(sum / count) : std::nullopt;
}

/// A test that goes to and fro through 0: shear and bending.
class Loop {
 public:
  explicit Loop(const Samples& samples) : runs_(runs_of(samples)) {}

  /// Mean of (y(b) - y(a))/(b - a) over all runs of both signs that pass a and b.
  std::optional<double> slope(double a, double b) const {
    return mean([&](const Samples& run, double sign) -> std::optional<double> {
      const auto ya = value_at(run, sign * a), yb = value_at(run, sign * b);
      if (!ya || !yb) return std::nullopt;
      return (*yb - *ya) / (sign * (b - a));
    });
  }
  /// Width of the loop at x: what a run of rising x has there less what one of falling x has, mean over both signs.
  std::optional<double> width(double x) const {
    double sum = 0.0;
    int count = 0;
    for (const double at : {x, -x}) {
      const auto rising = at_in(at, 1.0), falling = at_in(at, -1.0);
      if (rising && falling) sum += *rising - *falling, ++count;
    }
    return count ? std::optional(sum / count) : std::nullopt;
  }

 private:
  std::optional<double> at_in(double x, double direction) const {
    double sum = 0.0;
    int count = 0;
    for (const Samples& run : runs_)
      if (direction * (run.back().x - run.front().x) > 0.0)
        if (const auto value = value_at(run, x)) sum += *value, ++count;
    return count ? std::optional(sum / count) : std::nullopt;
  }
  template <class Of>
  std::optional<double> mean(Of of) const {
    double sum = 0.0;
    int count = 0;
    for (const double sign : {1.0, -1.0})
      for (const Samples& run : runs_)
        if (const auto value = of(run, sign)) sum += *value, ++count;
    return count ? std::optional(sum / count) : std::nullopt;
  }
  std::vector<Samples> runs_;
};

double furthest(const Samples& samples) {
  double most = 0.0;
  for (const Sample& sample : samples) most = std::max(most, std::abs(sample.x));
  return most;
}

/// The way to and fro has a width that is none where the branches are exchanged.
void add_width(Quantities& all, const std::string& symbol, std::optional<double> width, const input::Location& where) {
  if (!width) return;
  if (*width < 0.0)
    throw InputError(where, symbol + " comes out negative: the way back lies above the way up",
                     "give the rows in the order of the test");
  all[symbol] = *width;
}

// G = mean slope from 0.5 to 5 degrees, 2HG and 2HG5 = width of the loop at 0.5 and 5 degrees (B1, B4). The slope is
// the mean of both branches, so that friction that grows with the angle does not pass for stiffness: of F = G phi +-
// HG(phi) it is G.
Quantities shear(const RawTest& test) {
  const Loop loop(test.samples);
  const auto G = loop.slope(0.5 * degree, 5.0 * degree);
  if (!G)
    throw InputError(test.where,
                     fmt::format("the test of shear goes to {:.3g} degrees", furthest(test.samples) / degree),
                     "G is the slope from 0.5 to 5 degrees: shear by 5 degrees at least, KES by 8");
  if (!(*G > 0.0))
    throw InputError(test.where, "the force does not rise with the angle",
                     "give the angle and the force of each, with the sign of the angle");
  Quantities all = {{"G", *G}};
  add_width(all, "2HG", loop.width(0.5 * degree), test.where);
  add_width(all, "2HG5", loop.width(5.0 * degree), test.where);
  return all;
}

// B = mean slope from 0.5 to 1.5 /cm over both signs and both branches, 2HB = width of the loop at 0.5 /cm, or where
// `places` says (B4).
Quantities bending(const RawTest& test, const ReductionPlaces& places) {
  const Loop loop(test.samples);
  const auto B = loop.slope(50.0, 150.0);
  if (!B)
    throw InputError(test.where, fmt::format("the test of bending goes to {:.3g} /cm", 0.01 * furthest(test.samples)),
                     "B is the slope from 0.5 to 1.5 /cm: bend by 1.5 /cm at least, KES by 2.5");
  if (!(*B > 0.0))
    throw InputError(test.where, "the moment does not rise with the curvature",
                     "give the curvature and the moment of each, with the sign of the curvature");
  Quantities all = {{"B", *B}};
  add_width(all, "2HB", loop.width(places.bending_hysteresis), test.where);
  return all;
}

// T0 = thickness at 0.5 gf/cm2, Tm at the largest pressure Pm, WC = integral of P dT from T0 to Tm, LC = WC/(Pm (T0 -
// Tm)/2), RC = WC'/WC with the work WC' of the way back (Kawabata 1980; B3).
Quantities compression(const RawTest& test) {
  constexpr double touch = 0.5 * 98.0665;  // Pa
  const Cycle cycle = cycle_of(test.samples, 0.0);
  refuse_cycles(cycle.up, -1.0, "thickness", test.where);
  const double Pm = cycle.up.back().y, Tm = cycle.up.back().x;
  Samples from_touch;
  for (std::size_t k = 0; k < cycle.up.size(); ++k) {
    if (cycle.up[k].y < touch) continue;
    if (from_touch.empty() && k > 0) {
      const Sample &a = cycle.up[k - 1], &b = cycle.up[k];
      from_touch.push_back({a.x + (b.x - a.x) * (touch - a.y) / (b.y - a.y), touch, b.line});
    }
    from_touch.push_back(cycle.up[k]);
  }
  if (cycle.up.front().y > touch)
    throw InputError(test.where, fmt::format("the test begins at {:.3g} gf/cm2", cycle.up.front().y / 98.0665),
                     "T0 is the thickness at 0.5 gf/cm2: begin at that pressure or below");
  if (from_touch.size() < 2 || !(Tm > 0.0) || !(from_touch.front().x > Tm))
    throw InputError(test.where, "the thickness does not fall under the pressure",
                     "give the thickness and the pressure of each, in the order of the test");
  const double T0 = from_touch.front().x, WC = -area(from_touch);
  Quantities all = {{"T0", T0}, {"Tm", Tm}, {"Pm", Pm}, {"WC", WC}, {"LC", 2.0 * WC / (Pm * (T0 - Tm))}};
  if (const auto RC = resilience(cycle, WC, test.where)) all["RC"] = *RC;
  return all;
}

double travelled(const RawTest& test) {
  const double X = test.samples.back().x - test.samples.front().x;
  for (std::size_t k = 1; k < test.samples.size(); ++k)
    if (!(test.samples[k].x > test.samples[k - 1].x))
      throw InputError({test.where.file, test.samples[k].line, 1}, "the distance does not increase",
                       "give one stroke of the feeler, sorted by distance");
  return X;
}

/// Mean of y over x, and the mean distance from it: the hatched area of the sheet over X.
std::pair<double, double> mean_and_deviation(const RawTest& test) {
  const double X = travelled(test);
  const double mean = area(test.samples) / X;
  double hatched = 0.0;
  for (std::size_t k = 1; k < test.samples.size(); ++k) {
    const double a = test.samples[k - 1].y - mean, b = test.samples[k].y - mean,
                 dx = test.samples[k].x - test.samples[k - 1].x;
    hatched += a * b >= 0.0 ? 0.5 * std::abs(a + b) * dx : 0.5 * (a * a + b * b) / std::abs(b - a) * dx;
  }
  return {mean, hatched / X};
}

// MIU = 1/X integral of mu dx, MMD = 1/X integral of |mu - MIU| dx (B3).
Quantities friction(const RawTest& test) {
  const auto [mean, deviation] = mean_and_deviation(test);
  if (!(mean > 0.0))
    throw InputError(test.where, "the mean coefficient of friction is not positive",
                     "give its size, without the direction of the stroke");
  return {{"MIU", mean}, {"MMD", deviation}};
}

// SMD = 1/X integral of |z - mean z| dx (B3).
Quantities roughness(const RawTest& test) { return {{"SMD", mean_and_deviation(test).second}}; }

Quantities of_kind(const RawTest& test, const ReductionPlaces& places) {
  switch (test.kind) {
    case TestKind::shear:
      return shear(test);
    case TestKind::bending:
      return bending(test, places);
    case TestKind::compression:
      return compression(test);
    case TestKind::friction:
      return friction(test);
    case TestKind::roughness:
      return roughness(test);
    default:
      return tensile(test);
  }
}

}  // namespace

Quantities reduced(const RawTest& test, const ReductionPlaces& places) {
  if (test.samples.size() < 3)
    throw InputError(test.where, fmt::format("the table has {} rows", test.samples.size()),
                     "give the whole curve, three rows at least");
  const Quantities all = of_kind(test, places);
  for (const auto& [symbol, value] : all)
    if (!std::isfinite(value))
      throw InputError(test.where, symbol + " comes out beyond all numbers", "see whether its rows are what was measured");
  return all;
}

std::string formula_of(const std::string& symbol, const ReductionPlaces& places) {
  static const std::map<std::string, std::string> formulas = {
      {"LT", "WT/(Fm EMT/2)"},
      {"WT", "integral of F de up to EMT"},
      {"Fm", "largest force"},
      {"EMT", "elongation at Fm"},
      {"RT", "100 WT'/WT, WT' the integral of the way back"},
      {"G", "mean slope from 0.5 to 5 degrees, both branches"},
      {"2HG", "width of the loop at 0.5 degrees"},
      {"2HG5", "width of the loop at 5 degrees"},
      {"B", "mean slope from 0.5 to 1.5 /cm, both signs and branches"},
      {"T0", "thickness at 0.5 gf/cm2"},
      {"Tm", "thickness at Pm"},
      {"Pm", "largest pressure"},
      {"WC", "integral of P dT from T0 to Tm"},
      {"LC", "WC/(Pm (T0 - Tm)/2)"},
      {"RC", "100 WC'/WC, WC' the integral of the way back"},
      {"MIU", "integral of mu dx over X"},
      {"MMD", "integral of |mu - MIU| dx over X"},
      {"SMD", "integral of |z - mean z| dx over X"}};
  if (symbol == "2HB") return fmt::format("width of the loop at {:g} /cm", 0.01 * places.bending_hysteresis);
  const auto found = formulas.find(symbol);
  return found == formulas.end() ? std::string() : found->second;
}

Spread spread_of(const std::vector<double>& values) {
  Spread spread{.count = static_cast<int>(values.size())};
  for (const double value : values) spread.mean += value / static_cast<double>(values.size());
  double squares = 0.0;
  for (const double value : values) squares += (value - spread.mean) * (value - spread.mean);
  if (values.size() > 1) spread.deviation = std::sqrt(squares / static_cast<double>(values.size() - 1));
  return spread;
}

}  // namespace snug::materials
