#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "materials/fabric/fabric.hpp"

namespace snug::materials {
namespace {

constexpr double stiffness_floor = 0.05;  // of the initial stiffness: where a softening curve is cut

double engineering_strain(double green_strain) {
  return 2.0 * green_strain / (1.0 + std::sqrt(1.0 + 2.0 * green_strain));  // keeps the digits of sqrt(1 + 2E) - 1
}
double green_strain(double engineering) { return engineering * (1.0 + 0.5 * engineering); }

// g(x) = (e^x - 1 - x)/(x (e^x - 1)) = 1/x - 1/(e^x - 1), falling from 1/2 at x = 0; series where the two terms cancel.
double linearity_half(double x) {
  if (x < 0.3) {
    const double q = x * x;
    return 0.5 - x / 12.0 * (1.0 - q / 60.0 * (1.0 - q / 42.0 * (1.0 - q / 40.0)));
  }
  return 1.0 / x - 1.0 / std::expm1(x);
}

// Integral, value and slope over e of F(e) = k0 (e^(a e) - 1)/a.
TensionCurve::Value exponential(double k0, double a, double e) {
  const double y = a * e;
  if (std::abs(y) < 1e-3)  // the quotients cancel: Taylor to y^4
    return {k0 * e * e * (0.5 + y * (1.0 / 6.0 + y * (1.0 / 24.0 + y / 120.0))),
            k0 * e * (1.0 + y * (0.5 + y * (1.0 / 6.0 + y / 24.0))), k0 * std::exp(y)};
  const double growth = std::expm1(y);
  return {k0 * (growth - y) / (a * a), k0 * growth / a, k0 * (growth + 1.0)};
}

TensionCurve::Value cubic_law(double k1, double k3, double e) {
  const double q = e * e;
  return {q * (0.5 * k1 + 0.25 * k3 * q), e * (k1 + k3 * q), k1 + 3.0 * k3 * q};
}

}  // namespace

// x = a em of the exponential curve. g(-x) = 1 - g(x) gives LT > 1; bisection because it runs once a curve.
double exponent_of_linearity(double linearity) {
  const double target = 0.5 * std::min(linearity, 2.0 - linearity);
  double low = 0.0, high = 1.0 / target;
  for (int k = 0; k < 200 && high - low > 1e-16 * high; ++k) {
    const double middle = 0.5 * (low + high);
    (linearity_half(middle) > target ? low : high) = middle;
  }
  const double x = 0.5 * (low + high);
  return linearity == 1.0 ? 0.0 : (linearity < 1.0 ? x : -x);
}

// dW = F de = S dE because dE = (1 + e) de, so the energy needs no change; S' = (F' - S)/(1 + e)^2.
TensionCurve::Value TensionCurve::inside(double green) const {
  const double e = engineering_strain(green);
  const Value nominal = kind_ == Kind::kes ? exponential(p0_, p1_, e) : kind_ == Kind::cubic ? cubic_law(p0_, p1_, e) : between_knots(e);
  const double stretch = 1.0 + e;
  const double force = nominal.force / stretch;
  return {nominal.energy, force, (nominal.stiffness - force) / (stretch * stretch)};
}

TensionCurve::Value TensionCurve::at(double green) const {
  if (kind_ == Kind::linear || green <= 0.0)
    return {0.5 * initial_stiffness_ * green * green, initial_stiffness_ * green, initial_stiffness_};
  if (green < end_) return inside(green);
  const double beyond = green - end_;
  return {at_end_.energy + beyond * (at_end_.force + 0.5 * at_end_.stiffness * beyond),
          at_end_.force + at_end_.stiffness * beyond, at_end_.stiffness};
}

// Walks the data once: finds the smallest slope and cuts the range where the curve has become too soft.
TensionCurve::TensionCurve(Kind kind, double p0, double p1, double data_end, std::vector<Knot> knots)
    : kind_(kind), knots_(std::move(knots)), p0_(p0), p1_(p1), end_(green_strain(data_end)), initial_stiffness_(p0), smallest_stiffness_(p0) {
  constexpr int samples = 2000;
  const double step = data_end / samples;
  int softest = 0;
  for (int k = 1; k <= samples; ++k) {
    const double slope = inside(green_strain(k * step)).stiffness;
    if (slope < stiffness_floor * p0) {
      end_ = green_strain((k - 1) * step);
      break;
    }
    if (slope < smallest_stiffness_) smallest_stiffness_ = slope, softest = k;
  }
  double low = std::max(0, softest - 1) * step, high = std::min((softest + 1) * step, engineering_strain(end_));
  while (high - low > 1e-7 * step) {  // the slope has one minimum between the neighbours of the softest sample
    const double third = (high - low) / 3.0;
    const double left = inside(green_strain(low + third)).stiffness,
                 right = inside(green_strain(high - third)).stiffness;
    (left < right ? high : low) += left < right ? -third : third;
    smallest_stiffness_ = std::min({smallest_stiffness_, left, right});
  }
  at_end_ = inside(end_);
  smallest_stiffness_ = std::min(smallest_stiffness_, at_end_.stiffness);
}

// Hermite's cubic on [0, h]: F = F0 + m0 t + (3 d - 2 m0 - m1) t^2/h + (m0 + m1 - 2 d) t^3/h^2, d the chord's slope.
TensionCurve::Value TensionCurve::between_knots(double e) const {
  auto next = std::upper_bound(knots_.begin(), knots_.end(), e, [](double at, const Knot& knot) { return at < knot.strain; });
  next = std::clamp(next, knots_.begin() + 1, knots_.end() - 1);
  const Knot &a = *(next - 1), &b = *next;
  const double h = b.strain - a.strain, t = e - a.strain, d = (b.force - a.force) / h;
  const double c2 = (3.0 * d - 2.0 * a.slope - b.slope) / h, c3 = (a.slope + b.slope - 2.0 * d) / (h * h);
  return {a.energy + t * (a.force + t * (a.slope / 2.0 + t * (c2 / 3.0 + t * c3 / 4.0))), a.force + t * (a.slope + t * (c2 + t * c3)),
          a.slope + t * (2.0 * c2 + 3.0 * t * c3)};
}

TensionCurve TensionCurve::through(const std::vector<double>& strain, const std::vector<double>& force) {
  std::vector<Knot> knots;
  for (std::size_t k = 0; k < strain.size(); ++k) {
    if (k == 0 ? strain[0] != 0.0 || force[0] != 0.0 : !(strain[k] > strain[k - 1] && force[k] > force[k - 1]))
      throw std::invalid_argument("a curve through points needs strains and forces that rise from 0");
    knots.push_back({strain[k], 0.0, force[k], 0.0});
  }
  if (knots.size() < 2) throw std::invalid_argument("a curve through points needs two of them");
  const auto chord = [&](std::size_t k) { return (force[k + 1] - force[k]) / (strain[k + 1] - strain[k]); };
  const std::size_t last = knots.size() - 1;
  for (std::size_t k = 1; k < last; ++k) {  // harmonic means, weighted by the intervals, keep the cubics from falling
    const double before = strain[k] - strain[k - 1], after = strain[k + 1] - strain[k], w1 = 2.0 * after + before, w2 = after + 2.0 * before;
    knots[k].slope = (w1 + w2) / (w1 / chord(k - 1) + w2 / chord(k));
  }
  knots[0].slope = chord(0), knots[last].slope = chord(last - 1);
  for (std::size_t k = 0; k < last; ++k) {
    const double h = strain[k + 1] - strain[k];
    knots[k + 1].energy = knots[k].energy + 0.5 * h * (force[k] + force[k + 1]) + h * h / 12.0 * (knots[k].slope - knots[k + 1].slope);
  }
  const double initial = knots[0].slope, end = strain[last];
  return TensionCurve(Kind::points, initial, 0.0, end, std::move(knots));
}

TensionCurve TensionCurve::linear(double stiffness) {
  TensionCurve curve;
  curve.initial_stiffness_ = curve.smallest_stiffness_ = stiffness;
  curve.end_ = std::numeric_limits<double>::infinity();
  return curve;
}

TensionCurve TensionCurve::kes(double linearity, double work, double maximum_force) {
  if (!(linearity > 0.0 && linearity < 2.0 && work > 0.0 && maximum_force > 0.0))
    throw std::invalid_argument("KES curve needs 0 < LT < 2, WT > 0 and Fm > 0");
  const double em = 2.0 * work / (linearity * maximum_force);
  const double x = exponent_of_linearity(linearity);
  const double initial = maximum_force / em * (x == 0.0 ? 1.0 : x / std::expm1(x));
  return TensionCurve(Kind::kes, initial, x / em, em);
}

TensionCurve TensionCurve::cubic(double k1, double k3, double data_end) {
  if (!(k1 > 0.0 && k3 >= 0.0 && data_end > 0.0))
    throw std::invalid_argument("cubic curve needs k1 > 0, k3 >= 0 and data_end > 0");
  return TensionCurve(Kind::cubic, k1, k3, data_end);
}

}  // namespace snug::materials
