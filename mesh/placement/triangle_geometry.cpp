#include "mesh/placement/triangle_geometry.hpp"

#include <Eigen/Geometry>

#include <cmath>

namespace snug::mesh {

using Eigen::Vector3d;

Vector3d nearest_on_triangle(const Vector3d& p, const Triangle3& triangle) {
  const auto& [a, b, c] = triangle;
  const Vector3d ab = b - a, ac = c - a;
  const double d1 = ab.dot(p - a), d2 = ac.dot(p - a);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const double d3 = ab.dot(p - b), d4 = ac.dot(p - b);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {1.0 - d1 / (d1 - d3), d1 / (d1 - d3), 0.0};
  const double d5 = ab.dot(p - c), d6 = ac.dot(p - c);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {1.0 - d2 / (d2 - d6), 0.0, d2 / (d2 - d6)};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 >= d3 && d5 >= d6) {
    const double w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - w, w};
  }
  const double v = vb / (va + vb + vc), w = vc / (va + vb + vc);
  return {1.0 - v - w, v, w};
}

double distance_to_triangle(const Vector3d& p, const Triangle3& triangle) {
  const Vector3d at = nearest_on_triangle(p, triangle);
  return (p - at[0] * triangle[0] - at[1] * triangle[1] - at[2] * triangle[2]).norm();
}

int crossing(const Vector3d& a, const Vector3d& b, const Triangle3& triangle) {
  const Vector3d along = b - a, u = triangle[1] - triangle[0], v = triangle[2] - triangle[0];
  const Vector3d h = along.cross(v);
  const double determinant = u.dot(h);  // minus the normal times the segment
  if (std::abs(determinant) < 1e-300) return 0;
  const Vector3d from = a - triangle[0], q = from.cross(u);
  const double r = from.dot(h) / determinant, s = along.dot(q) / determinant, t = v.dot(q) / determinant;
  if (r < 0.0 || s < 0.0 || r + s > 1.0 || t < 0.0 || t > 1.0) return 0;
  return determinant < 0.0 ? 1 : -1;
}

bool cross_each_other(const Triangle3& one, const Triangle3& other) {
  for (int n = 0; n < 3; ++n)
    if (crossing(one[n], one[(n + 1) % 3], other) != 0 || crossing(other[n], other[(n + 1) % 3], one) != 0) return true;
  return false;
}

}  // namespace snug::mesh
