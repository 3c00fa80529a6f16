#include "solver/scene/hem_folds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace snug::solver {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

double mean_height(const std::vector<int>& nodes, const std::vector<Vector3d>& places) {
  double sum = 0.0;
  for (const int node : nodes) sum += places[node].z();
  return nodes.empty() ? std::numeric_limits<double>::max() : sum / static_cast<double>(nodes.size());
}

/// Largest distance from the middle in each sector that has a node, in order round it.
std::vector<double> distances_round(const std::vector<int>& nodes, const std::vector<Vector3d>& places, const Vector2d& middle) {
  constexpr int sectors = 72;
  std::vector<double> distance(sectors, -1.0);
  for (const int node : nodes) {
    const Vector2d arm = places[node].head<2>() - middle;
    const double turn = 0.5 + std::atan2(arm.y(), arm.x()) / (2.0 * std::numbers::pi);
    double& there = distance[std::min(sectors - 1, static_cast<int>(turn * sectors))];
    there = std::max(there, arm.norm());
  }
  std::vector<double> known;
  for (const double one : distance)
    if (one >= 0.0) known.push_back(one);
  return known;
}

}  // namespace

int crests(const std::vector<double>& distances, double least) {
  // From the deepest valley round: a crest counts once the line has fallen by `least` from it and had risen by as much before.
  const std::size_t count = distances.size();
  if (count < 3) return 0;
  const auto start = static_cast<std::size_t>(std::min_element(distances.begin(), distances.end()) - distances.begin());
  int found = 0;
  double low = distances[start], high = low;
  bool rising = false;
  for (std::size_t n = 1; n <= count; ++n) {
    const double d = distances[(start + n) % count];
    if (rising) {
      high = std::max(high, d);
      if (high - d >= least) ++found, rising = false, low = d;
    } else {
      low = std::min(low, d);
      if (d - low >= least) rising = true, high = d;
    }
  }
  return found;
}

HemFolds hem_folds(const mesh::GarmentMesh& garment, const std::vector<Vector3d>& places) {
  const auto lowest = std::min_element(garment.edges.begin(), garment.edges.end(), [&](const auto& a, const auto& b) {
    return mean_height(a.second, places) < mean_height(b.second, places);
  });
  HemFolds folds;
  if (lowest == garment.edges.end() || lowest->second.empty()) return folds;
  folds.edge = lowest->first, folds.height = mean_height(lowest->second, places);
  Vector2d middle = Vector2d::Zero();
  for (const int node : lowest->second) middle += places[node].head<2>() / static_cast<double>(lowest->second.size());
  folds.count = crests(distances_round(lowest->second, places, middle), least_fold);
  folds.least = std::numeric_limits<double>::max();
  for (const int node : lowest->second) {
    const double distance = (places[node].head<2>() - middle).norm();
    folds.least = std::min(folds.least, distance), folds.largest = std::max(folds.largest, distance);
    folds.mean += distance / static_cast<double>(lowest->second.size());
  }
  return folds;
}

}  // namespace snug::solver
