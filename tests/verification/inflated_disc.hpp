// What is read off a disc that a pressure has blown up.
#pragma once

#include "tests/verification/membrane_scene.hpp"

namespace snug::tests {

/// A disc at rest in its rim, answers in its own units.
struct Inflated {
  double height, pole_stretch;
  double edge_tension, edge_slope;  ///< N/m per current length; rad
};

/// Stretch along the innermost edge of length h at its two Gauss points, where quadratic elements know the derivative
/// along an edge best; l0 + c r^2 through both, taken to the pole.
inline double pole_stretch(const Eigen::Vector3d& pole, const Eigen::Vector3d& half, const Eigen::Vector3d& end, double h) {
  const auto stretch = [&](double s) { return ((4 * s - 3) * pole + (4 - 8 * s) * half + (4 * s - 1) * end).norm() / h; };
  const double near = 0.5 - std::sqrt(1.0 / 12.0), far = 1.0 - near;
  return (far * far * stretch(near) - near * near * stretch(far)) / (far * far - near * near);
}

/// The rim's forces add up to tension times rim length along the meridian's tangent.
template <class Reactions, class Place>
void add_rim(const Reactions& reactions, const Place& place, double radius, Inflated& answer) {
  Plane pull = Plane::Zero();
  for (const auto& [node, f] : reactions) {
    const Plane x = place(node);
    pull += Plane(f.template head<2>().dot(x.normalized()), -f.z());
  }
  answer.edge_tension = pull.norm() / (0.5 * std::numbers::pi * radius);
  answer.edge_slope = std::atan2(pull.y(), pull.x());
}

}  // namespace snug::tests
