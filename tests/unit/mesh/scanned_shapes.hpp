// Closed surfaces as scanners see them, whose exact shapes are known.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "mesh/formats/triangle_surface.hpp"
#include "mesh/surface/level_surface.hpp"

namespace snug::tests {

struct Tube {
  double radius = 0.05, length = 0.4;
  int around = 120, along = 80;
};

/// A round tube along z from 0 on, with flat ends.
inline mesh::TriangleSurface tube(const Tube& t) {
  mesh::TriangleSurface surface;
  for (int j = 0; j <= t.along; ++j)
    for (int i = 0; i < t.around; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / t.around;
      surface.vertices.emplace_back(t.radius * std::cos(angle), t.radius * std::sin(angle), t.length * j / t.along);
    }
  const auto node = [&](int i, int j) { return j * t.around + i % t.around; };
  for (int j = 0; j < t.along; ++j)
    for (int i = 0; i < t.around; ++i) {
      surface.triangles.push_back({node(i, j), node(i + 1, j), node(i + 1, j + 1)});
      surface.triangles.push_back({node(i, j), node(i + 1, j + 1), node(i, j + 1)});
    }
  for (const int end : {0, t.along}) {
    const int middle = static_cast<int>(surface.vertices.size());
    surface.vertices.emplace_back(0.0, 0.0, t.length * end / t.along);
    for (int i = 0; i < t.around; ++i)
      if (end == 0) surface.triangles.push_back({node(i + 1, 0), node(i, 0), middle});
      else surface.triangles.push_back({node(i, end), node(i + 1, end), middle});
  }
  return surface;
}

/// Two legs at x = +-0.08 from z = 0 to 0.4 that join a trunk of 0.3 to 0.7 smoothly.
struct Trousers {
  double leg = 0.06, trunk = 0.12, spacing = 0.007;
};
inline mesh::TriangleSurface trousers(const Trousers& t) {
  const auto capsule = [](const Eigen::Vector3d& x, const Eigen::Vector3d& a, const Eigen::Vector3d& b, double radius) {
    const double s = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return radius - (x - a - s * (b - a)).norm();
  };
  const auto blend = [](double a, double b) {  // the larger one, with a fillet
    constexpr double k = 0.03;
    const double h = std::max(k - std::abs(a - b), 0.0) / k;
    return std::max(a, b) + 0.25 * h * h * k;
  };
  const auto level = [&](const Eigen::Vector3d& x) {
    const double left = capsule(x, {0.08, 0, t.leg}, {0.07, 0, 0.4}, t.leg), right = capsule(x, {-0.08, 0, t.leg}, {-0.07, 0, 0.4}, t.leg);
    const double trunk = capsule(x, {0, 0, 0.45}, {0, 0, 0.7}, t.trunk);
    return blend(std::max(left, right), trunk);
  };
  return mesh::level_surface(level, {{-0.2, -0.16, -0.05}, {0.2, 0.16, 0.86}}, t.spacing);
}

/// A ring round z.
inline mesh::TriangleSurface ring(double radius, double thickness) {
  return mesh::level_surface([&](const Eigen::Vector3d& x) { return thickness - std::hypot(x.head<2>().norm() - radius, x.z()); },
                             {Eigen::Vector3d::Constant(-0.2), Eigen::Vector3d::Constant(0.2)}, 0.01);
}

/// An OBJ file that lives as long as this; z up, y to the front, in m.
class ObjFile {
 public:
  explicit ObjFile(const mesh::TriangleSurface& surface, const std::string& name = "scan") : path(std::filesystem::temp_directory_path() / ("snug-" + name + "-" + std::to_string(::getpid()) + ".obj")) {
    std::ofstream file(path);
    file.precision(12);
    for (const auto& x : surface.vertices) file << "v " << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
    for (const auto& t : surface.triangles) file << "f " << t[0] + 1 << ' ' << t[1] + 1 << ' ' << t[2] + 1 << '\n';
  }
  ~ObjFile() { std::filesystem::remove(path); }
  ObjFile(const ObjFile&) = delete;
  ObjFile& operator=(const ObjFile&) = delete;
  const std::filesystem::path path;
};

}  // namespace snug::tests
