#include "solver/terms/garment_shape.hpp"

#include <deal.II/base/quadrature_lib.h>

namespace snug::solver {

FlatTriangle flat_triangle(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c) {
  FlatTriangle t;
  const Eigen::Vector2d u = b - a, v = c - a;
  const double det = u.x() * v.y() - u.y() * v.x();
  t.area = 0.5 * det;
  t.gradient.row(1) = Eigen::RowVector2d(v.y(), -v.x()) / det;
  t.gradient.row(2) = Eigen::RowVector2d(-u.y(), u.x()) / det;
  t.gradient.row(0) = -t.gradient.row(1) - t.gradient.row(2);
  return t;
}

const std::vector<TrianglePoint>& triangle_rule() {
  static const std::vector<TrianglePoint> rule = [] {
    const dealii::QGaussSimplex<2> gauss(3);
    std::vector<TrianglePoint> points;
    for (unsigned int q = 0; q < gauss.size(); ++q) {
      const auto& p = gauss.point(q);
      points.push_back({{1.0 - p[0] - p[1], p[0], p[1]}, 2.0 * gauss.weight(q)});
    }
    return points;
  }();
  return rule;
}

}  // namespace snug::solver
