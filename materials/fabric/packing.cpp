#include "materials/fabric/packing.hpp"

#include <cmath>
#include <limits>

namespace snug::materials {

void add_packing(const Eigen::Vector3d& strain, double stiffness, MembraneResponse& response) {
  const double c1 = 1.0 + 2.0 * strain[0], c2 = 1.0 + 2.0 * strain[1];
  const double square = c1 * c2 - strain[2] * strain[2];
  if (square >= packed * packed) return;
  const double J = std::sqrt(std::max(square, std::numeric_limits<double>::min())), missing = packed - J;
  const double k = 0.01 * stiffness / (3.0 * packed), by = missing / J;
  const double slope = -k * missing * by * (3.0 + by);                            // dW/dJ
  const double curvature = k * by * (6.0 * J + 6.0 * missing + 2.0 * missing * by) / J;  // d2W/dJ2
  const Eigen::Vector3d d_square(2.0 * c2, 2.0 * c1, -2.0 * strain[2]), dJ = d_square / (2.0 * J);
  Eigen::Matrix3d dd_square = Eigen::Matrix3d::Zero();
  dd_square(0, 1) = dd_square(1, 0) = 4.0, dd_square(2, 2) = -2.0;
  response.energy += k * missing * missing * by;
  response.force += slope * dJ;
  response.tangent += curvature * dJ * dJ.transpose() + slope * (dd_square / (2.0 * J) - dJ * dJ.transpose() / J);
}

}  // namespace snug::materials
