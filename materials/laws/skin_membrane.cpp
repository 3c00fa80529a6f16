#include "materials/laws/skin_membrane.hpp"

#include <cmath>

#include "materials/laws/tensor.hpp"

namespace snug::materials {

// With F the upper triangular root of diag(C, C33), S = F^-1 P and B = C^-1 (2 x 2), the chain rule through
// C33(C) = 1/det C, dC33 = -C33 B:dC, gives for the strain directions M_m of E11, E22, 2 E12 and b_m = B:M_m:
//   force_m    = S:M_m - S33 C33 b_m
//   tangent_mn = K_mn - C33 (K_m4 b_n + b_m K_4n) + C33^2 K_44 b_m b_n + 2 S33 C33 (b_m b_n + M_m:(B M_n B))
// where K = D^T (A - delta (x) S) D is the material tangent along D_m = F^-T M_m, M_4 the direction of E33.
MembraneResponse SkinMembrane::at(const Eigen::Vector3d& metric) const {
  const double c11 = metric[0], c22 = metric[1], c12 = metric[2];
  const double det = c11 * c22 - c12 * c12, c33 = 1.0 / det;
  Eigen::Matrix3d F = Eigen::Matrix3d::Zero();
  F(0, 0) = std::sqrt(c11);
  F(0, 1) = c12 / F(0, 0);
  F(1, 1) = std::sqrt(det) / F(0, 0);
  F(2, 2) = std::sqrt(c33);
  Eigen::Matrix3d inverse = Eigen::Matrix3d::Zero();
  inverse(0, 0) = 1.0 / F(0, 0);
  inverse(1, 1) = 1.0 / F(1, 1);
  inverse(0, 1) = -F(0, 1) * inverse(0, 0) * inverse(1, 1);
  inverse(2, 2) = 1.0 / F(2, 2);

  const SolidResponse solid = isochoric(law, F);
  const Eigen::Matrix3d S = inverse * solid.stress;
  Eigen::Matrix<double, 9, 4> D, SD;
  for (int m = 0; m < 4; ++m) {
    Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
    if (m == 2)
      M(0, 1) = M(1, 0) = 0.5;
    else
      M(m == 3 ? 2 : m, m == 3 ? 2 : m) = 1.0;
    const Eigen::Matrix3d d = inverse.transpose() * M;
    D.col(m) = components(d);
    SD.col(m) = components(d * S);
  }
  const Eigen::Matrix4d K = D.transpose() * (solid.tangent * D) - D.transpose() * SD;

  const double b11 = c22 / det, b22 = c11 / det, b12 = -c12 / det, s = S(2, 2) * c33;
  const Eigen::Vector3d b(b11, b22, b12);
  Eigen::Matrix3d BMB;                     // M_m:(B M_n B)
  BMB << b11 * b11, b12 * b12, b11 * b12,  //
      b12 * b12, b22 * b22, b22 * b12,     //
      b11 * b12, b22 * b12, 0.5 * (b11 * b22 + b12 * b12);
  const Eigen::Vector3d through = c33 * K.topRightCorner<3, 1>();

  MembraneResponse r;
  r.energy = thickness * solid.energy;
  r.force = thickness * (Eigen::Vector3d(S(0, 0), S(1, 1), S(0, 1)) - s * b);
  r.tangent = thickness * (K.topLeftCorner<3, 3>() - through * b.transpose() - b * through.transpose() +
                           c33 * c33 * K(3, 3) * b * b.transpose() + 2.0 * s * (b * b.transpose() + BMB));
  return r;
}

}  // namespace snug::materials
