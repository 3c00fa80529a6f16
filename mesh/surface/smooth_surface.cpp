#include "mesh/surface/smooth_surface.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace snug::mesh {

namespace {

constexpr double reach_of_gaussian = 3.0;  // standard deviations
constexpr std::size_t fewest_points = 15;  // for the six coefficients of a quadric

}  // namespace

SmoothSurface::SmoothSurface(TriangleSurface surface, double radius)
    : surface_(std::move(surface)),
      tree_(surface_),
      sigma_(0.5 * radius),
      neighbours_(surface_.vertices.size()),
      normals_(surface_.vertices.size(), Eigen::Vector3d::Zero()),
      areas_(surface_.vertices.size(), 0.0) {
  for (const auto& t : surface_.triangles) {
    const auto& x = surface_.vertices;
    const Eigen::Vector3d twice = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    for (int n = 0; n < 3; ++n) {
      normals_[t[n]] += twice, areas_[t[n]] += twice.norm() / 6.0;
      neighbours_[t[n]].push_back(t[(n + 1) % 3]);
    }
  }
  for (auto& normal : normals_) normal.normalize();
}

std::vector<int> SmoothSurface::around(int triangle, const Eigen::Vector3d& foot, double reach) const {
  std::vector<int> found(surface_.triangles[triangle].begin(), surface_.triangles[triangle].end());
  for (std::size_t n = 0; n < found.size(); ++n)
    for (const int v : neighbours_[found[n]])
      if ((surface_.vertices[v] - foot).norm() < reach && std::find(found.begin(), found.end(), v) == found.end()) found.push_back(v);
  return found;
}

SmoothSurface::Point SmoothSurface::fitted(const Eigen::Vector3d& x) const {
  const NearestPoint near = tree_.nearest(x);
  double sigma = sigma_;
  std::vector<int> points = around(near.triangle, near.x, reach_of_gaussian * sigma);
  while (points.size() < fewest_points && sigma < 1e3 * sigma_) {
    sigma *= 1.3;
    points = around(near.triangle, near.x, reach_of_gaussian * sigma);
  }
  Eigen::Vector3d facet = Eigen::Vector3d::Zero();
  for (const int v : surface_.triangles[near.triangle]) facet += normals_[v];
  facet.normalize();
  std::vector<double> weight;
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const int v : points) {
    const double turn = std::max(0.0, normals_[v].dot(facet)), r = (surface_.vertices[v] - near.x).norm() / sigma;
    weight.push_back(areas_[v] * turn * turn * std::exp(-0.5 * r * r));
    normal += weight.back() * normals_[v];
  }
  normal.normalize();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Eigen::Vector3d from = (surface_.vertices[points[n]] - x) / sigma;
    const double p = u.dot(from), q = v.dot(from);
    Eigen::Matrix<double, 6, 1> row;
    row << 1.0, p, q, p * p, p * q, q * q;
    A += weight[n] * row * row.transpose();
    b += weight[n] * normal.dot(from) * row;
  }
  A.diagonal().tail<3>().array() += 1e-9 * A(0, 0);  // of points along a line the quadric is flat across it
  const Eigen::Matrix<double, 6, 1> c = A.ldlt().solve(b);
  if (!c.allFinite() || std::abs(c[0]) > reach_of_gaussian) return {near.x, facet};
  return {x + sigma * c[0] * normal, (normal - c[1] * u - c[2] * v).normalized()};
}

SmoothSurface::Point SmoothSurface::onto(const Eigen::Vector3d& x) const { return fitted(fitted(x).x); }

Eigen::Vector3d SmoothSurface::onto(const Eigen::Vector3d& start, const Eigen::Vector3d& point, const Eigen::Vector3d& across) const {
  Eigen::Vector3d x = start;
  for (int round = 0; round < 4; ++round) {
    const Point on = fitted(x);
    x = on.x;
    Eigen::Vector3d slide = across - across.dot(on.normal) * on.normal;  // along the surface, towards the plane
    if (slide.norm() > 0.1) x -= across.dot(x - point) / across.dot(slide) * slide;
    else x -= across.dot(x - point) * across;
  }
  return x;
}

}  // namespace snug::mesh
