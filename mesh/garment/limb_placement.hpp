// A sewn garment put round a limb with the least distortion.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "cases/input/garment_spec.hpp"
#include "mesh/body/limb.hpp"
#include "mesh/garment/garment_fit.hpp"
#include "mesh/pattern/sewn_mesh.hpp"

namespace snug::mesh {

struct LimbPlacement {
  std::vector<Eigen::Vector3d> placed;  ///< every node of the sewn mesh, m; the same for nodes that become one
  GarmentFit fit;
  double stand_off = 0.0;               ///< m, where it is wider than the limb; 0: nowhere
  double least_stretch = 1.0, largest_stretch = 1.0;  ///< principal stretches of the triangles between vertices
};

/// Lays the chart of the garment (`tube_chart`) round the limb, heights by lengths along the limb and turns by lengths round it, its
/// lowest point at `spec.position`; `lift` (m) off the skin, farther where it is wider. Then the vertices slide over that surface until the pieces are least
/// distorted (`slide`; after Liu et al., "A local/global approach to mesh parameterization", Symp. Geometry Processing 2008, for a map
/// onto a surface), while the garment as a whole neither turns nor moves along the limb.
/// Throws input::InputError where it reaches beyond the limb, or is stretched so that no homotopy starts from there (0.3 to 3).
LimbPlacement place_on_limb(const SewnMesh& sewn, const input::GarmentSpec& spec, const Limb& limb, double lift);

}  // namespace snug::mesh
