// What a law answers at one point.
#pragma once

#include <Eigen/Core>

namespace snug::materials {

/// An energy at one deformation gradient F: the isochoric part of a law or the whole of it. First Piola stress P =
/// dW/dF; tangent A = d2W/dF2 with row and column index 3 i + J of the component F_iJ (row-major), major-symmetric.
/// Units Pa (energy J/m3 of the reference).
struct SolidResponse {
  double energy = 0.0;
  Eigen::Matrix3d stress;
  Eigen::Matrix<double, 9, 9> tangent;
};

/// U(J), U'(J), U''(J) in Pa.
struct VolumetricResponse {
  double energy = 0.0, pressure = 0.0, modulus = 0.0;
};

/// A surface: energy per rest area (J/m2), force (N/m; derivative by E11, E22, 2 E12: S11, S22, S12 of the second
/// Piola-Kirchhoff force per rest length) and tangent (N/m), symmetric.
struct MembraneResponse {
  double energy = 0.0;
  Eigen::Vector3d force = Eigen::Vector3d::Zero();
  Eigen::Matrix3d tangent = Eigen::Matrix3d::Zero();
  enum class State { taut, wrinkled, slack } state = State::taut;
};

}  // namespace snug::materials
