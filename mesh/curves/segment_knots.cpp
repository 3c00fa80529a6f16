#include "mesh/curves/segment_knots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace snug::mesh::curves {

SegmentKnots::SegmentKnots(std::vector<double> u, std::vector<double> r) : u_(std::move(u)), r_(std::move(r)) {
  if (u_.size() != r_.size() || u_.empty() || u_.size() > highest_degree)
    throw std::invalid_argument(
        fmt::format("{} knots below and {} above; a segment of degree n has n of each, n from 1 to {}", u_.size(),
                    r_.size(), highest_degree));
  const auto finite = [](double knot) { return std::isfinite(knot); };
  if (!std::all_of(u_.begin(), u_.end(), finite) || !std::all_of(r_.begin(), r_.end(), finite))
    throw std::invalid_argument("a knot is no finite number");
  start_ = *std::max_element(u_.begin(), u_.end());
  end_ = *std::min_element(r_.begin(), r_.end());
  if (!(start_ < end_))
    throw std::invalid_argument(
        fmt::format("the knots below reach to {} and those above begin at {}; they must not meet", start_, end_));
  const int n = degree();
  slope_.assign(static_cast<std::size_t>(n) * n, 0.0);
  for (int l = 1; l <= n; ++l)
    for (int i = 0; i <= n - l; ++i) slope_[table(i, l)] = 1.0 / (u_[i + l - 1] - r_[i]);
}

SegmentKnots SegmentKnots::bezier(int degree, double start, double end) {
  const std::size_t n = std::max(degree, 0);
  return {std::vector<double>(n, start), std::vector<double>(n, end)};
}

bool SegmentKnots::sorted() const {
  return std::is_sorted(u_.begin(), u_.end()) && std::is_sorted(r_.begin(), r_.end());
}

Bases SegmentKnots::bases(double t, int order, int first) const {
  const int n = degree(), steps = n - first;
  if (order > steps) return Bases::Zero(steps + 1);
  Bases c = Bases::Zero(steps + 1);
  c[0] = 1.0;
  // The steps backwards: what D_{0,n} takes of each D_{i,l-1}.
  for (int l = n, factor = steps; l > first; --l, --factor) {
    const bool differ = n - l < order;
    double from_left = 0.0;  // what D_{i,l-1} gives to D_{i-1,l}
    for (int i = 0; i <= n - l; ++i) {
      const double a = slope(i, l), share = c[i];
      const double own = differ ? factor * a * share : a * (t - r_[i]) * share;
      c[i] = own + from_left;
      from_left = differ ? -own : share - own;
    }
    c[n - l + 1] = from_left;
  }
  return c;
}

SegmentKnots SegmentKnots::remaining(int steps) const {
  if (steps < 0 || steps >= degree())
    throw std::invalid_argument(fmt::format("{} of {} steps leave no curve", steps, degree()));
  return {{u_.begin() + steps, u_.end()}, {r_.begin(), r_.end() - steps}};
}

}  // namespace snug::mesh::curves
