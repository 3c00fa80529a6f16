// One homogeneously deformed point: what a law answers in the classical tests, without mesh and element.
#pragma once

#include <optional>

#include "materials/laws/solid_law.hpp"

namespace snug::materials {

/// The tests. `stretch` is lambda_1, in shear the amount of shear.
///   uniaxial:     lambda_1 = stretch, the sides free
///   equibiaxial:  lambda_1 = lambda_2 = stretch, the third direction free
///   planar:       lambda_1 = stretch, lambda_2 = 1, the third direction free
///   shear:        F12 = stretch, all else held
///   confined:     lambda_1 = stretch, the sides held (oedometer)
enum class Loading { uniaxial, equibiaxial, planar, shear, confined };

struct PointState {
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  double J = 1.0;
  double lateral = 1.0;  ///< stretch of the third direction
  Eigen::Matrix3d first_piola = Eigen::Matrix3d::Zero(), cauchy = Eigen::Matrix3d::Zero();  ///< Pa
  /// The component that drives the test: 11, in shear 12. Pa.
  double nominal_stress = 0.0, cauchy_stress = 0.0;
};

/// The state at `stretch` > 0 (any amount in shear). The free stretch is found by Newton to 1e-12 of itself; nothing
/// when it is not found: the law has no stable state there.
std::optional<PointState> one_point(const SolidLaw& law, Loading loading, double stretch);

}  // namespace snug::materials
