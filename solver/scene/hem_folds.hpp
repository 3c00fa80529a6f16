// The folds in which a hem hangs.
#pragma once

#include <string>
#include <vector>

#include "mesh/garment/garment_mesh.hpp"

namespace snug::solver {

struct HemFolds {
  std::string edge;
  int count = 0;             ///< crests: places farther from the middle than both valleys beside them by `least_fold` at least
  double least = 0.0, mean = 0.0, largest = 0.0;  ///< m, distances of the edge from its middle, seen from above
  double height = 0.0;       ///< m, mean of the edge
};

/// A crest stands out by that much, m.
inline constexpr double least_fold = 0.005;

/// Crests of a closed line round its middle: local maxima of the distances (in order round it) that both valleys beside them fall
/// short of by `least` (their prominence).
int crests(const std::vector<double>& distances, double least);

/// The lowest closed edge of a garment as it lies (`places`, m, of its pattern nodes), by 5-degree sectors round its middle.
HemFolds hem_folds(const mesh::GarmentMesh& garment, const std::vector<Eigen::Vector3d>& places);

}  // namespace snug::solver
