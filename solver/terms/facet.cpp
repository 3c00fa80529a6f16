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

}  // namespace snug::solver
