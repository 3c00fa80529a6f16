#include "solver/app/suggestion.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>

namespace snug::app {

namespace {

using Pressures = std::map<std::string, double>;

constexpr int most_rounds = 6;
constexpr double same_size = 0.5e-3, near_enough = 0.01, far_off = 0.05;

double miss(const std::vector<Target>& targets, const Pressures& pressures) {
  double squares = 0.0;
  for (const Target& target : targets) squares += std::pow(pressures.at(target.location) / target.pressure - 1.0, 2);
  return std::sqrt(squares / static_cast<double>(targets.size()));
}

double sum(const std::vector<Target>& targets, const Pressures& pressures) {
  double all = 0.0;
  for (const Target& target : targets) all += pressures.at(target.location);
  return all;
}

/// Pressures between sizes that are known: their logarithms go straight, or where there is none at one end they themselves.
Pressures between(const std::vector<Target>& targets, const std::map<double, Pressures>& known, double size) {
  auto high = known.upper_bound(size);
  if (high == known.end()) --high;
  const auto low = std::prev(high);
  const double share = (size - low->first) / (high->first - low->first);
  Pressures pressures;
  for (const Target& target : targets) {
    const double a = low->second.at(target.location), b = high->second.at(target.location);
    pressures[target.location] = a > 0.0 && b > 0.0 ? std::pow(a, 1.0 - share) * std::pow(b, share) : (1.0 - share) * a + share * b;
  }
  return pressures;
}

double best_between(const std::vector<Target>& targets, const std::map<double, Pressures>& known) {
  constexpr int steps = 4000;
  const double from = known.begin()->first, to = known.rbegin()->first;
  double best = from, least = -1.0;
  for (int k = 0; k <= steps; ++k) {
    const double size = from + (to - from) * k / steps, off = miss(targets, between(targets, known, size));
    if (least < 0.0 || off < least) best = size, least = off;
  }
  return best;
}

}  // namespace

namespace {

using Known = std::map<double, Pressures>;

Known::const_iterator best_of(const std::vector<Target>& targets, const Known& known) {
  return std::min_element(known.begin(), known.end(), [&](const auto& a, const auto& b) { return miss(targets, a.second) < miss(targets, b.second); });
}

bool has(const Known& known, double size) {
  const auto near = known.lower_bound((1.0 - same_size) * size);
  return near != known.end() && near->first <= (1.0 + same_size) * size;
}

/// In the middle of the sizes on the side of `size` where the targets lie: tighter where its pressures are too small. Nothing at the end of what is known.
std::optional<double> halved(const std::vector<Target>& targets, const Known& known, double size) {
  const auto at = known.find(size);
  double over = 0.0;
  for (const Target& target : targets) over += at->second.at(target.location) / target.pressure - 1.0;
  if (over > 0.0 ? std::next(at) == known.end() : at == known.begin()) return std::nullopt;
  return 0.5 * (size + (over > 0.0 ? std::next(at) : std::prev(at))->first);
}

}  // namespace

Proposal best_size(const std::string& fabric, const std::vector<Target>& targets, double from, double to, const Guess& guess) {
  Known known;
  for (const double share : {0.0, 0.5, 1.0}) known[from + share * (to - from)] = guess(from + share * (to - from));
  for (int round = 0; round < most_rounds; ++round) {
    const double size = best_between(targets, known);
    if (has(known, size)) break;
    known[size] = guess(size);
    if (miss(targets, best_of(targets, known)->second) < near_enough) break;
    if (miss(targets, known[size]) < far_off) continue;
    if (const auto middle = halved(targets, known, size); middle && !has(known, *middle)) known[*middle] = guess(*middle);  // where pressures set in, nothing goes straight
  }
  const auto best = best_of(targets, known);
  constexpr double wider = 1.01;
  const double before = sum(targets, best->second), after = before > 0.0 ? sum(targets, guess(wider * best->first)) : 0.0;
  return {.fabric = fabric, .size = best->first, .pressures = best->second, .off = miss(targets, best->second), .per_percent = before > 0.0 ? 100.0 * (after / before - 1.0) : 0.0};
}

void rank(std::vector<Proposal>& proposals) {
  const auto grade = [](const Proposal& one) { return std::floor(100.0 * one.off); };
  std::stable_sort(proposals.begin(), proposals.end(), [&](const Proposal& a, const Proposal& b) {
    return grade(a) != grade(b) ? grade(a) < grade(b) : std::abs(a.per_percent) < std::abs(b.per_percent);
  });
}

}  // namespace snug::app
