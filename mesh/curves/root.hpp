// A root of a function of one variable between two places where its sign differs.
#pragma once

#include <cmath>

namespace snug::mesh::curves {

/// A place and the value there.
struct Sample {
  double at, value;
};

/// Regula falsi with the Illinois step (Dowell & Jarratt, BIT 11 (1971) 168): secants within the bracket, the value of the end that stays halved.
/// `low.value` <= 0 <= `high.value`. It ends where |f| <= `small` or the bracket is no longer than `narrow`.
template <class F>
double bracketed_root(const F& f, Sample low, Sample high, double small, double narrow) {
  double at = std::abs(low.value) < std::abs(high.value) ? low.at : high.at;
  for (int i = 0; i < 60 && high.at - low.at > narrow; ++i) {
    if (high.value == low.value) break;
    at = (low.at * high.value - high.at * low.value) / (high.value - low.value);
    const double here = f(at);
    if (std::abs(here) <= small) break;
    if (here < 0.0) low = {at, here}, high.value *= 0.5;
    else high = {at, here}, low.value *= 0.5;
  }
  return at;
}

}  // namespace snug::mesh::curves
