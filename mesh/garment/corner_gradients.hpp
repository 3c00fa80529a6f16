// Linear functions on a flat triangle.
#pragma once

#include <Eigen/Core>

namespace snug::mesh {

struct CornerGradients {
  Eigen::Matrix<double, 2, 3> shape;  ///< gradients of the functions that are 1 at a corner and 0 at the others, 1/m
  double area;                        ///< m2, positive for a counter-clockwise triangle
};

inline CornerGradients corner_gradients(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  const double twice = (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  const auto turned = [&](const Eigen::Vector2d& v) -> Eigen::Vector2d { return Eigen::Vector2d(-v.y(), v.x()) / twice; };
  CornerGradients result;
  result.shape << turned(c - b), turned(a - c), turned(b - a);
  result.area = 0.5 * twice;
  return result;
}

}  // namespace snug::mesh
