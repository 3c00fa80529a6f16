#include "solver/terms/facet.hpp"

#include <Eigen/Dense>

#include <cmath>

namespace snug::solver {

namespace {

struct Line {
  Eigen::Vector3d N, d, dd;
};

Line line(double x) {
  return {{0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)}, {x - 0.5, -2.0 * x, x + 0.5}, {1.0, -2.0, 1.0}};
}

}  // namespace

FacetShape facet_shape(const Eigen::Vector2d& xi) {
  const Line u = line(xi[0]), v = line(xi[1]);
  FacetShape s;
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      const int a = 3 * j + i;
      s.N[a] = u.N[i] * v.N[j];
      s.dN.row(a) << u.d[i] * v.N[j], u.N[i] * v.d[j];
      s.ddN.row(a) << u.dd[i] * v.N[j], u.N[i] * v.dd[j], u.d[i] * v.d[j];
    }
  return s;
}

FacetPoint facet_point(const FacetNodes& nodes, const FacetShape& shape) {
  FacetPoint p;
  p.y = nodes * shape.N;
  p.tangent = nodes * shape.dN;
  p.n = p.tangent.col(0).cross(p.tangent.col(1));
  p.area = p.n.norm();
  p.n /= p.area;
  p.metric = p.tangent.transpose() * p.tangent;
  const Eigen::Vector3d k = (nodes * shape.ddN).transpose() * p.n;
  p.curvature << k[0], k[2], k[2], k[1];
  return p;
}

bool project(const FacetNodes& nodes, const Eigen::Vector3d& x, double reach, Eigen::Vector2d& xi) {
  for (int iteration = 0; iteration < 25; ++iteration) {
    const FacetShape shape = facet_shape(xi);
    const Eigen::Vector3d r = x - nodes * shape.N;
    const Eigen::Matrix<double, 3, 2> t = nodes * shape.dN;
    const Eigen::Matrix<double, 3, 3> second = nodes * shape.ddN;
    Eigen::Matrix2d A = t.transpose() * t;
    const Eigen::Vector3d k = second.transpose() * r;
    Eigen::Matrix2d full = A;
    full(0, 0) -= k[0], full(1, 1) -= k[1], full(0, 1) -= k[2], full(1, 0) -= k[2];
    if (full.determinant() > 0.1 * A.determinant() && full(0, 0) > 0.0) A = full;  // else Gauss-Newton
    Eigen::Vector2d step = A.inverse() * (t.transpose() * r);
    const double longest = step.cwiseAbs().maxCoeff();
    if (longest > 1.0) step /= longest;
    xi += step;
    if (!xi.allFinite()) return false;
    xi = xi.cwiseMax(-reach).cwiseMin(reach);
    if (step.cwiseAbs().maxCoeff() < 1e-13) return true;
    if (xi.cwiseAbs().maxCoeff() >= reach && iteration > 6) return true;
  }
  return true;
}

}  // namespace snug::solver
