#include "mesh/surface/smooth_surface.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>

namespace snug::mesh {

namespace {

constexpr double reach_of_gaussian = 3.0;  // standard deviations
constexpr double small_facet = 0.1;  // of a variance: over such a facet the weight hardly changes, and its middle stands for it
constexpr std::size_t fewest_triangles = 16;  // about one ring round each corner: less has no curvature

/// Six points that integrate polynomials of fourth degree over a triangle (Dunavant 1985): first share, weight.
constexpr std::array<std::array<double, 2>, 2> rule = {{{0.108103018168070, 0.223381589678011}, {0.816847572980459, 0.109951743655322}}};

}  // namespace

SmoothSurface::SmoothSurface(TriangleSurface surface, double radius, double at_corners)
    : surface_(std::move(surface)), tree_(surface_), sigma_(0.5 * radius), at_corners_(at_corners), triangles_at_(surface_.vertices.size()) {
  for (std::size_t n = 0; n < surface_.triangles.size(); ++n) {
    const auto &t = surface_.triangles[n];
    const auto& x = surface_.vertices;
    const Eigen::Vector3d twice = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]);
    areas_.push_back(0.5 * twice.norm());
    normals_.push_back(twice.normalized());
    for (const int v : t) triangles_at_[v].push_back(static_cast<int>(n));
  }
}

std::vector<int> SmoothSurface::around(int triangle, const Eigen::Vector3d& foot, double reach) const {
  std::vector<int> found = {triangle};
  std::unordered_set<int> seen = {triangle};
  const auto add = [&](int t) {
    if (!seen.insert(t).second) return;
    const auto& v = surface_.triangles[t];
    const bool near = std::any_of(v.begin(), v.end(), [&](int n) { return (surface_.vertices[n] - foot).norm() < reach; });
    if (near) found.push_back(t);
  };
  for (std::size_t n = 0; n < found.size(); ++n)
    for (const int v : surface_.triangles[found[n]])
      if (n == 0 || (surface_.vertices[v] - foot).norm() < reach)
        for (const int t : triangles_at_[v]) add(t);
  return found;
}

SmoothSurface::Point SmoothSurface::fitted(const Eigen::Vector3d& x) const {
  const NearestPoint near = tree_.nearest(x);
  const Eigen::Vector3d& facet = normals_[near.triangle];
  double sigma = sigma_;
  std::vector<int> triangles = around(near.triangle, near.x, reach_of_gaussian * sigma);
  while (triangles.size() < fewest_triangles && sigma < 1e3 * sigma_) {
    sigma *= 1.3;
    triangles = around(near.triangle, near.x, reach_of_gaussian * sigma);
  }
  std::vector<std::pair<Eigen::Vector3d, double>> samples;  // from x in units of sigma, weight
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  for (const int t : triangles) {
    const double turn = std::max(0.0, normals_[t].dot(facet));
    if (turn == 0.0) continue;
    const auto& corners = surface_.triangles[t];
    const auto add = [&](const Eigen::Vector3d& at, double weight) {
      const double w = weight * areas_[t] * turn * turn * std::exp(-0.5 * (at - near.x).squaredNorm() / (sigma * sigma));
      samples.emplace_back((at - x) / sigma, w);
      normal += w * normals_[t];
    };
    const Eigen::Vector3d centroid = (surface_.vertices[corners[0]] + surface_.vertices[corners[1]] + surface_.vertices[corners[2]]) / 3.0;
    const bool small = areas_[t] < small_facet * sigma * sigma;
    if (small) add(centroid, 1.0 - at_corners_);
    for (int corner = 0; corner < 3; ++corner) {
      add(surface_.vertices[corners[corner]], at_corners_ / 3.0);
      if (small || at_corners_ == exact_corners) continue;
      for (const auto& [share, weight] : rule) {
        Eigen::Vector3d at = Eigen::Vector3d::Zero();
        for (int n = 0; n < 3; ++n) at += (n == corner ? share : 0.5 * (1.0 - share)) * surface_.vertices[corners[n]];
        add(at, (1.0 - at_corners_) * weight);
      }
    }
  }
  normal.normalize();
  const Eigen::Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
  Eigen::Matrix<double, 6, 6> A = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> b = Eigen::Matrix<double, 6, 1>::Zero();
  for (const auto& [from, weight] : samples) {
    const double p = u.dot(from), q = v.dot(from);
    Eigen::Matrix<double, 6, 1> row;
    row << 1.0, p, q, p * p, p * q, q * q;
    A.selfadjointView<Eigen::Lower>().rankUpdate(row, weight);
    b += weight * normal.dot(from) * row;
  }
  A.diagonal().tail<3>().array() += 1e-9 * A(0, 0);  // of facets along a line the quadric is flat across it
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
