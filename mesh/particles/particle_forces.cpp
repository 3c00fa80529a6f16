#include "mesh/particles/particle_forces.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace snug::mesh {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Vector3d weighted_sum(Weights weights, const Places& x) {
  Vector3d sum = Vector3d::Zero();
  for (const Weight& one : weights) sum += one.weight * x[one.particle];
  return sum;
}

void ForceSum::add_block(int a, int b, const Matrix3d& block) {
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k)
      if (block(i, k) != 0.0) entries.emplace_back(3 * a + i, 3 * b + k, block(i, k));
}

void ForceSum::add_stretch(Weights weights, const Places& x, double length, double measure, const TensileCurve& curve) {
  const Vector3d way = weighted_sum(weights, x);
  const double now = way.norm();
  const auto [strip_energy, tension, tangent] = curve(now / length);
  const Vector3d along = way / now;
  const double force = measure / length * tension;
  energy += measure * strip_energy;
  for (const Weight& one : weights) gradient[one.particle] += force * one.weight * along;
  if (!second) return;
  const Matrix3d axial = along * along.transpose();
  const Matrix3d block = measure / (length * length) * std::max(tangent, 0.0) * axial +
                         std::max(force, 0.0) / now * (Matrix3d::Identity() - axial);
  for (const Weight& one : weights)
    for (const Weight& other : weights) add_block(one.particle, other.particle, one.weight * other.weight * block);
}

void ForceSum::add_shear(Weights warp, Weights weft, const Places& x, double stiffness) {
  if (stiffness == 0.0) return;
  const Vector3d along_warp = weighted_sum(warp, x), along_weft = weighted_sum(weft, x);
  const Vector3d u = along_warp.normalized(), v = along_weft.normalized();
  const double sine = std::clamp(u.dot(v), -0.999999, 0.999999), angle = std::asin(sine), cosine = std::cos(angle);
  const Vector3d by_warp = (v - sine * u) / (along_warp.norm() * cosine),
                 by_weft = (u - sine * v) / (along_weft.norm() * cosine);
  const auto slope = [&](std::size_t a) -> Vector3d { return warp[a].weight * by_warp + weft[a].weight * by_weft; };
  energy += 0.5 * stiffness * angle * angle;
  for (std::size_t a = 0; a < warp.size(); ++a) {
    const Vector3d of_a = slope(a);
    gradient[warp[a].particle] += stiffness * angle * of_a;
    for (std::size_t b = 0; second && b < warp.size(); ++b)
      add_block(warp[a].particle, warp[b].particle, stiffness * of_a * slope(b).transpose());
  }
}

}  // namespace snug::mesh
