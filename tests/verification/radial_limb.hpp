// The exact answer of a layered circular limb round a rigid bone in plane strain under an external pressure: the radial
// equilibrium equation, solved to eleven digits or more.
#pragma once

#include <cmath>
#include <functional>
#include <vector>

namespace snug::tests {

/// W = mu/2 (J^(-2/3) I1 - 3) + U(J); barrier: U = kappa/4 (J^2 - 1 - 2 ln J), quadratic: U = kappa/2 (J - 1)^2.
enum class Volumetric { barrier, quadratic };

struct RadialLayer {
  double inner = 0.0, outer = 0.0;  ///< m
  double shear_modulus = 0.0;       ///< Pa
  double poisson_ratio = 0.49;
};

struct RadialAnswer {
  double pressure = 0.0, displacement = 0.0;  ///< Pa; m, of the outer surface
};

/// Nominal radial and hoop stress at the stretches; axial stretch 1.
struct Nominal {
  double radial, hoop;
};

inline Nominal nominal_stress(const RadialLayer& layer, Volumetric law, double radial, double hoop) {
  const double mu = layer.shear_modulus, nu = layer.poisson_ratio;
  const double kappa = 2.0 * mu * (1.0 + nu) / (3.0 * (1.0 - 2.0 * nu));
  const double J = radial * hoop, third = (radial * radial + hoop * hoop + 1.0) / 3.0;
  const double pressure = law == Volumetric::quadratic ? kappa * (J - 1.0) : 0.5 * kappa * (J - 1.0 / J);
  const double m = mu * std::pow(J, -2.0 / 3.0);
  return {m * (radial - third / radial) + pressure * hoop, m * (hoop - third / hoop) + pressure * radial};
}

/// The radial stretch at which the nominal radial stress is `stress` (Newton, slope by differences).
inline double radial_stretch(const RadialLayer& layer, Volumetric law, double stress, double hoop, double guess) {
  for (int k = 0; k < 60; ++k) {
    const auto off = [&](double x) { return nominal_stress(layer, law, x, hoop).radial - stress; };
    const double step = off(guess) * 2e-6 / (off(guess + 1e-6) - off(guess - 1e-6));
    guess -= step;
    if (std::abs(step) < 1e-15) break;
  }
  return guess;
}

struct Radial {
  double r, stress;  ///< m, Pa: current radius and nominal radial stress
};

/// Marches r' = lr, P' = (Pt - P)/R outwards from the bone by Runge and Kutta's rule of fourth order.
inline Radial march(const std::vector<RadialLayer>& layers, Volumetric law, double bone_stress) {
  Radial y{layers.front().inner, bone_stress};
  double guess = 1.0;
  for (const RadialLayer& layer : layers) {
    constexpr int steps = 1000;
    const double h = (layer.outer - layer.inner) / steps;
    const auto slope = [&](double R, const Radial& at) {
      const double hoop = at.r / R;
      guess = radial_stretch(layer, law, at.stress, hoop, guess);
      return Radial{guess, (nominal_stress(layer, law, guess, hoop).hoop - at.stress) / R};
    };
    for (int n = 0; n < steps; ++n) {
      const double R = layer.inner + n * h;
      const auto ahead = [&](double t, const Radial& k) { return Radial{y.r + t * k.r, y.stress + t * k.stress}; };
      const Radial a = slope(R, y), b = slope(R + h / 2, ahead(h / 2, a)), c = slope(R + h / 2, ahead(h / 2, b)),
                   d = slope(R + h, ahead(h, c));
      y.r += h / 6 * (a.r + 2 * b.r + 2 * c.r + d.r);
      y.stress += h / 6 * (a.stress + 2 * b.stress + 2 * c.stress + d.stress);
    }
  }
  return y;
}

/// `load`: pressure (Pa) on the deformed outer surface of radius r (m). Shoots at its balance by the secant rule.
inline RadialAnswer solve_limb(const std::vector<RadialLayer>& layers, Volumetric law,
                               const std::function<double(double)>& load) {
  const double outer = layers.back().outer;
  const auto off = [&](double bone_stress, Radial& end) {
    end = march(layers, law, bone_stress);
    return end.stress + load(end.r) * end.r / outer;
  };
  Radial end{};
  double s0 = 0.0, f0 = off(s0, end), s1 = -load(outer), f1 = off(s1, end);
  for (int k = 0; k < 50 && std::abs(s1 - s0) > 1e-13 * std::abs(s1) && f1 != f0; ++k) {
    const double s2 = s1 - f1 * (s1 - s0) / (f1 - f0);
    s0 = s1, f0 = f1, s1 = s2, f1 = off(s1, end);
  }
  return {load(end.r), end.r - outer};
}

}  // namespace snug::tests
