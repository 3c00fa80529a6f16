// Gathered cloth: how far wrinkles can bring a sheet together.
#pragma once

#include <Eigen/Core>

#include "materials/laws/response.hpp"

namespace snug::materials {

/// Share of its area at rest below which gathered cloth resists.
constexpr double packed = 0.9;

/// Adds what gathered cloth resists with, for a sheet of that stiffness (N/m). With J = sqrt((1 + 2 E11)(1 + 2 E22) - (2 E12)^2),
/// the area over that at rest, below J0 = `packed`
///   W = k (J0 - J)^3 / (3 J0 J),   k = stiffness/100,
/// which grows without bound as J goes to 0. J is concave in the strain and W falls, convex, with J: the tangent stays positive
/// semidefinite. Gathered to half its area a knit of 200 N/m asks for some 1 N/m, gathered by a fifth for 0.03: about what folds of 10 to 20 mm bear
/// before they buckle, B (2 pi / length)^2 with a bending stiffness B of 3e-6 N m. A tension field shortens at no cost, and where cloth bends it
/// even gains by it, since b = n . x_,ij falls with the lengths: it falls together into one row of triangles, whose normals then mean nothing.
/// A membrane alone keeps the exact tension field: only cloth that bends resists so (terms/fabric_bending).
void add_packing(const Eigen::Vector3d& strain, double stiffness, MembraneResponse& response);

}  // namespace snug::materials
