#include "mesh/body/hex27.hpp"

#include <cmath>

namespace snug::mesh {

namespace {

std::array<double, 3> lagrange(double r) {
  return {2.0 * (r - 0.5) * (r - 1.0), 4.0 * r * (1.0 - r), 2.0 * r * (r - 0.5)};
}

std::array<double, 3> lagrange_slope(double r) { return {4.0 * r - 3.0, 4.0 - 8.0 * r, 4.0 * r - 1.0}; }

std::vector<SamplePoint> make_samples() {
  const double d = std::sqrt(0.15);  // sqrt(3/5) / 2
  const std::array<double, 3> gauss = {0.5 - d, 0.5, 0.5 + d}, weight = {5.0 / 18.0, 8.0 / 18.0, 5.0 / 18.0};
  std::vector<SamplePoint> samples;
  for (int n = 0; n < 27; ++n) {
    const int i = n % 3, j = n / 3 % 3, k = n / 9;
    samples.push_back({{gauss[i], gauss[j], gauss[k]}, weight[i] * weight[j] * weight[k]});
  }
  for (int n = 0; n < 27; ++n) samples.push_back({{n % 3 * 0.5, n / 3 % 3 * 0.5, n / 9 * 0.5}, 0.0});
  return samples;
}

}  // namespace

const std::vector<SamplePoint>& hex27_samples() {
  static const std::vector<SamplePoint> samples = make_samples();
  return samples;
}

Eigen::Matrix3d hex27_jacobian(const std::array<Eigen::Vector3d, 27>& nodes, const Eigen::Vector3d& reference) {
  std::array<std::array<double, 3>, 3> value, slope;
  for (int a = 0; a < 3; ++a) {
    value[a] = lagrange(reference[a]);
    slope[a] = lagrange_slope(reference[a]);
  }
  Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
  for (int n = 0; n < 27; ++n) {
    const int i = n % 3, j = n / 3 % 3, k = n / 9;
    const Eigen::RowVector3d gradient(slope[0][i] * value[1][j] * value[2][k], value[0][i] * slope[1][j] * value[2][k],
                                      value[0][i] * value[1][j] * slope[2][k]);
    jacobian += nodes[n] * gradient;
  }
  return jacobian;
}

}  // namespace snug::mesh
