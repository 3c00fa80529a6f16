// Splines through points in the plane.
#pragma once

#include <Eigen/Core>

#include <vector>

#include "mesh/pattern/curve.hpp"

namespace snug::mesh {

/// The cubic spline through at least two points, twice continuously differentiable over the length of the chords, with
/// no curvature at its ends (natural).
Curve cubic_spline(const std::vector<Eigen::Vector2d>& points);

/// The quadratic spline (4.1) of the source: P(t) = P_i + m_i (t - t_i) + M_i (t - t_i)^2 / 2 from the middle of one
/// chord to the middle of the next, t the length of the chords; once continuously differentiable. The source gives no
/// end conditions: there is no curvature at the ends here, as with the cubic one.
Curve quadratic_spline(const std::vector<Eigen::Vector2d>& points);

}  // namespace snug::mesh
