// Fabrics of every kind of curve, for tests that must hold for all of them.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "materials/fabric/fabric.hpp"

namespace snug::testing {

inline materials::Fabric fabric(materials::TensionCurve warp, materials::TensionCurve weft, double poisson,
                                double shear) {
  materials::Fabric f;
  f.warp = warp;
  f.weft = weft;
  f.coupling = poisson * std::min(warp.smallest_stiffness(), weft.smallest_stiffness());
  f.shear = shear;
  return f;
}

/// Linear (isotropic, strongly orthotropic), cubic, KES convex (LT < 1), straight (LT = 1), concave (LT > 1) and mixed.
inline std::vector<std::pair<const char*, materials::Fabric>> all_fabrics() {
  using materials::TensionCurve;
  const auto suiting = TensionCurve::kes(0.7, 12 * 0.980665, 500 * 0.980665);
  const auto knit = TensionCurve::kes(1.0, 10.02 * 0.980665, 46.3 * 0.980665);
  const auto concave = TensionCurve::kes(1.14, 8.79 * 0.980665, 49.03325);
  return {{"linear isotropic", fabric(TensionCurve::linear(1000), TensionCurve::linear(1000), 0.3, 350)},
          {"linear orthotropic", fabric(TensionCurve::linear(1000), TensionCurve::linear(300), 0.3, 50)},
          {"linear, weak in shear", fabric(TensionCurve::linear(5000), TensionCurve::linear(2000), 0.0, 20)},
          {"cubic", fabric(TensionCurve::cubic(100, 2000, 0.5), TensionCurve::cubic(200, 500, 0.5), 0.2, 40)},
          {"KES suiting", fabric(suiting, suiting, 0.2, 45)},
          {"KES knit", fabric(knit, knit, 0.2, 37)},
          {"KES concave", fabric(concave, concave, 0.2, 70)},
          {"KES mixed", fabric(suiting, knit, 0.5, 45)}};
}

/// Green strain (E11, E22, 2 E12) of a random admissible metric (1 + 2 E positive definite), entries up to `size`.
inline Eigen::Vector3d random_strain(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (;;) {
    const Eigen::Vector3d E(size * uniform(random), size * uniform(random), 2.0 * size * uniform(random));
    const double c11 = 1 + 2 * E[0], c22 = 1 + 2 * E[1];
    if (c11 > 0.02 && c22 > 0.02 && c11 * c22 - E[2] * E[2] > 0.02) return E;
  }
}

}  // namespace snug::testing
