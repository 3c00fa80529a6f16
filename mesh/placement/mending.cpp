#include "mesh/placement/mending.hpp"

#include <algorithm>
#include <limits>
#include <numbers>

#include "mesh/placement/acceptance.hpp"

namespace snug::mesh {

namespace {

constexpr double push = 0.0007;  // m
constexpr double sharpest_fold = 140.0 * std::numbers::pi / 180.0, least_stretch = 0.33, widened_to = 0.4;
constexpr int most_rounds = 20;

void make_unique(std::vector<int>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

std::vector<int> corners_of(const ClothTriangles& cloth, const std::vector<int>& triangles) {
  std::vector<int> nodes;
  for (const int t : triangles) nodes.insert(nodes.end(), cloth.nodes[t].begin(), cloth.nodes[t].end());
  make_unique(nodes);
  return nodes;
}

std::vector<int> folded(const ClothParticles& cloth) {
  std::vector<int> result;
  for (const auto& [a, b] : folds(cloth.triangles(), cloth.places(), sharpest_fold))
    result.push_back(a), result.push_back(b);
  make_unique(result);
  return result;
}

std::vector<int> squeezed(const ClothParticles& cloth, double least) {
  std::vector<int> result;
  const auto stretches = principal_stretches(cloth.triangles(), cloth.places());
  for (std::size_t t = 0; t < stretches.size(); ++t)
    if (stretches[t][1] < least) result.push_back(static_cast<int>(t));
  return result;
}

}  // namespace

Mended mend(ClothParticles& cloth, double clearance, const DressForm& form) {
  Mended mended;
  std::vector<Eigen::Vector3d> best;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (; mended.rounds <= most_rounds; ++mended.rounds) {
    const std::vector<int> bent = folded(cloth), narrow = squeezed(cloth, least_stretch),
                           inside = crossing_triangles(cloth.triangles(), cloth.places(), form);
    const std::size_t faults = bent.size() + narrow.size() + inside.size();
    if (faults < fewest) fewest = faults, best = cloth.places();
    if (fewest == 0 || mended.rounds == most_rounds) break;
    mended.pushed_out += static_cast<int>(inside.size()), mended.smoothed += static_cast<int>(bent.size());
    mended.widened += static_cast<int>(narrow.size());
    cloth.smooth(corners_of(cloth.triangles(), bent), clearance, form.distance);
    for (int sweep = 0; sweep < 4; ++sweep)
      cloth.widen(squeezed(cloth, widened_to), widened_to, clearance, form.distance);
    for (const int n : corners_of(cloth.triangles(), inside))
      cloth.places()[n] += push * form.distance.at(cloth.places()[n]).direction;
  }
  cloth.places() = best;
  return mended;
}

}  // namespace snug::mesh
