// Tensile curves of cloth of particles in tests.
#pragma once

#include <cmath>

#include "mesh/particles/particle_sheet.hpp"

namespace snug::tests {

using mesh::Tensile, mesh::TensileCurve;

inline TensileCurve linear(double stiffness) {
  return [=](double stretch) {
    return Tensile{0.5 * stiffness * (stretch - 1.0) * (stretch - 1.0), stiffness * (stretch - 1.0), stiffness};
  };
}

/// T = Tm (exp(a e / em) - 1) / (exp(a) - 1), the kind of curve that a tensile test of KES has.
constexpr double most_tension = 490.0, most_strain = 0.3, curvature = 3.0;
inline TensileCurve exponential() {
  return [](double stretch) {
    const double rate = curvature / most_strain, factor = most_tension / std::expm1(curvature), strain = stretch - 1.0;
    return Tensile{factor * (std::expm1(rate * strain) / rate - strain), factor * std::expm1(rate * strain),
                   factor * rate * std::exp(rate * strain)};
  };
}

}  // namespace snug::tests
