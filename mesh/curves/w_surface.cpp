#include "mesh/curves/w_surface.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "mesh/curves/w_curve.hpp"

namespace snug::mesh::curves {

Eigen::Vector3d SurfacePoint::normal() const {
  const Eigen::Vector3d n = x_u.cross(x_v);
  const double size = n.norm();
  if (!(size > 1e-14 * x_u.norm() * x_v.norm())) throw std::domain_error("the surface has no tangent plane here");
  return n / size;
}

Eigen::Vector2d SurfacePoint::curvatures() const {
  const Eigen::Vector3d n = normal();
  // First and second fundamental forms; K = det II / det I, 2 H = trace of I^-1 II.
  const double e = x_u.dot(x_u), f = x_u.dot(x_v), g = x_v.dot(x_v);
  const double l = x_uu.dot(n), m = x_uv.dot(n), k = x_vv.dot(n);
  const double area = e * g - f * f, mean = 0.5 * (e * k - 2.0 * f * m + g * l) / area, gauss = (l * k - m * m) / area;
  const double half = std::sqrt(std::max(mean * mean - gauss, 0.0));
  return {mean + half, mean - half};
}

WSurface::WSurface(SegmentKnots u, SegmentKnots v, const Eigen::Matrix3Xd& points, const Eigen::VectorXd& weights)
    : u_(std::move(u)), v_(std::move(v)) {
  const int count = (u_.degree() + 1) * (v_.degree() + 1);
  if (points.cols() != count || weights.size() != count)
    throw std::invalid_argument(
        fmt::format("a surface of degrees {} and {} has {} points and as many weights, not {} and {}", u_.degree(),
                    v_.degree(), count, points.cols(), weights.size()));
  if (!(weights.array() > 0.0).all() || !weights.allFinite() || !points.allFinite())
    throw std::invalid_argument("points must be finite and weights positive");
  homogeneous_.resize(4, count);
  homogeneous_.topRows<3>() = points * weights.asDiagonal();
  homogeneous_.row(3) = weights.transpose();
}

WSurface::WSurface(SegmentKnots u, SegmentKnots v, const Eigen::Matrix3Xd& points)
    : WSurface(std::move(u), std::move(v), points, Eigen::VectorXd::Ones(points.cols())) {}

WSurface::WSurface(Homogeneous homogeneous, SegmentKnots u, SegmentKnots v)
    : u_(std::move(u)), v_(std::move(v)), homogeneous_(std::move(homogeneous)) {}

Eigen::Matrix3Xd WSurface::points() const { return homogeneous_.topRows<3>() * weights().cwiseInverse().asDiagonal(); }

Eigen::Vector4d WSurface::sum(const Bases& g, const Bases& h) const {
  Eigen::Vector4d total = Eigen::Vector4d::Zero();
  const double* column = homogeneous_.data();
  for (Eigen::Index i = 0; i < g.size(); ++i) {
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    for (Eigen::Index j = 0; j < h.size(); ++j, column += 4) row += h[j] * Eigen::Map<const Eigen::Vector4d>(column);
    total += g[i] * row;
  }
  return total;
}

Eigen::Vector3d WSurface::point(double u, double v) const {
  const Eigen::Vector4d h = sum(u_.bases(u), v_.bases(v));
  return h.head<3>() / h[3];
}

SurfacePoint WSurface::derivatives(double u, double v) const {
  const std::array<Bases, 3> g = {u_.bases(u, 0), u_.bases(u, 1), u_.bases(u, 2)},
                             h = {v_.bases(v, 0), v_.bases(v, 1), v_.bases(v, 2)};
  const Eigen::Vector4d a = sum(g[0], h[0]), a_u = sum(g[1], h[0]), a_v = sum(g[0], h[1]);
  const Eigen::Vector4d a_uu = sum(g[2], h[0]), a_uv = sum(g[1], h[1]), a_vv = sum(g[0], h[2]);
  SurfacePoint p;  // Leibniz on w R = A
  p.x = a.head<3>() / a[3];
  p.x_u = (a_u.head<3>() - a_u[3] * p.x) / a[3];
  p.x_v = (a_v.head<3>() - a_v[3] * p.x) / a[3];
  p.x_uu = (a_uu.head<3>() - 2.0 * a_u[3] * p.x_u - a_uu[3] * p.x) / a[3];
  p.x_uv = (a_uv.head<3>() - a_u[3] * p.x_v - a_v[3] * p.x_u - a_uv[3] * p.x) / a[3];
  p.x_vv = (a_vv.head<3>() - 2.0 * a_v[3] * p.x_v - a_vv[3] * p.x) / a[3];
  return p;
}

WSurface WSurface::stepped(int k, int l, double eps, double eta) const {
  const SegmentKnots u = u_.remaining(k), v = v_.remaining(l);
  Homogeneous h = homogeneous_;
  const auto at = [&](int i, int j) { return h.col(i * across() + j); };
  for (int step = 1; step <= k; ++step)
    for (int i = 0; i <= u_.degree() - step; ++i)
      for (int j = 0; j < across(); ++j) {
        const double lambda = u_.lambda(i, step, eps);
        at(i, j) = lambda * at(i, j) + (1.0 - lambda) * at(i + 1, j);
      }
  for (int step = 1; step <= l; ++step)
    for (int j = 0; j <= v_.degree() - step; ++j)
      for (int i = 0; i <= u.degree(); ++i) {
        const double lambda = v_.lambda(j, step, eta);
        at(i, j) = lambda * at(i, j) + (1.0 - lambda) * at(i, j + 1);
      }
  Homogeneous left(4, (u.degree() + 1) * (v.degree() + 1));
  for (int i = 0, next = 0; i <= u.degree(); ++i)
    for (int j = 0; j <= v.degree(); ++j) left.col(next++) = at(i, j);
  return {left, u, v};
}

WSurface WSurface::with_knots(const SegmentKnots& u, const SegmentKnots& v) const {
  Homogeneous h = homogeneous_;
  const int rows = u_.degree() + 1;
  for (int j = 0; j < across(); ++j) {  // along u, then along v: homogeneous points are points of a polynomial curve
    Eigen::MatrixXd column(4, rows);
    for (int i = 0; i < rows; ++i) column.col(i) = h.col(i * across() + j);
    column = WCurve(u_, column).with_knots(u).points();
    for (int i = 0; i < rows; ++i) h.col(i * across() + j) = column.col(i);
  }
  for (int i = 0; i < rows; ++i)
    h.middleCols(i * across(), across()) =
        WCurve(v_, Eigen::MatrixXd(h.middleCols(i * across(), across()))).with_knots(v).points();
  if (!(h.row(3).array() > 0.0).all()) throw std::invalid_argument("a weight would not be positive with these knots");
  return {h, u, v};
}

WSurface WSurface::bezier() const {
  return with_knots(SegmentKnots::bezier(u_.degree(), u_.start(), u_.end()),
                    SegmentKnots::bezier(v_.degree(), v_.start(), v_.end()));
}

}  // namespace snug::mesh::curves
