#include "solver/terms/facet.hpp"

#include <Eigen/Dense>

namespace snug::solver {

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
