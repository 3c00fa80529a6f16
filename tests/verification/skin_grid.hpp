// A closed skin without a body: a regular grid of biquadratic facets round the z axis.
#pragma once

#include <functional>
#include <numbers>

#include "mesh/body/body_mesh.hpp"

namespace snug::tests {

/// `at` (angle, height) -> place, m; heights from -half to half, `turn` of a half cell added to the angles.
inline mesh::BodyMesh skin_grid(int around, int along, double half, double cell, double turn,
                                const std::function<Eigen::Vector3d(double, double)>& at) {
  mesh::BodyMesh body;
  for (int j = 0; j <= 2 * along; ++j)
    for (int i = 0; i < 2 * around; ++i)
      body.nodes.push_back(at(std::numbers::pi * (i + turn) / around, half * (j - along) / along));
  for (int j = 0; j < along; ++j)
    for (int i = 0; i < around; ++i) {
      std::array<int, 9> facet;
      for (int n = 0; n < 9; ++n) facet[n] = 2 * around * (2 * j + n / 3) + (2 * i + n % 3) % (2 * around);
      body.skin_facets.push_back(facet);
    }
  body.node_location.assign(body.nodes.size(), -1);
  body.mean_skin_cell = cell;
  return body;
}

}  // namespace snug::tests
