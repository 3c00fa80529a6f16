// A standing body of the tests: round limbs joined smoothly, meshed by marching tetrahedra.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "mesh/placement/body_surface.hpp"

namespace snug::mesh {

/// m: distance to a cone with round ends from `a` to `b`, negative inside; exact where both radii are equal.
inline double round_cone(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double ra,
                         double rb) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm() - ra - t * (rb - ra);
}

/// Negative inside a body of 1.7 m: x to its right, y to the front, z up; arms held away, feet to the front.
inline double standing_figure(const Eigen::Vector3d& p) {
  constexpr double blend = 0.02;  // m
  const auto join = [](double a, double b) {
    const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
    return std::min(a, b) - 0.25 * h * h * blend;
  };
  const Eigen::Vector3d q(std::abs(p.x()), p.y(), p.z());  // both sides alike
  const Eigen::Vector3d flat(q.x() / 1.35, q.y(), q.z());
  double d = round_cone(flat, {0, 0, 0.93}, {0, 0, 1.26}, 0.125, 0.115);              // trunk
  d = join(d, round_cone(q, {0.10, 0, 0.09}, {0.11, 0, 0.86}, 0.045, 0.085));         // leg
  d = join(d, round_cone(q, {0.10, -0.02, 0.04}, {0.11, 0.15, 0.035}, 0.04, 0.035));  // foot
  d = join(d, round_cone(q, {0, 0, 1.36}, {0.15, 0, 1.35}, 0.06, 0.055));             // shoulder
  d = join(d, round_cone(q, {0.17, 0, 1.345}, {0.52, 0.02, 0.86}, 0.05, 0.035));      // arm
  d = join(d, round_cone(q, {0, 0, 1.38}, {0, 0.01, 1.52}, 0.055, 0.055));            // neck
  return join(d, (q - Eigen::Vector3d(0, 0.02, 1.60)).norm() - 0.10);                 // head
}

/// Where a function vanishes, in triangles that look to where it is positive. The box is cut into cubes of `size` (m),
/// each into six tetrahedra round its diagonal; neighbours are cut alike.
class MarchingTetrahedra {
 public:
  using Function = std::function<double(const Eigen::Vector3d&)>;
  MarchingTetrahedra(const Function& function, const Eigen::AlignedBox3d& box, double size)
      : origin_(box.min()), size_(size) {
    for (int a = 0; a < 3; ++a) count_[a] = static_cast<int>(std::ceil(box.sizes()[a] / size)) + 1;
    for (int k = 0; k < count_[2]; ++k)
      for (int j = 0; j < count_[1]; ++j)
        for (int i = 0; i < count_[0]; ++i) value_.push_back(function(point(number(i, j, k))));
    for (int k = 0; k + 1 < count_[2]; ++k)
      for (int j = 0; j + 1 < count_[1]; ++j)
        for (int i = 0; i + 1 < count_[0]; ++i) add_cube(i, j, k);
  }
  TriangleSurface take() { return std::move(surface_); }

 private:
  int number(int i, int j, int k) const { return (k * count_[1] + j) * count_[0] + i; }
  Eigen::Vector3d point(int n) const {
    return origin_ + size_ * Eigen::Vector3d(n % count_[0], n / count_[0] % count_[1], n / (count_[0] * count_[1]));
  }
  void add_cube(int i, int j, int k) {
    static constexpr std::array<std::array<int, 3>, 6> orders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (const auto& order : orders) {
      std::array<int, 3> at = {i, j, k};
      std::array<int, 4> corners{number(i, j, k), 0, 0, 0};
      for (int n = 0; n < 3; ++n) {
        ++at[order[n]];
        corners[n + 1] = number(at[0], at[1], at[2]);
      }
      add_tetrahedron(corners);
    }
  }
  void add_tetrahedron(const std::array<int, 4>& corners) {
    std::vector<int> in, out;
    for (const int c : corners) (value_[c] < 0.0 ? in : out).push_back(c);
    if (in.empty() || out.empty()) return;
    if (in.size() == 1) add({cut(in[0], out[0]), cut(in[0], out[1]), cut(in[0], out[2])}, in[0], out[0]);
    if (in.size() == 3) add({cut(in[0], out[0]), cut(in[1], out[0]), cut(in[2], out[0])}, in[0], out[0]);
    if (in.size() != 2) return;
    const int a = cut(in[0], out[0]), b = cut(in[0], out[1]), c = cut(in[1], out[1]), d = cut(in[1], out[0]);
    add({a, b, c}, in[0], out[0]), add({a, c, d}, in[0], out[0]);
  }
  void add(std::array<int, 3> t, int in, int out) {
    const auto& x = surface_.vertices;
    if ((x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(point(out) - point(in)) < 0.0) std::swap(t[1], t[2]);
    surface_.triangles.push_back(t);
  }
  int cut(int a, int b) {
    if (a > b) std::swap(a, b);
    const auto [found, added] = cuts_.emplace(std::pair(a, b), static_cast<int>(surface_.vertices.size()));
    const double share = std::clamp(value_[a] / (value_[a] - value_[b]), 0.01, 0.99);
    if (added) surface_.vertices.push_back(point(a) + share * (point(b) - point(a)));
    return found->second;
  }

  Eigen::Vector3d origin_;
  double size_;
  std::array<int, 3> count_;
  std::vector<double> value_;
  std::map<std::pair<int, int>, int> cuts_;
  TriangleSurface surface_;
};

/// The figure in triangles of some `size` (m), as a scanner's file would have it: y up, z to the front.
inline TriangleSurface figure_scan(double size = 0.018) {
  TriangleSurface surface =
      MarchingTetrahedra(standing_figure, {Eigen::Vector3d(-0.62, -0.21, -0.05), Eigen::Vector3d(0.62, 0.25, 1.75)},
                         size)
          .take();
  for (Eigen::Vector3d& p : surface.vertices) p = Eigen::Vector3d(-p.x(), p.z(), p.y());
  return surface;
}

inline BodySurface standing_figure_body(double size = 0.018) {
  return standing_body(figure_scan(size), {.up = input::FileAxis::y}, {"figure.obj"});
}

}  // namespace snug::mesh
