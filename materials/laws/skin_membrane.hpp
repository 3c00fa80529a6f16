// Skin as an incompressible neo-Hookean membrane of rest thickness t without bending stiffness:
//   W = t mu/2 (C11 + C22 + 1/det C - 3)  per rest area,
// C the metric of the deformed surface in an orthonormal frame of the rest surface; 1/det C is the squared stretch
// through the thickness. Source: Adkins & Rivlin, Phil. Trans. R. Soc. A 244 (1952) 505-531.
#pragma once

#include "materials/laws/response.hpp"

namespace snug::materials {

struct SkinMembrane {
  double shear_modulus = 0.0;  ///< Pa
  double thickness = 0.0;      ///< m

  /// `metric`: C11, C22, C12 with det C > 0. Force and tangent are derivatives by E11, E22, 2 E12 where C = 1 + 2 E.
  MembraneResponse at(const Eigen::Vector3d& metric) const;
};

inline MembraneResponse SkinMembrane::at(const Eigen::Vector3d& metric) const {
  const double c11 = metric[0], c22 = metric[1], c12 = metric[2];
  const double det = c11 * c22 - c12 * c12;
  const double k = shear_modulus * thickness;
  const double inverse2 = 1.0 / (det * det);
  const double inverse3 = 4.0 * inverse2 / det;

  MembraneResponse r;
  r.energy = 0.5 * k * (c11 + c22 + 1.0 / det - 3.0);
  r.force = k * Eigen::Vector3d(1.0 - c22 * inverse2, 1.0 - c11 * inverse2, c12 * inverse2);
  const Eigen::Vector3d gradient(c22, c11, -c12);  // half of d(det)/dE
  r.tangent = k * inverse3 * gradient * gradient.transpose();
  r.tangent(0, 1) -= 2.0 * k * inverse2;
  r.tangent(1, 0) -= 2.0 * k * inverse2;
  r.tangent(2, 2) += k * inverse2;
  return r;
}

}  // namespace snug::materials
