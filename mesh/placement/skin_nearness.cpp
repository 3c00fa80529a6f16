#include "mesh/placement/skin_nearness.hpp"

namespace snug::mesh {

using Eigen::Vector3d;

SkinNearness::SkinNearness(const BodySurface& body, double cell)
    : distance_(body.surface, cell), rotation_(body.rotation), translation_(body.translation) {}

Nearness SkinNearness::operator()(const Vector3d& place) const {
  const Vector3d p = rotation_ * place + translation_;
  Vector3d rise;
  for (int a = 0; a < 3; ++a) {
    const Vector3d half = 0.5 * distance_.cell() * Vector3d::Unit(a);
    rise[a] = distance_.distance(p + half) - distance_.distance(p - half);
  }
  const Vector3d away = rise.squaredNorm() > 0.0 ? Vector3d(rise.normalized()) : Vector3d::Zero();
  return {distance_.distance(p), rotation_.transpose() * away};
}

}  // namespace snug::mesh
