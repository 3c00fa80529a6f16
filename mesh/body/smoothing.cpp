#include "mesh/body/smoothing.hpp"

#include <algorithm>
#include <cmath>

namespace snug::mesh {

namespace {

/// Weights that evaluate at column n the straight line fitted round it.
Eigen::VectorXd local_line_weights(Eigen::Index n, Eigen::Index columns, double dz, double sigma) {
  Eigen::VectorXd gauss(columns), distance(columns);
  for (Eigen::Index m = 0; m < columns; ++m) {
    distance[m] = dz * static_cast<double>(m - n);
    gauss[m] = std::exp(-0.5 * distance[m] * distance[m] / (sigma * sigma));
  }
  const double s0 = gauss.sum(), s1 = gauss.dot(distance), s2 = gauss.dot(distance.cwiseAbs2());
  const double determinant = s0 * s2 - s1 * s1;
  if (determinant <= 1e-12 * s0 * dz * dz)
    return Eigen::VectorXd::Unit(columns, n);  // sigma far below dz: no smoothing
  return gauss.cwiseProduct((s2 - s1 * distance.array()).matrix()) / determinant;
}

}  // namespace

double gaussian_pass(double wave_number, double sigma) {
  const double g = std::exp(-0.5 * wave_number * wave_number * sigma * sigma);
  return g + (1.0 - g) * g;
}

Eigen::MatrixXd smooth_along(const Eigen::MatrixXd& values, double dz, double sigma) {
  const Eigen::Index columns = values.cols();
  Eigen::MatrixXd weights(columns, columns);
  for (Eigen::Index n = 0; n < columns; ++n) weights.col(n) = local_line_weights(n, columns, dz, sigma);
  const Eigen::MatrixXd once = values * weights;
  return once + (values - once) * weights;
}

}  // namespace snug::mesh
