// Tier L0: the law of Laplace on the undeformed skin, p = T1 k1 + T2 k2.
#pragma once

#include <vector>

#include "mesh/garment/garment_fit.hpp"
#include "solver/scene/model.hpp"
#include "solver/scene/run.hpp"

namespace snug::solver {

/// Pressure (Pa) at the nodes of the mesh that the garment covers, 0 elsewhere, and its mean over the covered skin.
struct LaplacePressure {
  std::vector<double> pressure;
  std::vector<char> covered;
  double mean = 0.0;
};

/// Cauchy tensions (N/m) of a garment at a height: round the body and along it, at a hoop stretch of `stretch` and an axial stretch of 1. Where several fabrics
/// lie side by side at that height they bear one tension round the body, and `stretch` is that of all together.
Eigen::Vector2d tensions(const GarmentModel& garment, const mesh::FitRow& row, bool warp_along, double stretch);

/// The garment is taken as axially held (axial stretch 1) and stretched to the girth at each height, sliding freely. `give`: the
/// share by which the body gives way under it; girths are that much smaller and curvatures around larger.
LaplacePressure laplace_pressure(const mesh::GarmentFit& fit, const GarmentModel& garment, const mesh::Limb& limb,
                                 const mesh::BodyMesh& body, double give = 0.0);
/// Of all garments together: where several cover the skin their pressures add up. Nothing on a body that branches.
LaplacePressure laplace_pressure(const std::vector<GarmentModel>& garments, const Meshes& meshes, double give = 0.0);

}  // namespace snug::solver
